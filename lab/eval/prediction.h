#pragma once
// How well input is predicted: a model against holding the pose and against constant velocity.

#include <array>
#include <map>
#include <string>
#include <vector>

#include "learn/take.h"
#include "style/model.h"

namespace panache {

// How far ahead, seconds.
inline constexpr std::array<double, 3> kPredictionSeconds = {0.05, 0.1, 0.25};

// Mean distance of the 21 joints (world, metres of the canonical body) from where they are so many
// seconds later.
struct PredictionRow {
  std::string content;
  size_t instants = 0;
  std::array<double, kPredictionSeconds.size()> predicted_cm{};
  std::array<double, kPredictionSeconds.size()> held_cm{};      // Every joint stays where it is.
  std::array<double, kPredictionSeconds.size()> velocity_cm{};  // Goes on as in the last 0.05 s.
};

// Rows by content, over every third frame of takes that is half a second or more from their ends.
// `model` has a predictor.
std::vector<PredictionRow> measure_prediction(const std::shared_ptr<const Model>& model,
                                              const std::vector<const Take*>& takes);

}  // namespace panache
