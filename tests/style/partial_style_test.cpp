#include "style/stages/shape.h"

#include <cmath>

#include <gtest/gtest.h>

#include "make_clip.h"
#include "make_model.h"
#include "style/stylizer.h"
#include "style_checks.h"

namespace panache {
namespace {

using test::same_bits;

// Sure that both feet stand, so that the foot lock has something to do.
std::shared_ptr<const Model> random_model() {
  TensorFile file = test::make_model({"old", "proud"}, 3);
  file.tensors["contact.head.0.bias"].values = {10, 10};
  return read(file);
}

class PartialStyle : public testing::Test {
 protected:
  // All frames with these strengths and this shape, which begins to hold at frame `from`.
  Clip run(const Shape& shape, std::vector<float> strengths = {1, 0.5f}, int from = 0) const {
    Stylizer stylizer = *Stylizer::create(random_model(), rig_);
    Clip out = clip_;
    for (int f = 0; f < clip_.frames; ++f) {
      stylizer.set_shape(f < from ? Shape{} : shape);
      stylizer.step(clip_.pose(f), strengths, clip_.frame_time, out.pose(f));
    }
    return out;
  }
  Quat rotation(const Clip& clip, HumanJoint joint) const {
    return clip.pose(clip.frames - 1).rotations[static_cast<size_t>(index(joint))];
  }

