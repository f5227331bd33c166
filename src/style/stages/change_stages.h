#pragma once
// The stages of a step that carry out a change from any source.

#include <algorithm>
#include <array>
#include <span>

#include "base/elementary.h"
#include "style/stages/anatomy.h"
#include "style/stages/arms_clear.h"
#include "style/stages/energy.h"
#include "style/stages/filter.h"
#include "style/stages/flight.h"
#include "style/stages/foot_stance.h"
#include "style/stages/hand_contacts.h"
#include "style/stages/held_feet.h"
#include "style/stages/input_watch.h"
#include "style/stages/legs_apart.h"
#include "style/stages/root_motion.h"
#include "style/stages/shaping.h"
#include "style/stages/stage_row.h"
#include "style/stages/stage_work.h"

namespace panache {

// The stages without memory.
struct Gestures : NoMemory {};
struct Balance : NoMemory {};

// All stages in the order of a step; memory, reset, state and names for timing follow from it. A
// new stage needs a step(StageWork&), or an overload of carry_out() in change_stages.cpp that
// passes its arguments.
// clang-format off
using ChangeRow = StageRow<Named<StepWatch, "watch the steps">,            // input_watch.h
                           Named<SeatWatch, "watch the seat">,
                           Named<OutputFilter, "filter">,                  // filter.h
                           Named<RootMotion, "root motion">,               // root_motion.h
                           Named<Shaping, "shape">,                        // shaping.h
                           Named<Gestures, "add a gesture">,               // gesture_player.h
                           Named<Energy, "calm or enliven the input">,     // energy.h
                           Named<Anatomy, "keep joints in range">,         // anatomy.h
                           Named<Balance, "keep the balance">,             // lean.h
                           Named<LegsApart, "keep the legs apart">,        // legs_apart.h
                           Named<FloorClearance, "keep above the floor">,  // foot_stance.h
                           Named<FreeFall, "fall as the input does">,      // flight.h
                           Named<FootStance, "keep resting feet level">,   // foot_stance.h
                           Named<HeldFeet, "hold the feet">,               // held_feet.h
                           Named<HandContacts, "keep hands in contact">,   // hand_contacts.h
                           Named<ArmsClear, "keep arms outside">,          // arms_clear.h
                           Named<SteadyArms, "turn arms steadily">>;
// clang-format on

class ChangeStages {
 public:
  explicit ChangeStages(float smoothing_seconds) {
    row_.get<OutputFilter>() = OutputFilter(smoothing_seconds);
  }

  // Forgets the motion so far.
  void reset() noexcept;
  // `flight`: see FlightWatch::amount(); `clock` may be null.
  void step(const AskedChange& asked, const StageOptions& options, float flight,
            const Observer& observer, const InputWindow& window, const StepTime& time,
            StageClock* clock) noexcept;

  // How much something besides the feet holds the body, at the last step; see SeatWatch.
  float seated() const noexcept { return row_.get<SeatWatch>().amount(); }
  // At the last step: the change of the input, the probability that each foot is planted, and input
  // seconds per output second, which is 1 in a flight and while the feet stand.
  const BodyChange& change() const noexcept { return change_; }
  std::span<const float, kFeet> contacts() const noexcept {
    return row_.get<HeldFeet>().contacts();
  }
  double rate() const noexcept { return static_cast<double>(exponential(log_rate_)); }
  StageFacts facts() const noexcept {
    const HandHolds holds = row_.get<HandContacts>().holds();
    return {seated(), std::max({holds.together, holds.by_body[0], holds.by_body[1]})};
  }

  // Calls visit(member) for everything that tells one character from another.
  template <class Self, class Visit>
  static void visit_state(Self& self, Visit&& visit) {
    visit(self.change_), visit(self.log_rate_);
    self.row_.each([&](auto& stage) { stage.visit_state(stage, visit); });
  }

 private:
  ChangeRow row_;
  float log_rate_ = 0;  // See rate(), at the last step.
  BodyChange change_;
};

// The names of all stages of a step: those of Stage, the row, and the writing of the pose.
inline constexpr auto kStageNames = [] {
  constexpr auto kRow = ChangeRow::kNames;
  std::array<const char*, static_cast<size_t>(Stage::first_of_row) + kRow.size() + 1> names = {
      "observe the pose", "history and window", "ease strengths and shape",
      "networks, heads and gate"};
  std::ranges::copy(kRow, names.begin() + static_cast<size_t>(Stage::first_of_row));
  names.back() = "write the pose (rig)";
  return names;
}();
inline constexpr Stage kWriteStage = static_cast<Stage>(kStageNames.size() - 1);

}  // namespace panache
