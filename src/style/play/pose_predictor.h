#pragma once
// Predicts one character's next pose: a mixture of predictors weighted by recent error.

#include <array>
#include <memory>

#include "pose/history.h"
#include "style/model/model.h"
#include "style/model/predictor_network.h"

namespace panache {

// The model's network predicts motion similar to its training data well; on other motion constant
// velocity, constant acceleration or no motion at all may be better. The weights of these experts
// follow the errors of their last predictions.
class PosePredictor {
 public:
  // `model` has a predictor.
  explicit PosePredictor(std::shared_ptr<const Model> model);

  void reset() noexcept;
  // Adds the pose at `time` (seconds, never before the last one).
  void push(double time, const HumanPositions& body, const RootPose& root) noexcept;
  // The body `seconds` (0 to PredictorNetwork::kMaxSeconds) after the newest pose. At least one was
  // pushed.
  PredictedPose predict(double seconds) const noexcept;

  // Calls visit(member) for everything that tells one character from another of this model.
  template <class Self, class Visit>
  static void visit_state(Self& self, Visit&& visit) {
    PoseHistory::visit_state(self.history_, visit);
    visit(self.time_), visit(self.newest_), visit(self.errors_), visit(self.weights_);
    visit(self.predictions_);
    visit(self.predicted_at_), visit(self.checked_);
  }

 private:
  enum { kNetwork, kVelocity, kAcceleration, kHeld, kExperts };
  // Predictions are checked this long after they were made, seconds.
  static constexpr std::array<double, 2> kChecks = {0.1, 0.25};
  using Predictions = std::array<PredictedPose, kExperts>;
  using PerExpert = std::array<float, kExperts>;

  Predictions ask_experts(double seconds) const noexcept;
  static PerExpert weights_of(const PerExpert& errors) noexcept;
  void check(size_t at, const HumanPositions& body, const RootPose& root) noexcept;

  std::shared_ptr<const Model> model_;
  PoseHistory history_;
  double time_ = 0;
  PredictedPose newest_;
  // Mean joint error, metres, averaged over about a second; and the resulting weights of the
  // experts, eased. Per check.
  std::array<PerExpert, kChecks.size()> errors_{}, weights_{};
  std::array<Predictions, kChecks.size()> predictions_;  // Waiting to be checked,
  double predicted_at_ = 0;                              // all made at this time.
  size_t checked_ = kChecks.size();                      // How many were checked.
};

}  // namespace panache
