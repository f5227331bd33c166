#include "rig/posed_rig.h"

#include <cmath>

#include <gtest/gtest.h>

#include "make_clip.h"

namespace panache {
namespace {

TEST(MannequinTest, stands_where_the_rig_stands_and_shows_twist) {
  Clip clip = test::walking_clip(2);
  const auto hand = static_cast<size_t>(index(HumanJoint::left_hand));
  const auto arm = static_cast<size_t>(index(HumanJoint::left_lower_arm));
  clip.pose(1).rotations[hand] = axis_angle(Vec3{1, 0, 0}, 1.0f);
  // Local axes that are not those of the part.
  const Quat axes = axis_angle(Vec3{0, 0, 1}, 1.2f);
  Vec3& offset_in_file = clip.skeleton.joints[hand].offset;
  offset_in_file = rotate(conjugate(axes), offset_in_file);
  for (int f = 0; f < clip.frames; ++f) {
    const Pose pose = clip.pose(f);
    pose.rotations[arm] = pose.rotations[arm] * axes;
    pose.rotations[hand] = conjugate(axes) * pose.rotations[hand];
    pose.translations[hand] = offset_in_file;
  }
  Mannequin mannequin(*Rig::create(clip), clip.pose(0));
  std::array<float, kMannequinNumbers> before, after;
  mannequin.read(clip.pose(0), before);
  mannequin.read(clip.pose(1), after);
  const auto turn = [&](const std::array<float, kMannequinNumbers>& parts) {
    const float* q = &parts[kPartNumbers * hand + 3];
    return Quat{q[0], q[1], q[2], q[3]};
  };
  const float* lower = &after[kPartNumbers * arm + 3];
  const Quat relative = conjugate(Quat{lower[0], lower[1], lower[2], lower[3]}) * turn(after);
  EXPECT_NEAR(length(log_rotation(relative)), 1.0f, 1e-3f);
  // Each part's child is where its own frame says.
  const Vec3 offset = mannequin.offsets()[hand];
  const Vec3 place = rotate(Quat{lower[0], lower[1], lower[2], lower[3]}, offset);
  for (int k = 0; k < 3; ++k) {
    const float along = k == 0 ? place.x : k == 1 ? place.y : place.z;
    EXPECT_NEAR(after[kPartNumbers * hand + static_cast<size_t>(k)],
                after[kPartNumbers * arm + static_cast<size_t>(k)] + along, 1e-4f);
  }
}

}  // namespace
}  // namespace panache
