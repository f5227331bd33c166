#include "character.h"

#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

#include "clip/bvh.h"
#include "clip/fk.h"
#include "make_clip.h"
#include "make_model.h"
#include "mannequin.h"
#include "recording.h"
#include "restyle_clip.h"
#include "style/restyle.h"

namespace panache::web {
namespace {

// Sure that both feet stand, so that the foot lock has something to do.
std::shared_ptr<const Model> random_model() {
  TensorFile file = test::make_model({"old", "proud"}, 3);
  file.tensors["contact.head.0.bias"].values = {10, 10};
  return *Model::parse(format_safetensors(file), "test model");
}

class CharacterTest : public testing::Test {
 protected:
  // All frames with these strengths and this shape, which begins to hold at frame `from`.
  Clip run(const Shape& shape, std::vector<float> strengths = {1, 0.5f}, int from = 0) const {
    Character character = *Character::create(random_model(), rig_);
    Clip out = clip_;
    for (int f = 0; f < clip_.frames; ++f) {
      character.step(clip_.pose(f), strengths, f < from ? Shape{} : shape, clip_.frame_time,
                     clip_.frame_time, out.pose(f));
    }
    return out;
  }
  Quat rotation(const Clip& clip, HumanJoint joint) const {
    return clip.pose(clip.frames - 1).rotations[static_cast<size_t>(index(joint))];
  }

