// The rigs of twelve makers are understood without help.

#include <gtest/gtest.h>

#include "rig/put_on.h"
#include "rig/rig.h"

namespace panache {
namespace {

using namespace test;

// A body that stands, steps and swings its arms a little: enough to tell what turns about what.
Clip moving_body() {
  const Skeleton body = canonical_skeleton();
  Clip out{body, 1.0 / 30, 40, {}, {}};
  for (int f = 0; f < out.frames; ++f) {
    const float swing = std::sin(static_cast<float>(f) * 0.3f);
    for (int j = 0; j < kHumanJoints; ++j) {
      using enum HumanJoint;
      const auto is = [&](HumanJoint joint) { return j == index(joint); };
      Vec3 turn;
      if (is(left_upper_arm)) turn = {0, 0.4f * swing, -1.2f};
      if (is(right_upper_arm)) turn = {0, 0.4f * swing, 1.2f};
      if (is(left_upper_leg)) turn = {-0.4f * swing, 0, 0};
      if (is(right_upper_leg)) turn = {0.4f * swing, 0, 0};
      if (is(left_lower_leg) || is(right_lower_leg)) turn = {0.3f, 0, 0};
      if (is(chest)) turn = {0.1f, 0.2f * swing, 0};
      out.rotations.push_back(exp_rotation(turn));
      out.translations.push_back(body.joints[j].offset);
    }
  }
  return out;
}

void expect_maps(const Clip& clip, const std::array<int, kHumanJoints>& want) {
  const Result<Rig> rig = Rig::create(clip);
  ASSERT_TRUE(rig.ok()) << rig.error().message;
  const auto name = [&](int joint) {
    return joint < 0 ? std::string("-") : clip.skeleton.joints[joint].name;
  };
  for (int j = 0; j < kHumanJoints; ++j) {
    EXPECT_EQ(name(rig->joints()[j]), name(want[j])) << human_joint_name(j);
  }
}

TEST(Makers, every_rig_maps_as_a_person_would_map_it) {
  for (const Maker& maker : makers()) {
    SCOPED_TRACE(maker.name);
    const Character character = put_on(maker, moving_body());
    expect_maps(character.clip, expected_joints(maker, character.clip));
  }
}

TEST(Makers, every_rig_maps_from_its_rest_pose_alone) {
  for (const Maker& maker : makers()) {
    SCOPED_TRACE(maker.name);
    Clip clip = put_on(maker, moving_body()).clip;
    clip.resize(1);
    for (size_t j = 0; j < clip.joints(); ++j) {
      clip.rotations[j] = clip.skeleton.joints[j].rest;
      clip.translations[j] = clip.skeleton.joints[j].offset;
    }
    expect_maps(clip, expected_joints(maker, clip));
  }
}

TEST(Makers, a_rig_whose_joints_are_shuffled_and_renamed_maps_by_its_shape) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    for (const Maker& maker : makers()) {
      // That arms hang on the neck and legs on the spine only its names tell.
      if (maker.name == std::string("3ds Max Biped")) continue;
      SCOPED_TRACE(maker.name + std::string(", seed ") + std::to_string(seed));
      const Character character = put_on(maker, moving_body());
      const Anonymous nameless = anonymous(character.clip, seed);
      std::array<int, kHumanJoints> want = expected_joints(maker, character.clip);
      for (int& joint : want) {
        const auto at = std::find(nameless.order.begin(), nameless.order.end(), joint);
        joint = joint < 0 ? -1 : static_cast<int>(at - nameless.order.begin());
      }
      const Result<Rig> rig = Rig::create(nameless.clip);
      ASSERT_TRUE(rig.ok()) << rig.error().message;
      const auto name = [&](int joint) {
        return joint < 0 ? std::string("-")
                         : character.clip.skeleton.joints[nameless.order[joint]].name;
      };
      for (int j = 0; j < kHumanJoints; ++j) {
        EXPECT_EQ(name(rig->joints()[j]), name(want[j])) << human_joint_name(j);
      }
    }
  }
}

}  // namespace
}  // namespace panache
