#pragma once
// The measured times, as JSON and as text.

#include <string>
#include <vector>

#include "bench/run.h"
#include "bench_systems.h"
#include "messages.h"

namespace panache::cli {

// Times in microseconds; null where there is none.
Json to_json(const bench::Measurements& measured, const std::vector<SystemTime>& systems);
// Tables for a terminal, and what is missing and how one gets it.
std::string describe(const bench::Measurements& measured, const std::vector<SystemTime>& systems);

// Characters whose steps fit into a sixtieth of a second.
int characters_at_60hz(const bench::CrowdTime& crowd);

}  // namespace panache::cli
