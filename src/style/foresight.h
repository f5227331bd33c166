#pragma once
// Where one character goes next, by whoever was right about it lately.

#include <array>
#include <memory>

#include "pose/history.h"
#include "style/model.h"
#include "style/predictor.h"

namespace panache {

// The model's network knows motion like that of its training; on other motion constant velocity,
// constant acceleration, or no motion at all, may be the better guess. So each of them is held to
// what came of its last guesses, and they are mixed by how far off they were.
class Foresight {
 public:
  // `model` has a predictor.
  explicit Foresight(std::shared_ptr<const Model> model);

  void reset() noexcept;
  // Adds the pose at `time` (seconds, never before the last one).
  void push(double time, const HumanPositions& body, const Ground& ground) noexcept;
  // The body `seconds` (0 to Predictor::kMostSeconds) after the newest pose. One was pushed.
  ForeseenBody foresee(double seconds) const noexcept;

  // Calls visit(member) for everything that tells one character from another of this model.
  template <class Self, class Visit>
  static void visit_state(Self& self, Visit&& visit) {
    PoseHistory::visit_state(self.history_, visit);
    visit(self.time_), visit(self.newest_), visit(self.errors_), visit(self.shares_);
    visit(self.guesses_);
    visit(self.guessed_at_), visit(self.checked_);
  }

 private:
  enum { kNetwork, kVelocity, kAcceleration, kHeld, kGuessers };
  // Guesses are checked this long after they were made, seconds.
  static constexpr std::array<double, 2> kChecks = {0.1, 0.25};
  using Guesses = std::array<ForeseenBody, kGuessers>;
  using PerGuesser = std::array<float, kGuessers>;

  Guesses guess(double seconds) const noexcept;
  static PerGuesser shares_of(const PerGuesser& errors) noexcept;
  void check(size_t at, const HumanPositions& body, const Ground& ground) noexcept;

  std::shared_ptr<const Model> model_;
  PoseHistory history_;
  double time_ = 0;
  ForeseenBody newest_;
  // Mean distance of the joints, metres, forgotten over a second or so; and how much of the say
  // each has by that, eased. Per check.
  std::array<PerGuesser, kChecks.size()> errors_{}, shares_{};
  std::array<Guesses, kChecks.size()> guesses_;  // That wait to be checked,
  double guessed_at_ = 0;                        // all made at this time.
  size_t checked_ = kChecks.size();              // How many of them were.
};

}  // namespace panache
