#pragma once
// Builds and times the systems of other papers for panache-lab bench, and reports its times as
// JSON and as text (bench_report.cpp).

#include <memory>
#include <string>
#include <vector>

#include "base/result.h"
#include "bench/run.h"
#include "eval/system.h"
#include "messages.h"

namespace panache::cli {

struct SystemTime {
  std::string name;
  double frame_us = 0;  // CPU time per frame, including root motion and feet.
  size_t bytes = 0;     // Size of its data.
};

struct BuiltSystems {
  TestInput input;
  std::vector<std::unique_ptr<System>> systems;

  // Times a frame of each, after the model's, in one run on the same take.
  std::vector<SystemTime> time() const;
};

// Builds all of them from the training takes of `manifest`; `styles`: a CSV of style names, or
// empty; `model`: path of the model to compare with. Takes minutes.
Result<BuiltSystems> build_systems(const std::string& manifest, const std::string& styles,
                                   const std::string& model);

// Times in microseconds; null if missing.
Json to_json(const bench::Measurements& measured, const std::vector<SystemTime>& systems);
// Tables for a terminal, with what is missing and how to get it.
std::string describe(const bench::Measurements& measured, const std::vector<SystemTime>& systems);

// The number of characters that can be stepped in 1/60 s.
int characters_at_60hz(const bench::CrowdTime& crowd);

}  // namespace panache::cli
