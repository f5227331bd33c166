// The energy of the input: from calm to lively, without touching hips, legs and course.

#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

#include "make_clip.h"
#include "make_model.h"
#include "style/stylizer.h"
#include "style_checks.h"

namespace panache {
namespace {

using enum HumanJoint;

class EnergyTest : public testing::Test {
 protected:
  // Eight seconds with this energy from the first frame on, without a style.
  Clip run(float energy) const {
    Stylizer stylizer = *Stylizer::create(read(test::make_model({"old"})), rig_);
    Shape shape;
    shape.energy = energy;
    stylizer.set_shape(shape);
    return played(stylizer, clip_, {0});
  }
  // How far a hand swings ahead of and behind the hips over the last four seconds, metres.
  double swing(const Clip& clip, HumanJoint hand) const {
    PosedRig rig(rig_);
    BodyPose body;
    float min = 9, max = -9;
    for (int f = clip.frames / 2; f < clip.frames; ++f) {
      rig.read(clip.pose(f), body);
      const Vec3 reach = body.joints[index(hand)] - body.joints[index(hips)];
      min = std::min(min, reach.z), max = std::max(max, reach.z);
    }
    return double{max - min};
  }

  void expect_same_legs(const Clip& out) const {
    for (int f = 0; f < clip_.frames; ++f) {
      const ConstPose a = clip_.pose(f), b = out.pose(f);
      ASSERT_EQ(a.translations[0], b.translations[0]) << f;
      for (const HumanJoint joint : {hips, left_upper_leg, left_lower_leg, left_foot, left_toes,
                                     right_upper_leg, right_lower_leg, right_foot, right_toes}) {
        ASSERT_EQ(a.rotations[index(joint)], b.rotations[index(joint)])
            << f << " " << human_joint_name(index(joint));
      }
    }
  }

  Clip clip_ = test::walking_clip(240);
  Rig rig_ = *Rig::create(clip_);
};

TEST_F(EnergyTest, of_1_is_the_input_bit_for_bit) { EXPECT_TRUE(test::same_bits(run(1), clip_)); }

TEST_F(EnergyTest, scales_the_swing_of_the_arms) {
  const double was = swing(clip_, left_hand);
  // A mean over 1.5 s still moves by a tenth of a swing of 1 s: 1 / (2 pi 1.5).
  EXPECT_LT(swing(run(0), left_hand), 0.2 * was);
  EXPECT_NEAR(swing(run(0.5f), left_hand), 0.5 * was, 0.1 * was);
  EXPECT_GT(swing(run(2), right_hand), 1.3 * was);
}

TEST_F(EnergyTest, leaves_hips_legs_and_course_alone_even_where_the_body_bends_far_down) {
  for (const float energy : {0.0f, 2.0f}) expect_same_legs(run(energy));
  for (int f = 0; f < clip_.frames; ++f) {
    const auto seconds = static_cast<float>(f * clip_.frame_time);
    clip_.pose(f).rotations[index(spine)] =
        axis_angle({1, 0, 0}, 0.8f * (1 - std::cos(2.5f * seconds)));
  }
  for (const float energy : {0.0f, 2.0f}) expect_same_legs(run(energy));
}

}  // namespace
}  // namespace panache