  Clip clip_ = test::walking_clip(120);
  Rig rig_ = *Rig::create(clip_);
};

bool same_bits(const Clip& a, const Clip& b) {
  return a.rotations.size() == b.rotations.size() &&
         std::memcmp(a.rotations.data(), b.rotations.data(), a.rotations.size() * sizeof(Quat)) ==
             0 &&
         std::memcmp(a.translations.data(), b.translations.data(),
                     a.translations.size() * sizeof(Vec3)) == 0;
}

TEST_F(CharacterTest, with_all_of_a_style_is_what_the_library_makes_of_it_bit_for_bit) {
  Stylizer stylizer = *Stylizer::create(random_model(), rig_);
  Clip expected = clip_;
  for (int f = 0; f < clip_.frames; ++f) {
    const std::vector<float> strengths = {f < 40 ? 0.1f : 1.0f, 0};
    stylizer.step(clip_.pose(f), strengths, clip_.frame_time, expected.pose(f));
  }
  Character character = *Character::create(random_model(), rig_);
  Clip out = clip_;
  for (int f = 0; f < clip_.frames; ++f) {
    const std::vector<float> strengths = {f < 40 ? 0.1f : 1.0f, 0};
    character.step(clip_.pose(f), strengths, {}, clip_.frame_time, clip_.frame_time, out.pose(f));
  }
  EXPECT_TRUE(same_bits(out, expected));
  EXPECT_FALSE(same_bits(out, clip_));
  EXPECT_EQ(character.rate(), stylizer.rate());
}

TEST_F(CharacterTest, tells_how_far_the_styles_know_the_motion_as_the_stylizer_does) {
  TensorFile file = test::make_model({"old", "proud"}, 3);
  test::add_gate(file, 0.5f);
  const auto model = *Model::parse(format_safetensors(file), "test model");
  Stylizer stylizer = *Stylizer::create(model, rig_);
  Character character = *Character::create(model, rig_);
  Clip out = clip_;
  for (int f = 0; f < clip_.frames; ++f) {
    const std::vector<float> strengths = {1, 0};
    stylizer.step(clip_.pose(f), strengths, clip_.frame_time, out.pose(f));
    character.step(clip_.pose(f), strengths, {}, clip_.frame_time, clip_.frame_time, out.pose(f));
    EXPECT_EQ(character.gate(), stylizer.gate());
  }
  EXPECT_GT(character.gate(), 0);
  EXPECT_LT(character.gate(), 1);
}

TEST_F(CharacterTest, lets_the_feet_go_where_they_are_not_to_be_locked) {
  Shape shape;
  shape.foot_lock = 0;
  EXPECT_FALSE(same_bits(run(shape), run({})));
}

TEST_F(CharacterTest, without_a_style_is_the_input_bit_for_bit_whatever_the_shape) {
  Shape shape;
  shape.posture = 2;
  shape.dynamics = 0.5f;
  shape.regions = {0, 1, 0.5f, 2};
  EXPECT_TRUE(same_bits(run(shape, {0, 0}), clip_));
}

TEST_F(CharacterTest, leaves_a_region_that_is_off_as_the_input_has_it) {
  Shape shape;
  shape.regions[kArms] = 0;
  const Clip out = run(shape);
  // A rotation through a change and back, in floats: a few units in the last place of 1.
  constexpr float kRounding = 1e-6f;
  for (const HumanJoint joint : {HumanJoint::left_upper_arm, HumanJoint::right_lower_arm}) {
    EXPECT_GT(std::abs(dot(rotation(out, joint), rotation(clip_, joint))), 1 - kRounding);
    EXPECT_LT(std::abs(dot(rotation(run({}), joint), rotation(clip_, joint))), 1 - 1e-4f);
  }
  EXPECT_LT(std::abs(dot(rotation(out, HumanJoint::spine), rotation(clip_, HumanJoint::spine))),
            1 - 1e-4f);
}

TEST_F(CharacterTest, starts_no_more_at_a_step_for_arms_that_are_off_or_that_come_back) {
  // Legs and height are those of the whole style; only the lift above the floor is another.
  Shape shape;
  shape.regions[kArms] = 0;
  const auto start = [&](const Clip& clip) {
    float most = 0;
    for (int f = 12; f < clip.frames; ++f) {
      const auto height = [&](int frame) {
        return clip.pose(frame).translations[0].y - clip_.pose(frame).translations[0].y;
      };
      most = std::max(most, std::abs(height(f) - 2 * height(f - 1) + height(f - 2)));
    }
    return most;
  };
  // What is beyond the stylizer's lift is eased as that lift is: at most as much again. Were it
  // not, it would start nearly three times as much.
  EXPECT_LT(start(run(shape)), 2 * start(run({})));
  EXPECT_LT(start(run(shape, {1, 0.5f}, 60)), 2 * start(run({})));
}

TEST_F(CharacterTest, with_no_legs_goes_where_the_input_goes) {
  Shape shape;
  shape.regions[kLegs] = 0;
  shape.foot_lock = 0;
  const Vec3 end = run(shape).pose(119).translations[0];
  EXPECT_LT(length(end - clip_.pose(119).translations[0]), 1e-4f);
  EXPECT_GT(length(run({}).pose(119).translations[0] - clip_.pose(119).translations[0]), 0.01f);
}

TEST_F(CharacterTest, keeps_the_way_that_it_has_gone_where_the_legs_are_left_alone_from_now_on) {
  Shape shape;
  shape.regions[kLegs] = 0;
  const Clip out = run(shape, {1, 0.5f}, 60);
  const auto beyond_input = [&](int frame) {
    const Vec3 way = out.pose(frame).translations[0] - clip_.pose(frame).translations[0];
    return Vec3{way.x, 0, way.z};
  };
  // Half a second after the change it is eased in to 3 %, and the rest is a matter of millimetres.
  EXPECT_GT(length(beyond_input(75)), 0.02f);
  EXPECT_LT(length(beyond_input(119) - beyond_input(75)), 0.005f);
}

TEST_F(CharacterTest, with_posture_and_dynamics_at_nothing_leaves_the_pose) {
  Shape shape;
  shape.posture = shape.dynamics = shape.foot_lock = 0;
  const Clip out = run(shape);
  for (size_t j = 0; j < clip_.joints(); ++j) {
    EXPECT_GT(std::abs(dot(out.pose(119).rotations[j], clip_.pose(119).rotations[j])), 1 - 1e-6f);
  }
}

TEST_F(CharacterTest, without_dynamics_changes_by_what_lasts) {
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

TEST_F(CharacterTest, restyles_a_clip_as_the_library_does) {
  const std::vector<float> strengths = {1, 0};
  const auto ours = restyle_clip(clip_, rig_, random_model(), strengths, {});
  const auto theirs = restyle(clip_, rig_, random_model(), {{0, {{0, 1.0f}}}});
  ASSERT_TRUE(ours.ok() && theirs.ok());
  EXPECT_TRUE(same_bits(ours->clip, theirs->clip));
  EXPECT_EQ(ours->source_frames, theirs->source_frames);
}

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

TEST(RecordingTest, keeps_the_last_seconds_at_an_even_rate) {
  const Clip clip = test::walking_clip(300, 100);
  Recording recording(clip.skeleton, 1.0);
  EXPECT_EQ(recording.clip(60).frames, 0);
  for (int f = 0; f < clip.frames; ++f) recording.add(clip.pose(f), f % 2 ? 0.015 : 0.005);
  const Clip out = recording.clip(50);
  EXPECT_EQ(out.frames, 51);
  // 1.2 m/s, of which each frame takes a hundredth of a second: a metre and a fifth in the last
  // second, to the unevenness of a frame.
  const Vec3 way = out.pose(50).translations[0] - out.pose(0).translations[0];
  EXPECT_NEAR(way.z, 1.2f, 0.012f);
}

}  // namespace
}  // namespace panache::web
