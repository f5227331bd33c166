#include "eval/prediction.h"

#include "base/quat.h"
#include "eval/motion_metrics.h"
#include "style/play/pose_predictor.h"
#include "takes/load_takes.h"

namespace panache {
namespace {

constexpr int kEvery = 3;    // Frames between evaluated instants.
constexpr int kMargin = 15;  // Frames.

HumanPositions between(const HumanPositions& a, const HumanPositions& b, float t) {
  HumanPositions out;
  for (size_t j = 0; j < out.size(); ++j) out[j] = lerp(a[j], b[j], t);
  return out;
}

void add_take(PosePredictor prediction, const Take& take, PredictionRow& row) {
  std::vector<HumanPositions> world;
  world.reserve(static_cast<size_t>(take.frames()));
  for (int f = 0; f < take.frames(); ++f) world.push_back(world_positions(take, f));
  const auto world_at = [&](double seconds) {
    const double frame = seconds * kTakeRate;
    const auto f = static_cast<size_t>(frame + 1e-6);
    return between(world[f], world[f + 1], static_cast<float>(frame - static_cast<double>(f)));
  };
  for (int f = 0; f + kMargin < take.frames(); ++f) {
    const double now = f / kTakeRate;
    prediction.push(now, take.body[f], take.root[f]);
    if (f < kMargin || f % kEvery != 0) continue;
    ++row.instants;
    const HumanPositions before = world_at(now - kWindowSpacing);
    for (size_t h = 0; h < kPredictionSeconds.size(); ++h) {
      const double ahead = kPredictionSeconds[h];
      const HumanPositions truth = world_at(now + ahead);
      const PredictedPose predicted = prediction.predict(ahead);
      row.predicted_cm[h] += distance_cm(to_world(predicted.body, predicted.root), truth);
      row.held_cm[h] += distance_cm(world[f], truth);
      const auto steps = static_cast<float>(1 + ahead / kWindowSpacing);
      row.velocity_cm[h] += distance_cm(between(before, world[f], steps), truth);
    }
  }
}

}  // namespace

std::vector<PredictionRow> measure_prediction(const std::shared_ptr<const Model>& model,
                                              const std::vector<const Take*>& takes) {
  std::map<std::string, PredictionRow> rows;
  for (const Take* take : takes) {
    PredictionRow& row = rows[take->row.content];
    row.content = take->row.content;
    add_take(PosePredictor(model), *take, row);
  }
  std::vector<PredictionRow> out;
  for (auto& [content, row] : rows) {
    if (row.instants == 0) continue;
    for (auto* part : {&row.predicted_cm, &row.held_cm, &row.velocity_cm}) {
      for (double& v : *part) v /= static_cast<double>(row.instants);
    }
    out.push_back(std::move(row));
  }
  return out;
}

}  // namespace panache
