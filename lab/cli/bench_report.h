#pragma once
// The measured times as JSON and as text.

#include <string>
#include <vector>

#include "bench/run.h"
#include "bench_systems.h"
#include "messages.h"

namespace panache::cli {

// Times in microseconds; null if missing.
Json to_json(const bench::Measurements& measured, const std::vector<SystemTime>& systems);
// Tables for a terminal, with what is missing and how to get it.
std::string describe(const bench::Measurements& measured, const std::vector<SystemTime>& systems);

// The number of characters that can be stepped in 1/60 s.
int characters_at_60hz(const bench::CrowdTime& crowd);

}  // namespace panache::cli
