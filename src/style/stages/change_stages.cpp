#include "style/stages/change_stages.h"

#include <algorithm>

#include "style/rate.h"
#include "pose/changed_joints.h"
#include "style/stages/balance.h"
#include "style/stages/fold.h"

namespace panache {

void ChangeStages::reset() noexcept {
  log_rate_ = 0;
  steps_.reset();
  seat_.reset();
  filter_.reset();
  root_.reset();
  shaping_.reset();
  anatomy_.reset();
  floor_.reset();
  fall_.reset();
  stance_.reset();
  foot_lock_.reset();
  legs_.reset();
  held_legs_.reset();
  hands_.reset();
  arms_.reset();
}

void ChangeStages::step(const AskedChange& asked, const StageOptions& options, float flight,
                        const Observer& observer, const InputWindow& window, const StepTime& time,
                        StageClock* clock) noexcept {
  const Observation& now = observer.now();
  const HeadingBody body = now.world;
  steps_.step(now.world.positions, time);
  seat_.step(now.world.positions, time);
  filter_.step(asked.delta, asked.log_rate, asked.gate, now.body_frame, time);
  const float tempo = options.tempo_everywhere ? 1 : steps_.amount();
  log_rate_ = bounded_log_rate(asked.shape->timing * tempo * filter_.log_rate()) * (1 - flight);
  tell(clock, Stage::filter);
  if (options.root) root_.step(filter_.delta(), asked.gate, observer, window, time);
  tell(clock, Stage::root);
  Shape shape = *asked.shape;
  const float share = share_above_floor(now.world.positions);
  for (float& region : shape.regions) region *= share;
  shape.regions[static_cast<size_t>(Region::legs)] *= 1 - seat_.amount();
  shaping_.step(shape, filter_.delta(), root_.offset(), time, change_);
  float lifted = 0;
  if (asked.gesture) {
    add_gesture(*asked.gesture, shape, body, change_);
    lifted = share_lifted(*asked.gesture, shape);
  }
  tell(clock, Stage::shape);
  anatomy_.step(body, observer.rig(), time, change_);
  tell(clock, Stage::anatomy);
  HumanPositions joints;
  changed_joints(body, change_, joints);
  limit_fold(body, joints, change_);
  keep_balance(body, joints, change_);
  tell(clock, Stage::balance);
  legs_.step(body, asked.amount, steps_.amount(), {}, time, joints, change_);
  tell(clock, Stage::legs);
  const float carried = share * (1 - seat_.amount()) * (1 - flight) * (1 - lifted);
  floor_.step(now.world, joints, asked.amount, carried, time, change_);
  tell(clock, Stage::floor);
  fall_.step(flight, time, change_);
  tell(clock, Stage::fall);
  for (size_t f = 0; f < kFeet; ++f) {
    const float height = now.world.positions[index(kToes[f])].y;
    contacts_[f] = planted_near_floor(asked.contacts[f], height);
    // Nor is a foot held that turns its thigh further than a hip can.
    contacts_[f] *= (1 - anatomy_.thigh_share(f)) * (1 - lifted);
  }
  const float amount = asked.amount * asked.shape->foot_lock;
  if (options.foot_lock) {
    stance_.step(body, joints, asked.stance, amount * (1 - flight) * (1 - lifted), steps_.amount(),
                 time, change_);
    // A foot that rests is planted, whatever the network makes of it.
    for (size_t f = 0; f < kFeet; ++f) contacts_[f] = std::max(contacts_[f], stance_.held()[f]);
  }
  tell(clock, Stage::stance);
  if (options.foot_lock) {
    foot_lock_.step(now.world, joints, contacts_, stance_.held(), amount,
                    {static_cast<float>(time.input), time.output}, change_);
    anatomy_.watch_thighs(body, time, change_);
  }
  changed_legs(body, change_, joints);
  held_legs_.step(body, asked.amount, steps_.amount(), contacts_, time, joints, change_);
  tell(clock, Stage::feet);
  // An arm that keeps none of the style keeps its input, too.
  const auto arm = [&](Region region) {
    return asked.amount * std::min(1.0f, asked.shape->regions[static_cast<size_t>(region)]);
  };
  const std::array<float, 2> arms = {arm(Region::left_arm), arm(Region::right_arm)};
  if (options.hold_hands) hands_.step(body, arms, time, joints, change_);
  tell(clock, Stage::hands);
  arms_.step(body, arms, hands_.holds(), time, joints, change_);
  tell(clock, Stage::arms);
}

}  // namespace panache
