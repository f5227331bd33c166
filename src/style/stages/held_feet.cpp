#include "style/stages/held_feet.h"

#include <algorithm>

#include "pose/limb.h"
#include "style/stages/gesture_player.h"

namespace panache {

void HeldFeet::raise_released(StageWork& work) const noexcept {
  const float floor = toe_floor(work.body) - mid_hip(work.body).y - work.change.translation.y;
  bool any = false;
  for (int f = 0; f < kFeet; ++f) {
    const float depth = floor - work.joints[index(kToes[f])].y;
    if (!(released_[f] > 0 && depth > 0)) continue;
    const LimbJoints leg = leg_joints(f);
    reach_with_limb(leg, work.joints[leg.end] + Vec3{0, depth, 0}, work.joints, work.change);
    any = true;
  }
  if (any) changed_legs(work.body, work.change, work.joints);
}

void HeldFeet::step(StageWork& work) noexcept {
  const BodyPose& input = work.now.world;
  for (size_t f = 0; f < kFeet; ++f) {
    const float height = input.positions[index(kToes[f])].y;
    const float planted = planted_near_floor(work.asked.contacts[f], height);
    // A resting foot is planted, whatever the network's output.
    const float held = planted * (1 - share_lifted(work.lift));
    contacts_[f] = std::max(held, work.resting[f]);
  }
  if (work.options.foot_lock) {
    const BodyChange free = work.change;
    lock_.step(input, work.joints, contacts_, work.resting,
               work.asked.amount * work.asked.shape->foot_lock, work.root.translation.y + work.lift,
               {static_cast<float>(work.time.input), work.time.output}, work.change);
    keep_held_legs(work.body, free, work.time, released_, work.change);
  }
  changed_legs(work.body, work.change, work.joints);
  raise_released(work);
  legs_.step(work.body, work.asked.amount, work.stepping, contacts_, work.time, work.joints,
             work.change);
}

}  // namespace panache