  Clip clip_ = test::walking_clip(120);
  Rig rig_ = *Rig::create(clip_);
};

float& part(Shape& shape, Region region) { return shape.regions[static_cast<size_t>(region)]; }

TEST_F(PartialStyle, lets_the_feet_go_where_they_are_not_to_be_locked) {
  Shape shape;
  shape.foot_lock = 0;
  EXPECT_FALSE(same_bits(run(shape), run({})));
}

TEST_F(PartialStyle, without_a_style_is_the_input_bit_for_bit_whatever_the_shape) {
  Shape shape;
  shape.posture = 2;
  shape.dynamics = 0.5f;
  shape.strength = 2;
  shape.regions = {0, 1, 0.5f, 2};
  EXPECT_TRUE(same_bits(run(shape, {0, 0}), clip_));
}

TEST_F(PartialStyle, leaves_an_arm_that_is_off_as_the_input_has_it_and_styles_the_rest) {
  for (const Region region : {Region::left_arm, Region::right_arm}) {
    Shape shape;
    part(shape, region) = 0;
    const Clip out = run(shape);
    for (const auto& [joint, of] : {std::pair{HumanJoint::left_upper_arm, Region::left_arm},
                                    {HumanJoint::left_lower_arm, Region::left_arm},
                                    {HumanJoint::right_lower_arm, Region::right_arm},
                                    {HumanJoint::spine, Region::torso}}) {
      const float change = 1 - std::abs(dot(rotation(out, joint), rotation(clip_, joint)));
      // A rotation through a change and back, in floats: a few units in the last place of 1.
      EXPECT_TRUE(of == region ? change < 1e-6f : change > 1e-4f)
          << human_joint_name(index(joint)) << ": " << change;
    }
  }
}

TEST_F(PartialStyle, starts_no_more_at_a_step_for_arms_that_are_off_or_that_come_back) {
  // Legs and height are those of the whole style; only the lift above the floor is another.
  Shape shape;
  part(shape, Region::left_arm) = part(shape, Region::right_arm) = 0;
  const auto start = [&](const Clip& clip) {
    float max = 0;
    for (int f = 12; f < clip.frames; ++f) {
      const auto height = [&](int frame) {
        return clip.pose(frame).translations[0].y - clip_.pose(frame).translations[0].y;
      };
      max = std::max(max, std::abs(height(f) - 2 * height(f - 1) + height(f - 2)));
    }
    return max;
  };
  // The lift is eased whatever the shape. Were it not, it would start nearly three times as much.
  EXPECT_LT(start(run(shape)), 2 * start(run({})));
  EXPECT_LT(start(run(shape, {1, 0.5f}, 60)), 2 * start(run({})));
}

TEST_F(PartialStyle, with_no_legs_goes_where_the_input_goes) {
  Shape shape;
  part(shape, Region::legs) = 0;
  shape.foot_lock = 0;
  const Vec3 end = run(shape).pose(119).translations[0];
  EXPECT_LT(length(end - clip_.pose(119).translations[0]), 1e-4f);
  EXPECT_GT(length(run({}).pose(119).translations[0] - clip_.pose(119).translations[0]), 0.01f);
}

TEST_F(PartialStyle, keeps_the_way_that_it_has_gone_where_the_legs_are_left_alone_from_now_on) {
  Shape shape;
  part(shape, Region::legs) = 0;
  const Clip out = run(shape, {1, 0.5f}, 60);
  const auto beyond_input = [&](int frame) {
    const Vec3 travel = out.pose(frame).translations[0] - clip_.pose(frame).translations[0];
    return Vec3{travel.x, 0, travel.z};
  };
  // Half a second after the change it is eased in to 3 %, and the rest is a matter of millimetres.
  EXPECT_GT(length(beyond_input(75)), 0.02f);
  EXPECT_LT(length(beyond_input(119) - beyond_input(75)), 0.005f);
}

TEST_F(PartialStyle, with_posture_and_dynamics_at_nothing_leaves_the_pose) {
  Shape shape;
  shape.posture = shape.dynamics = shape.foot_lock = 0;
  const Clip out = run(shape);
  for (size_t j = 0; j < clip_.joints(); ++j) {
    EXPECT_GT(std::abs(dot(out.pose(119).rotations[j], clip_.pose(119).rotations[j])), 1 - 1e-6f);
  }
}

TEST_F(PartialStyle, without_dynamics_changes_by_what_lasts) {
  // The change of a joint from frame to frame, beyond the input's own.
  const auto unrest = [&](const Clip& clip) {
    float sum = 0;
    const auto joint = static_cast<size_t>(index(HumanJoint::spine));
    for (int f = 61; f < clip.frames; ++f) {
      const Quat step =
          conjugate(clip.pose(f - 1).rotations[joint]) * clip.pose(f).rotations[joint];
      sum += length(log_rotation(step));
    }
    return sum;
  };
  Shape shape;
  shape.dynamics = 0;
  EXPECT_LT(unrest(run(shape)), 0.5f * unrest(run({})));
}

TEST_F(PartialStyle, strength_is_that_of_all_styles) {
  Shape half;
  half.strength = 0.5f;
  EXPECT_TRUE(same_bits(run(half, {1, 0.5f}), run({}, {0.5f, 0.25f})));
}

TEST_F(PartialStyle, timing_scales_the_logarithm_of_the_rate_within_its_range) {
  const auto rate = [&](float timing) {
    TensorFile file = test::make_model({"old", "proud"}, 3);
    file.tensors["timing.head.0.bias"].values = {0.3f};
    StylizerOptions options;
    options.tempo_everywhere = true;
    Stylizer stylizer = *Stylizer::create(read(file), rig_, options);
    Shape shape;
    shape.timing = timing;
    stylizer.set_shape(shape);
    Clip out = clip_;
    stylizer.step(clip_.pose(0), std::vector<float>{1, 0}, clip_.frame_time, out.pose(0));
    return std::log(stylizer.rate());
  };
  const double whole = rate(1);
  ASSERT_GT(std::abs(whole), 0.1);
  EXPECT_NEAR(rate(0.5f), whole / 2, 1e-6);
  EXPECT_EQ(rate(0), 0);
}

TEST_F(PartialStyle, numbers_that_are_none_count_as_one) {
  Shape odd;
  odd.strength = odd.posture = odd.dynamics = std::nanf("");
  part(odd, Region::legs) = INFINITY;
  EXPECT_TRUE(same_bits(run(odd), run({})));
}

}  // namespace
}  // namespace panache
