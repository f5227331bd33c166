#pragma once
// Compares input prediction with holding the pose and with constant velocity.

#include <array>
#include <map>
#include <string>
#include <vector>

#include "learn/take.h"
#include "style/model/model.h"

namespace panache {

// Prediction horizons, seconds.
inline constexpr std::array<double, 3> kPredictionSeconds = {0.05, 0.1, 0.25};

// Mean distance of the 21 joints (world, metres of the canonical body) from their later positions.
struct PredictionRow {
  std::string content;
  size_t instants = 0;
  std::array<double, kPredictionSeconds.size()> predicted_cm{};
  std::array<double, kPredictionSeconds.size()> held_cm{};      // Holding the pose.
  std::array<double, kPredictionSeconds.size()> velocity_cm{};  // Extrapolating the last 0.05 s.
};

// Rows by content, over every third frame at least half a second from the ends of takes. `model`
// must have a predictor.
std::vector<PredictionRow> measure_prediction(const std::shared_ptr<const Model>& model,
                                              const std::vector<const Take*>& takes);

}  // namespace panache
