#pragma once
// The whole step of a character, its parts, crowds of them, and what they take of memory.

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "bench/measure.h"
#include "clip/clip.h"
#include "style/model.h"

namespace panache::bench {

// A walk to style: a minute in circles at 60 frames a second, by the walker's model.
Result<Clip> make_walk(const std::string& walker_model);

// Nanoseconds; the cost of the clock is taken off the medians of `stages`, and left in `steps`.
struct StepTimes {
  struct Stage {
    std::string name;
    double median;
  };
  Histogram steps;            // Of Stylizer::step, one after another.
  int64_t interruptions = 0;  // How often other programs took the core meanwhile.
  std::vector<Stage> stages;  // The stages of a step, in their order.
  double networks = 0;        // The one of these that evaluates the networks.
  double whole = 0;           // Median of the step, in the rounds in which the stages were timed.
  double cold = 0;            // Median of single steps after evict_caches().
};

// Styles `walk` with the model's first style, over and over: `steps` times in ten parts, between
// which the stages are timed.
StepTimes time_steps(const std::shared_ptr<const Model>& model, const Clip& walk, int64_t steps,
                     const ProgressCall& progress = {});

struct CrowdTime {
  int characters;
  double us_per_character;  // Median over the rounds.
};

// Crowds that walk with the same style, through the C interface, all on this core; the time is what
// this thread computed for. Each character is somewhere else in the walk and has poses of its own.
// `bytes`: of a model file.
Result<std::vector<CrowdTime>> time_crowds(std::string_view bytes, const Clip& walk, int rounds,
                                           const ProgressCall& progress = {});

// What a character takes from the allocator beside model and skeleton, bytes; 0 where the allocator
// does not tell.
Result<double> bytes_per_character(std::string_view bytes, const Clip& walk);

}  // namespace panache::bench
