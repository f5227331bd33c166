#pragma once
// A jump on the canonical skeleton that obeys gravity.

#include <algorithm>
#include <cmath>

#include "clip/clip.h"
#include "rig/canonical_body.h"
#include "rig/humanoid.h"

namespace panache::test {

inline constexpr double kGravity = 9.81;  // m/s^2

// Stands, crouches, jumps on the spot and stands again. `height`: how high the hips rise in flight,
// metres.
class Jump {
 public:
  explicit Jump(double height = 0.25, double before = 3, double after = 1.5)
      : speed_(std::sqrt(2 * kGravity * height)), before_(before), after_(after) {}

  double take_off() const { return before_ + kCrouch + push(); }         // Seconds.
  double landing() const { return take_off() + 2 * speed_ / kGravity; }  // Likewise.
  double duration() const { return landing() + push() + kCrouch + after_; }
  // How high the hips are over where they stand, metres.
  double rise(double t) const {
    const auto smooth = [](double s) { return s <= 0 ? 0 : s >= 1 ? 1 : s * s * (3 - 2 * s); };
    if (t < before_ + kCrouch) return -kDepth * smooth((t - before_) / kCrouch);
    const double pull = speed_ * speed_ / (2 * kDepth);
    if (t < take_off()) return pull * std::pow(t - before_ - kCrouch, 2) / 2 - kDepth;
    const double flown = t - take_off(), landed = t - landing();
    if (landed < 0) return speed_ * flown - kGravity * flown * flown / 2;
    if (landed < push()) return pull * std::pow(landed, 2) / 2 - speed_ * landed;
    return -kDepth * (1 - smooth((landed - push()) / kCrouch));
  }
  Clip clip(double fps = 60) const {
    using enum HumanJoint;
    constexpr Vec3 x = {1, 0, 0}, z = {0, 0, 1};
    Clip clip;
    clip.skeleton = canonical_skeleton();
    clip.frame_time = 1 / fps;
    clip.resize(static_cast<int>(duration() * fps) + 1);
    const double upper = static_cast<double>(kProportions.length[index(left_lower_leg)]),
                 lower = static_cast<double>(kProportions.length[index(left_foot)]),
                 standing = 0.99 * (upper + lower);
    for (int f = 0; f < clip.frames; ++f) {
      const double risen = rise(f * clip.frame_time);
      const Pose pose = clip.pose(f);
      for (size_t j = 0; j < clip.joints(); ++j) {
        pose.rotations[j] = {};
        pose.translations[j] = clip.skeleton.joints[j].offset;
      }
      pose.translations[0].y += static_cast<float>(standing - upper - lower + risen);
      // The ankle stays under the hip: the law of cosines.
      const double leg = standing + std::min(risen, 0.0);
      const auto angle = [](double a, double b, double opposite) {
        return static_cast<float>(std::acos((a * a + b * b - opposite * opposite) / (2 * a * b)));
      };
      const float hip = angle(upper, leg, lower), ankle = angle(lower, leg, upper);
      const auto turn = [&](HumanJoint joint, Quat q) {
        pose.rotations[static_cast<size_t>(index(joint))] = q;
      };
      turn(left_upper_arm, axis_angle(z, -1.4f)), turn(right_upper_arm, axis_angle(z, 1.4f));
      for (const HumanJoint joint : {left_upper_leg, right_upper_leg}) {
        turn(joint, axis_angle(x, -hip));
      }
      for (const HumanJoint joint : {left_lower_leg, right_lower_leg}) {
        turn(joint, axis_angle(x, hip + ankle));
      }
      for (const HumanJoint joint : {left_foot, right_foot}) turn(joint, axis_angle(x, -ankle));
    }
    return clip;
  }

 private:
  static constexpr double kDepth = 0.2;   // Of the crouch, metres.
  static constexpr double kCrouch = 0.4;  // Seconds.
  double push() const { return 2 * kDepth / speed_; }

  double speed_;  // At take-off, m/s.
  double before_, after_;
};

}  // namespace panache::test
