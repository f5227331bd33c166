#include "style/stages/change_stages.h"

#include "style/stages/gesture_player.h"
#include "style/stages/lean.h"
#include "style/stages/shape.h"

namespace panache {
namespace {

// How each stage reads its inputs from the work of a step and stores its results there.

template <class Member>
void carry_out(Member& stage, StageWork& work) noexcept {
  stage.step(work);
}

void carry_out(StepWatch& steps, StageWork& work) noexcept {
  steps.step(work.now.world.positions, work.time);
  work.stepping = steps.amount();
}

void carry_out(SeatWatch& seat, StageWork& work) noexcept {
  seat.step(work.now.world.positions, work.time);
  work.seated = seat.amount();
}

void carry_out(OutputFilter& filter, StageWork& work) noexcept {
  const AskedChange& asked = work.asked;
  filter.step(asked.delta, asked.log_rate, asked.gate, work.now.body_frame, work.time);
  work.delta = &filter.delta();
  const float tempo = work.options.tempo_everywhere ? 1 : work.stepping;
  work.log_rate =
      bounded_log_rate(asked.shape->timing * tempo * filter.log_rate()) * (1 - work.flight);
}

void carry_out(RootMotion& root, StageWork& work) noexcept {
  if (work.options.root) {
    root.step(*work.delta, work.asked.gate, work.observer, work.window, work.time);
  }
  work.root = root.offset();
}

void carry_out(Shaping& shaping, StageWork& work) noexcept {
  work.above_floor = share_above_floor(work.now.world.positions);
  work.shape = *work.asked.shape;
  for (float& region : work.shape.regions) region *= work.above_floor;
  work.shape.regions[static_cast<size_t>(Region::legs)] *= 1 - work.seated;
  work.root = shaping.step(work.shape, *work.delta, work.root, work.time, work.change);
}

void carry_out(Gestures&, StageWork& work) noexcept {
  if (!work.asked.gesture) return;
  add_gesture(*work.asked.gesture, work.shape, work.body, work.change);
  work.lift = gesture_lift(*work.asked.gesture, work.shape);
}

void carry_out(Energy& energy, StageWork& work) noexcept {
  energy.step(work.body, work.shape.energy, work.above_floor, work.time, work.change);
}

void carry_out(Anatomy& anatomy, StageWork& work) noexcept {
  anatomy.step(work.body, work.observer.rig(), work.time, work.change);
}

void carry_out(Balance&, StageWork& work) noexcept {
  changed_joints(work.body, work.change, work.joints);
  // Not for the energy of the input alone, which leaves hips and legs to the bit.
  limit_fold(work.body, work.asked.amount, work.joints, work.change);
  keep_balance(work.body, work.asked.amount, work.joints, work.change);
}

void carry_out(LegsApart& legs, StageWork& work) noexcept {
  legs.step(work.body, work.asked.amount, work.stepping, {}, work.time, work.joints, work.change);
}

void carry_out(FloorClearance& floor, StageWork& work) noexcept {
  const float carried =
      work.above_floor * (1 - work.seated) * (1 - work.flight) * (1 - share_lifted(work.lift));
  work.raised = floor.step(work.now.world, work.joints, work.asked.amount, carried,
                           work.root.translation.y, work.time, work.change);
}

void carry_out(FreeFall& fall, StageWork& work) noexcept {
  fall.step(work.flight, work.time, work.change);
}

void carry_out(FootStance& stance, StageWork& work) noexcept {
  const float firmness = work.options.foot_lock ? work.asked.shape->foot_lock : 0;
  stance.step(work.body, work.joints, work.asked.stance, work.asked.amount * firmness,
              work.stepping, work.lift + work.root.translation.y, work.raised, work.flight,
              work.time, work.change);
  std::ranges::copy(stance.held(), work.resting.begin());
}

void carry_out(HandContacts& hands, StageWork& work) noexcept {
  work.free_arms = arm_rotations(work.change);
  hands.step(work.body, work.asked.shape->hand_contacts, work.arms(), work.time, work.joints,
             work.change);
  work.holds = hands.holds();
}

void carry_out(ArmsClear& arms, StageWork& work) noexcept {
  arms.step(work.body, work.arms(), work.holds, work.time, work.joints, work.change);
}

void carry_out(SteadyArms& arms, StageWork& work) noexcept {
  arms.step(work.free_arms, work.time, work.change);
}

}  // namespace

void ChangeStages::reset() noexcept {
  log_rate_ = 0;
  row_.each([](auto& stage) { stage.reset(); });
}

void ChangeStages::step(const AskedChange& asked, const StageOptions& options, float flight,
                        const Observer& observer, const InputWindow& window, const StepTime& time,
                        StageClock* clock) noexcept {
  StageWork work{{asked, options, flight, observer, window, time}, change_};
  auto number = static_cast<size_t>(Stage::first_of_row);
  row_.each([&](auto& stage) {
    carry_out(stage, work);
    tell(clock, static_cast<Stage>(number++));
  });
  log_rate_ = work.log_rate;
}

}  // namespace panache
