#pragma once
// The stages of a step that carry out a change of any source: from the filter to the feet.

#include <algorithm>
#include <array>
#include <span>

#include "base/elementary.h"
#include "pose/foot_lock.h"
#include "pose/observer.h"
#include "pose/style_delta.h"
#include "style/shape.h"
#include "style/stage_clock.h"
#include "style/stages/add_gesture.h"
#include "style/stages/anatomy.h"
#include "style/stages/arms_clear.h"
#include "style/stages/fall.h"
#include "style/stages/filter.h"
#include "style/stages/floor.h"
#include "style/stages/foot_stance.h"
#include "style/stages/hand_contacts.h"
#include "style/stages/legs_apart.h"
#include "style/stages/root_motion.h"
#include "style/stages/seat.h"
#include "style/stages/shaping.h"
#include "style/stages/stage_facts.h"
#include "style/stages/step_watch.h"
#include "style/stages/step_time.h"
#include "style/stages/window.h"

namespace panache {

// The requested change at one step.
struct AskedChange {
  StyleDelta delta;
  float log_rate = 0;                    // Logarithm of input seconds per output second.
  std::array<float, kFeet> contacts{};   // Probability that each foot is planted.
  float gate = 1;                        // How well the motion is known, 0 to 1.
  Stance stance = {};                    // Of a foot that stands.
  const GesturePose* gesture = nullptr;  // On top of it; null for none.
  const Shape* shape = &kPlainShape;     // How it is given.
  float amount = 1;  // How much of any style is in force, see EasedStrengths::amount().
};

// How changes are carried out; as StylizerOptions has it.
struct StageOptions {
  bool root = true, foot_lock = true, hold_hands = true;
  bool tempo_everywhere = false;  // Otherwise only where the feet step.
};

class ChangeStages {
 public:
  explicit ChangeStages(float smoothing_seconds) : filter_(smoothing_seconds) {}

  // Forgets the motion so far.
  void reset() noexcept;
  // `flight`: see FlightWatch::amount(); `clock` may be null.
  void step(const AskedChange& asked, const StageOptions& options, float flight,
            const Observer& observer, const InputWindow& window, const StepTime& time,
            StageClock* clock) noexcept;

  // How much something besides its feet holds the body, at the last step; see SeatWatch.
  float seated() const noexcept { return seat_.amount(); }
  // At the last step: what is to be done to the input, the probability that each foot is planted,
  // and input seconds per output second; 1 in a flight, and where the feet stand.
  const BodyChange& change() const noexcept { return change_; }
  std::span<const float, kFeet> contacts() const noexcept { return contacts_; }
  double rate() const noexcept { return static_cast<double>(exponential(log_rate_)); }
  StageFacts facts() const noexcept {
    const HandHolds holds = hands_.holds();
    return {seat_.amount(), std::max({holds.together, holds.by_body[0], holds.by_body[1]})};
  }

  // Calls visit(member) for everything that tells one character from another.
  template <class Self, class Visit>
  static void visit_state(Self& self, Visit&& visit) {
    visit(self.contacts_), visit(self.change_);
    visit(self.log_rate_);
    StepWatch::visit_state(self.steps_, visit);
    SeatWatch::visit_state(self.seat_, visit);
    OutputFilter::visit_state(self.filter_, visit);
    RootMotion::visit_state(self.root_, visit);
    Shaping::visit_state(self.shaping_, visit);
    Anatomy::visit_state(self.anatomy_, visit);
    FloorClearance::visit_state(self.floor_, visit);
    FreeFall::visit_state(self.fall_, visit);
    FootStance::visit_state(self.stance_, visit);
    FootLock::visit_state(self.foot_lock_, visit);
    LegsApart::visit_state(self.legs_, visit);
    LegsApart::visit_state(self.held_legs_, visit);
    HandContacts::visit_state(self.hands_, visit);
    ArmsClear::visit_state(self.arms_, visit);
  }

 private:
  StepWatch steps_;
  SeatWatch seat_;
  float log_rate_ = 0;  // See rate(), at the last step.
  OutputFilter filter_;
  RootMotion root_;
  Shaping shaping_;
  Anatomy anatomy_;
  FloorClearance floor_;
  FreeFall fall_;
  FootStance stance_;
  FootLock foot_lock_;
  LegsApart legs_, held_legs_;  // Before the feet are held, and after.
  HandContacts hands_;
  ArmsClear arms_;
  std::array<float, kFeet> contacts_{};
  BodyChange change_;
};

}  // namespace panache
