#include "rig/rig.h"

#include <gtest/gtest.h>

#include <limits>

#include "count_allocations.h"
#include "rig/rig_checks.h"

namespace panache {
namespace {

using namespace test;
using enum HumanJoint;

// Joints above the hips, of no length, twist joints, fingers, a prop, no right clavicle, no toes.
MadeUp awkward() {
  return make_up(tree(R"(
World, hips 0 > Reference, hips 0.5 > Pelvis, hips 0.9 > *HipJoint, hips 0.9 > *Thigh, leftUpperLeg
  > *Shin, leftLowerLeg > *ShinTwist, leftFoot 0.5 > *Foot, leftFoot;
Pelvis > Waist, spine 0.3 > Belly, spine > Ribs, chest > Head, head > Hat, head 2;
Ribs > LeftCollar, leftShoulder;
Ribs > *Arm, leftUpperArm > *ArmTwist, leftLowerArm 0.5 > *Elbow, leftLowerArm > *Hand, leftHand
  > *Finger1, leftHand 1.2 > *Finger2, leftHand 1.3)"),
                 "Left", "Right");
}

TEST(Rig, reads_the_canonical_skeleton_as_itself) {
  const Clip clip = random_clip(canonical_skeleton(), 50, 0.5f, 5);
  const Clip rest = rest_clip(clip.skeleton);
  PosedRig rig(rig_of(rest));
  BodyPose body;
  rig.read(rest.pose(0), body);
  EXPECT_NEAR(rig.rig().floor(), 0, 1e-6f);
  EXPECT_EQ(body.facing, 0);
  const HumanPositions want = t_pose();
  for (int j = 0; j < kHumanJoints; ++j) {
    EXPECT_LT(length(body.positions[j] - want[j]), 2e-6f) << human_joint_name(j);
    EXPECT_LT(length(body.joints[j] - want[j]), 2e-6f) << human_joint_name(j);
  }
  PosedRig moving(rig_of(clip));
  for (int f = 0; f < clip.frames; ++f) {
    moving.read(clip.pose(f), body);
    expect_canonical(body);
    // The toe joints point where the user's do.
    EXPECT_LT(angle_deg(limb(body.positions, left_toes), limb(body.joints, left_toes)), 1e-3);
  }
}

TEST(Rig, a_canonical_body_whose_shoulders_rest_is_read_as_itself_in_any_pose) {
  Clip clip = random_clip(canonical_skeleton(), 200, 0.8f, 19);
  for (int f = 0; f < clip.frames; ++f) {
    for (HumanJoint joint : {left_shoulder, right_shoulder}) {
      clip.pose(f).rotations[index(joint)] = {};
    }
  }
  PosedRig rig(rig_of(clip));
  BodyPose body;
  for (int f = 0; f < clip.frames; ++f) {
    rig.read(clip.pose(f), body);
    for (int j = 0; j < kHumanJoints; ++j) {
      // The hips lie on the line from mid-hip to mid-shoulder, which a bent torso tilts.
      if (j == index(hips)) continue;
      EXPECT_LT(length(body.positions[j] - body.joints[j]), 1e-5f) << human_joint_name(j);
    }
  }
}

TEST(Rig, facing_is_the_heading_of_the_body) {
  const Clip clip = random_clip(canonical_skeleton(), 1, 0, 6);
  PosedRig rig(rig_of(clip));
  PoseBuffer turned(clip.joints());
  BodyPose body;
  for (float angle : {0.0f, 0.5f, 1.5f, 3.0f, -2.0f, -0.1f}) {
    std::copy(clip.rotations.begin(), clip.rotations.end(), turned.rotations.begin());
    std::copy(clip.translations.begin(), clip.translations.end(), turned.translations.begin());
    turned.rotations[0] = rotation_y(angle);
    rig.read(turned.pose(), body);
    EXPECT_NEAR(body.facing, angle, 1e-5f);
  }
  // On its side the body faces nowhere: the last heading holds.
  turned.rotations[0] = exp_rotation(Vec3{0, 0, 1.57079633f});
  rig.read(turned.pose(), body);
  EXPECT_NEAR(body.facing, -0.1f, 1e-5f);
  // So does it within a degree or two of that; at ten degrees the heading shows again.
  const float down = 1.57079633f;
  turned.rotations[0] = rotation_y(2.0f) * exp_rotation(Vec3{0, 0, down - 0.02f});
  rig.read(turned.pose(), body);
  EXPECT_NEAR(body.facing, -0.1f, 1e-5f);
  turned.rotations[0] = rotation_y(2.0f) * exp_rotation(Vec3{0, 0, down - 0.17f});
  rig.read(turned.pose(), body);
  EXPECT_NEAR(body.facing, 2, 1e-4f);
}

TEST(Rig, the_trunk_is_resampled_along_its_bend) {
  const MadeUp made = awkward();
  const Clip clip = random_clip(made.skeleton, 50, 0.6f, 7);
  PosedRig rig(rig_of(clip));
  BodyPose body;
  const Proportions& own = kProportions;
  for (int f = 0; f < clip.frames; ++f) {
    rig.read(clip.pose(f), body);
    const auto at = [&](HumanJoint joint) { return body.positions[index(joint)]; };
    // A chord is never longer than the line it spans.
    EXPECT_LE(length(at(spine) - mid_hip(body.positions)), own.torso * own.spine_fraction + 1e-5f);
    EXPECT_LE(length(at(chest) - at(spine)),
              own.torso * (own.chest_fraction - own.spine_fraction) + 1e-5f);
    EXPECT_NEAR(length(mid_hip(body.positions) - at(hips)), length(own.hips_to_mid_hip), 1e-5f);
    const Vec3 shoulders = (at(left_upper_arm) + at(right_upper_arm)) * 0.5f;
    EXPECT_NEAR(length(at(left_upper_arm) - shoulders), own.half_shoulders, 1e-5f);
  }
}

TEST(Rig, without_a_neck_the_head_points_away_from_the_shoulders) {
  const Clip clip = random_clip(awkward().skeleton, 50, 0.6f, 20);
  PosedRig rig(rig_of(clip));
  ASSERT_EQ(rig.rig().joints()[index(neck)], -1);
  BodyPose body;
  for (int f = 0; f < clip.frames; ++f) {
    rig.read(clip.pose(f), body);
    const auto own = [&](HumanJoint joint) { return body.joints[index(joint)]; };
    const Vec3 shoulders = (own(left_upper_arm) + own(right_upper_arm)) * 0.5f;
    EXPECT_LT(angle_deg(limb(body.positions, head), own(head) - shoulders), 1e-3);
  }
}

TEST(Rig, no_change_gives_the_pose_back_bit_for_bit) {
  for (const Skeleton& skeleton : {canonical_skeleton(), awkward().skeleton}) {
    Clip clip = random_clip(skeleton, 300, 2.0f, 8);
    // Minus zeros, and numbers whose length is not one to the last bit.
    for (size_t i = 0; i < clip.rotations.size(); i += 5) {
      clip.rotations[i] = {-0.0f, -0.0f, -0.0f, i % 2 ? 1.0f : -1.0f};
    }
    for (size_t i = 0; i < clip.rotations.size(); i += 3 * clip.joints()) {
      clip.translations[i] = {-0.0f, clip.translations[i].y, -0.0f};
    }
    for (size_t i = 1; i < clip.rotations.size(); i += 5) {
      clip.rotations[i].x = std::nextafter(clip.rotations[i].x, 2.0f);
    }
    PosedRig rig(rig_of(clip));
    PoseBuffer out(clip.joints());
    for (int f = 0; f < clip.frames; ++f) ASSERT_TRUE(unchanged(rig, clip.pose(f), out.pose()));
  }
}

TEST(Rig, a_change_turns_every_limb_as_it_says) {
  for (const Skeleton& skeleton : {canonical_skeleton(), awkward().skeleton}) {
    const Clip clip = random_clip(skeleton, 200, 0.7f, 9);
    PosedRig rig(rig_of(clip));
    std::mt19937 random(9);
    PoseBuffer out(clip.joints());
    for (int f = 0; f < clip.frames; ++f) {
      const BodyChange change = random_change(random);
      const Deviation off = deviation(rig, clip, clip.pose(f), change, out.pose());
      ASSERT_LT(off.limb_deg, 1e-3);
      ASSERT_LT(off.rotation_deg, 1e-3);
      ASSERT_LT(off.mid_hip, 1e-5);
      for (const Quat& q : out.rotations) ASSERT_NEAR(dot(q, q), 1, 1e-5f);
    }
  }
}

TEST(Rig, a_change_is_the_same_in_every_axes_and_unit) {
  const Clip clip = random_clip(canonical_skeleton(), 40, 0.4f, 10);
  const Clip z_up = in_axes(clip, exp_rotation(Vec3{1.57079633f, 0, 0}), 40);
  PosedRig rig(rig_of(z_up));
  ASSERT_EQ(rig.rig().up_axis(), "+Z");
  std::mt19937 random(10);
  PoseBuffer out(clip.joints());
  for (int f = 0; f < clip.frames; ++f) {
    const Deviation off = deviation(rig, z_up, z_up.pose(f), random_change(random), out.pose());
    ASSERT_LT(off.limb_deg, 1e-3);
    ASSERT_LT(off.mid_hip, 1e-5);
  }
}

TEST(Rig, what_is_not_the_humanoid_keeps_its_local_rotation) {
  const MadeUp made = awkward();
  const Clip clip = random_clip(made.skeleton, 20, 0.7f, 11);
  PosedRig rig(rig_of(clip));
  std::mt19937 random(11);
  PoseBuffer out(clip.joints());
  std::vector<bool> mapped(clip.joints());
  for (int joint : rig.rig().joints()) {
    if (joint >= 0) mapped[joint] = true;
  }
  for (int f = 0; f < clip.frames; ++f) {
    BodyPose body;
    rig.read(clip.pose(f), body);
    rig.write(clip.pose(f), body, random_change(random), out.pose());
    int kept = 0, moved = 0;
    for (size_t j = 0; j < clip.joints(); ++j) {
      const bool same = same_bits(out.rotations[j], clip.pose(f).rotations[j]);
      EXPECT_EQ(same, !mapped[j]) << clip.skeleton.joints[j].name;
      kept += same;
      moved += !same_bits(out.translations[j], clip.pose(f).translations[j]);
    }
    EXPECT_GE(kept, 12);
    EXPECT_EQ(moved, 1);
  }
}

TEST(Rig, a_turn_alone_changes_the_hips_and_nothing_else) {
  const Clip clip = random_clip(canonical_skeleton(), 20, 0.7f, 12);
  PosedRig rig(rig_of(clip));
  PoseBuffer out(clip.joints());
  BodyChange change;
  change.turn = 0.7f;
  for (int f = 0; f < clip.frames; ++f) {
    const Deviation off = deviation(rig, clip, clip.pose(f), change, out.pose());
    EXPECT_LT(off.mid_hip, 1e-5);
    for (size_t j = 1; j < clip.joints(); ++j) {
      EXPECT_TRUE(same_bits(out.rotations[j], clip.pose(f).rotations[j]));
    }
    EXPECT_FALSE(same_bits(out.rotations[0], clip.pose(f).rotations[0]));
  }
}

TEST(Rig, a_translation_alone_moves_one_joint_and_turns_none) {
  for (const char* mover : {"Pelvis", "Reference", "World"}) {
    MadeUp made = awkward();
    for (Joint& joint : made.skeleton.joints) joint.can_translate = joint.name == mover;
    const Clip clip = random_clip(made.skeleton, 20, 0.7f, 13);
    PosedRig rig(rig_of(clip));
    PoseBuffer out(clip.joints());
    BodyChange change;
    change.translation = {0.1f, -0.2f, 0.3f};
    for (int f = 0; f < clip.frames; ++f) {
      EXPECT_LT(deviation(rig, clip, clip.pose(f), change, out.pose()).mid_hip, 1e-5);
      for (size_t j = 0; j < clip.joints(); ++j) {
        EXPECT_TRUE(same_bits(out.rotations[j], clip.pose(f).rotations[j]));
        const bool moves = clip.skeleton.joints[j].name == mover;
        EXPECT_EQ(same_bits(out.translations[j], clip.pose(f).translations[j]), !moves);
      }
    }
  }
}

TEST(Rig, a_character_that_cannot_move_stays) {
  MadeUp made = awkward();
  for (Joint& joint : made.skeleton.joints) joint.can_translate = false;
  const Clip clip = random_clip(made.skeleton, 5, 0.7f, 14);
  PosedRig rig(rig_of(clip));
  EXPECT_EQ(rig.rig().notes().back(),
            "neither the hips nor a joint above them are animated (no translation channels)");
  std::mt19937 random(14);
  PoseBuffer out(clip.joints());
  BodyPose body;
  rig.read(clip.pose(3), body);
  rig.write(clip.pose(3), body, random_change(random), out.pose());
  for (size_t j = 0; j < clip.joints(); ++j) {
    EXPECT_TRUE(same_bits(out.translations[j], clip.pose(3).translations[j]));
  }
}

TEST(Rig, a_joint_that_the_file_does_not_rotate_follows_its_parent) {
  Skeleton skeleton = canonical_skeleton();
  skeleton.joints[index(left_hand)].can_rotate = false;
  skeleton.joints[index(spine)].can_rotate = false;
  const Clip clip = random_clip(skeleton, 20, 0.7f, 15);
  PosedRig rig(rig_of(clip));
  std::mt19937 random(15);
  PoseBuffer out(clip.joints());
  for (int f = 0; f < clip.frames; ++f) {
    const Deviation off = deviation(rig, clip, clip.pose(f), random_change(random), out.pose());
    EXPECT_LT(off.rotation_deg, 1e-3);
    EXPECT_TRUE(same_bits(out.rotations[index(spine)], clip.pose(f).rotations[index(spine)]));
  }
}

TEST(Rig, poses_that_are_not_finite_are_read_as_the_last_one_that_was) {
  const Clip clip = random_clip(awkward().skeleton, 2, 0.5f, 16);
  PosedRig rig(rig_of(clip));
  RotatedBodyPose good, got;
  rig.read(clip.pose(1), good);
  const float bad[] = {NAN, INFINITY, -INFINITY, std::numeric_limits<float>::max()};
  PoseBuffer in(clip.joints()), out(clip.joints());
  std::mt19937 random(16);
  for (size_t j = 0; j < clip.joints(); ++j) {
    for (float value : bad) {
      std::ranges::copy(clip.pose(0).rotations, in.rotations.begin());
      std::ranges::copy(clip.pose(0).translations, in.translations.begin());
      in.rotations[j].x = value;
      in.translations[j].y = value;
      rig.read(in.pose(), got);
      for (int h = 0; h < kHumanJoints; ++h) {
        ASSERT_TRUE(is_finite(got.positions[h]));
        ASSERT_TRUE(is_finite(got.rotations[h]));
        ASSERT_TRUE(is_finite(got.joints[h]));
      }
      ASSERT_TRUE(std::isfinite(got.facing));
      rig.write(in.pose(), got, random_change(random), out.pose());
      ASSERT_TRUE(unchanged(rig, in.pose(), out.pose()));
    }
  }
  // All in one place: no directions, but numbers.
  std::fill(in.rotations.begin(), in.rotations.end(), Quat{0, 0, 0, 0});
  std::fill(in.translations.begin(), in.translations.end(), Vec3{});
  rig.read(in.pose(), got);
  for (const Vec3& p : got.positions) ASSERT_TRUE(is_finite(p));
  expect_canonical(good);
}

TEST(Rig, reading_and_writing_allocate_nothing) {
  const Clip clip = random_clip(awkward().skeleton, 20, 0.7f, 17);
  PosedRig rig(rig_of(clip));
  std::mt19937 random(17);
  const BodyChange change = random_change(random);
  PoseBuffer out(clip.joints());
  BodyPose body;
  const long before = allocations;
  for (int f = 0; f < clip.frames; ++f) {
    rig.read(clip.pose(f), body);
    rig.write(clip.pose(f), body, change, out.pose());
  }
  EXPECT_EQ(allocations, before);
  EXPECT_GT(allocations, 0);
}

TEST(Rig, the_root_turns_and_moves_all_of_the_body) {
  // Two roots, and the file has z up and centimetres.
  Skeleton skeleton = canonical_skeleton();
  Joint prop;
  prop.name = "Prop";
  prop.offset = {1, 2, -0.5f};
  skeleton.joints.push_back(prop);
  const size_t joints = skeleton.joints.size();
  const Clip two =
      in_axes(random_clip(skeleton, 10, 0.7f, 20), exp_rotation(Vec3{1.57079633f, 0, 0}), 100);
  RigOptions options;
  options.up_axis = "+Z";
  options.metres_per_unit = 0.01f;
  Result<Rig> created = Rig::create(two, options);
  ASSERT_TRUE(created.ok()) << created.error().message;
  PosedRig rig(*created);
  const float turn = 0.8f;
  const Vec3 about = {0.5f, 0, -1}, move = {0.25f, 0.125f, -2};
  PoseBuffer out(joints);
  for (int f = 0; f < two.frames; ++f) {
    BodyPose before, after;
    std::ranges::copy(two.pose(f).rotations, out.rotations.begin());
    std::ranges::copy(two.pose(f).translations, out.translations.begin());
    rig.read(out.pose(), before);
    created->transform_root(turn, about, move, out.pose());
    rig.read(out.pose(), after);
    for (int j = 0; j < kHumanJoints; ++j) {
      const Vec3 want = rotate(rotation_y(turn), before.positions[j] - about) + about + move;
      // Rounding of places of up to 300 cm, a few times.
      EXPECT_LT(length(after.positions[j] - want), 1e-5f) << human_joint_name(j);
    }
    // (1, 2, -0.5) in metres and Y up, turned likewise.
    const Vec3 expected = rotate(rotation_y(turn), Vec3{1, 2, -0.5f} - about) + about + move;
    const Vec3 at = out.translations[joints - 1] * 0.01f;
    EXPECT_LT(length(Vec3{at.x, at.z, -at.y} - expected), 1e-5f);
    std::ranges::copy(two.pose(f).translations, out.translations.begin());
    std::ranges::copy(two.pose(f).rotations, out.rotations.begin());
    created->transform_root(0, about, {}, out.pose());
    for (size_t j = 0; j < joints; ++j) {
      EXPECT_TRUE(same_bits(out.rotations[j], two.pose(f).rotations[j]));
      EXPECT_TRUE(same_bits(out.translations[j], two.pose(f).translations[j]));
    }
  }
}

TEST(Rig, a_joint_that_is_named_must_be_there_once) {
  Clip clip = awkward().clip();
  const auto rejection = [&](const std::string& name) {
    RigOptions options;
    options.joints = {{index(left_hand), name}};
    return rejection_of(clip, options);
  };
  EXPECT_EQ(rejection("LeftHand"), "");
  EXPECT_EQ(rejection("Paw"), "there is no joint 'Paw' that could be leftHand");
  clip.skeleton.joints.back().name = "LeftHand";
  EXPECT_EQ(rejection("LeftHand"),
            "more than one joint is called 'LeftHand', so it cannot be named as leftHand");
}

TEST(Rig, tells_how_it_was_understood) {
  const MadeUp made = awkward();
  const Clip clip = random_clip(made.skeleton, 2, 0.1f, 18);
  const std::vector<JointMatch> matches = rig_of(clip).matches();
  ASSERT_EQ(matches.size(), size_t{kHumanJoints});
  EXPECT_EQ(matches[index(left_lower_leg)].human_joint, "leftLowerLeg");
  EXPECT_EQ(matches[index(left_lower_leg)].joint, "LeftShin");
  EXPECT_EQ(matches[index(left_lower_leg)].reason, "next joint above leftFoot");
  EXPECT_EQ(matches[index(right_toes)].joint, "");
  EXPECT_EQ(matches[index(right_toes)].reason, "missing");
}

}  // namespace
}  // namespace panache
