#pragma once
// Measures the complete step of a character, its stages, crowds, and memory use.

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "bench/measure.h"
#include "clip/clip.h"
#include "style/model/model.h"

namespace panache::bench {

// Nanoseconds; the clock's cost is subtracted from the medians of `stages`, but not from `steps`.
struct StepTimes {
  struct Stage {
    std::string name;
    double median;
  };
  Histogram steps;            // Of consecutive calls of Stylizer::step.
  int64_t interruptions = 0;  // How often other programs took the core.
  std::vector<Stage> stages;  // In order.
  double networks = 0;        // The stage that evaluates the networks.
  double whole = 0;           // Median of the whole step in the rounds that time the stages.
  double cold = 0;            // Median of single steps after evict_caches().
};

// Stylizes `walk` repeatedly with the model's first style: `steps` steps in ten parts, between
// which the stages are timed.
StepTimes time_steps(const std::shared_ptr<const Model>& model, const Clip& walk, int64_t steps,
                     const ProgressCall& progress = {});

struct CrowdTime {
  int characters;
  double us_per_character;  // Median over the rounds.
};

// Times crowds with the same style through the C interface, on this core, as CPU time of this
// thread. Each character is at another point of the walk and has its own poses. `bytes`: a model
// file.
Result<std::vector<CrowdTime>> time_crowds(std::string_view bytes, const Clip& walk, int rounds,
                                           const ProgressCall& progress = {});

// Heap memory of a character besides model and skeleton, bytes; 0 if the allocator does not report
// it.
Result<double> bytes_per_character(std::string_view bytes, const Clip& walk);

}  // namespace panache::bench
