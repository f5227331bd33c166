#pragma once
// Everything that `panache-lab bench` measures, in one run on one core.

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/result.h"
#include "bench/measure.h"
#include "bench/steps.h"

namespace panache::bench {

struct Options {
  std::string model;         // Path of the model: steps are timed in int8, crowds in both.
  std::string walker_model;  // Path of the walker's model, which generates the motion.
  int64_t steps = 1'000'000;
  // Repetitions of the other measurements, derived from the number of steps.
  int rounds() const;
  int crowd_rounds() const;
};

// The slides' networks in one library.
struct ForwardPass {
  std::string key, name;         // "onnxruntime", "ONNX Runtime 1.30.0".
  std::optional<Timing> timing;  // Empty if it is missing; then
  std::string missing;           // the reason.
};
// A network of another paper in our kernels.
struct OtherNetwork {
  std::string key, name;
  size_t bytes;           // Of the weights.
  std::string published;  // Time and memory given in the paper.
  Timing timing;
};

struct Measurements {
  Limits limits;
  std::string kernels;  // Instruction set of our kernels.
  bool pinned = false;  // Whether pinning to one core succeeded.
  double clock_ns = 0;  // Cost of reading the clock, included in step times.
  int rounds = 0;

  size_t network_bytes = 0;  // Weights of the slides' networks.
  std::vector<ForwardPass> forward_passes;
  std::vector<OtherNetwork> others;

  std::string model;                                          // File name.
  StepTimes steps;                                            // Of the walk.
  std::vector<std::pair<std::string, StepTimes>> hard_steps;  // Of other motions, by name.
  std::vector<CrowdTime> crowds, int8_crowds;    // With the model unchanged, and in int8.
  size_t model_bytes = 0, int8_model_bytes = 0;  // Size of the model file, in float and in int8.
  double character_bytes = 0;                    // 0 if the allocator does not report it.

  // The warm median of a forward pass, microseconds; empty if it is missing.
  std::optional<double> forward_us(const std::string& key) const;
};

// Fails if a model cannot be read. Pins the process to a core.
Result<Measurements> measure_all(const Options& options, const ProgressCall& progress);

}  // namespace panache::bench
