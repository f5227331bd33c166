#pragma once
// All that `panache-lab bench` measures, in one run on one core.

#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "bench/machine.h"
#include "bench/measure.h"
#include "bench/steps.h"

namespace panache::bench {

struct Options {
  std::string model;         // Path of the model: steps are timed in int8, crowds in both.
  std::string walker_model;  // Path of the walker's model, which makes the motion.
  int64_t steps = 1'000'000;
  // How often the other measurements are repeated follows from the number of steps.
  int rounds() const;
  int crowd_rounds() const;
};

// The slides' networks, evaluated by somebody.
struct ForwardPass {
  std::string key, name;         // "onnxruntime", "ONNX Runtime 1.30.0".
  std::optional<Timing> timing;  // Nothing where it is missing; then
  std::string missing;           // why.
};
// A network of another paper in our kernels.
struct OtherNetwork {
  std::string key, name;
  size_t bytes;           // Of its weights.
  std::string published;  // What its paper says of time and memory.
  Timing timing;
};

struct Measurements {
  Limits limits;
  std::string kernels;  // The instruction set of ours.
  bool pinned = false;  // On one core for certain.
  double clock_ns = 0;  // What looking at the clock costs; part of step times.
  int rounds = 0;

  size_t network_bytes = 0;  // Weights of the slides' networks.
  std::vector<ForwardPass> forward_passes;
  std::vector<OtherNetwork> others;

  std::string model;  // Name of the file.
  StepTimes steps;
  std::vector<CrowdTime> crowds, int8_crowds;    // With the model as it is, and in int8.
  size_t model_bytes = 0, int8_model_bytes = 0;  // Of the model file, as floats and in int8.
  double character_bytes = 0;                    // 0 where the allocator does not tell.

  // The warm median of a forward pass, microseconds; nothing where it is missing.
  std::optional<double> forward_us(const std::string& key) const;
};

// Fails where a model cannot be read. Ties the process to a core.
Result<Measurements> measure_all(const Options& options, const ProgressCall& progress);

}  // namespace panache::bench
