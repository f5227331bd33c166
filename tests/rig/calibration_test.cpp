#include "rig/calibration.h"

#include <algorithm>
#include <functional>
#include <tuple>

#include <gtest/gtest.h>

#include "rig/figures.h"
#include "rig/rig_checks.h"

namespace panache {
namespace {

using namespace test;
using enum HumanJoint;

bool has_note(const std::vector<std::string>& notes, const std::string& part) {
  return std::ranges::any_of(notes, [&](const std::string& n) { return n.find(part) != n.npos; });
}

TEST(Calibration, a_body_that_lies_for_most_of_a_clip_still_shows_what_is_up) {
  Clip clip = random_clip(canonical_skeleton(), 60, 0.2f, 2);
  const float h = std::sqrt(0.5f);
  const Clip lying = in_axes(clip, {h, 0, 0, h}, 1, {0, 0.2f, 0});
  for (int f = 0; f < 54; ++f)
    std::ranges::copy(lying.pose(f).rotations, clip.pose(f).rotations.begin());
  EXPECT_EQ(rig_of(clip).up_axis(), "+Y");
}

TEST(Calibration, any_axis_may_be_up_and_any_unit_a_metre) {
  const Clip clip = random_clip(canonical_skeleton(), 60, 0.4f, 2);
  const float h = std::sqrt(0.5f);
  const std::pair<const char*, Quat> axes[] = {{"+Y", {}},
                                               {"-Y", {1, 0, 0, 0}},
                                               {"+Z", {h, 0, 0, h}},
                                               {"-Z", {-h, 0, 0, h}},
                                               {"+X", {0, 0, -h, h}},
                                               {"-X", {0, 0, h, h}}};
  PosedRig plain(rig_of(clip));
  EXPECT_EQ(plain.rig().up_axis(), "+Y");
  EXPECT_NEAR(plain.rig().scale(), 1, 1e-5f);
  for (const auto& [name, turn] : axes) {
    for (float unit : {1.0f, 0.01f, 39.37f}) {
      const Clip turned = in_axes(clip, turn, unit, rotate(turn, Vec3{0, 0.5f * unit, 0}));
      PosedRig rig(rig_of(turned));
      EXPECT_EQ(rig.rig().up_axis(), name);
      EXPECT_NEAR(rig.rig().scale() * unit, 1, 1e-5f);
      for (int f = 0; f < clip.frames; ++f) {
        BodyPose want, got;
        plain.read(clip.pose(f), want);
        rig.read(turned.pose(f), got);
        EXPECT_NEAR(want.facing, got.facing, 1e-4f);
        for (int j = 0; j < kHumanJoints; ++j) {
          EXPECT_LT(length(want.positions[j] - got.positions[j]), 2e-5f) << name << unit;
          EXPECT_LT(length(want.joints[j] - got.joints[j]), 2e-5f) << name << unit;
        }
      }
    }
  }
}

// A body that stands at y = 1 and rises by 1 cm a frame.
Clip standing(int frames) {
  const MadeUp rig = make_up(tree(R"(
Hips, hips > Chest, chest > Head, head;
Chest > Arm_*, leftUpperArm > Elbow_*, leftLowerArm > Hand_*, leftHand;
Hips > Thigh_*, leftUpperLeg > Knee_*, leftLowerLeg > Foot_*, leftFoot > Toes_*, leftToes)"),
                             "L", "R");
  Clip out = rig.clip();
  const size_t joints = out.joints();
  out.resize(frames);
  for (int f = frames - 1; f >= 0; --f) {
    for (size_t j = 0; j < joints; ++j) {
      out.rotations[f * joints + j] = {};
      out.translations[f * joints + j] = out.translations[j];
    }
    // A hand moves, or the first frame would be the rest pose.
    const float wave = 0.01f * static_cast<float>(f % 7 + 1);
    out.rotations[f * joints + rig.joint.at("Hand_L")] = exp_rotation(Vec3{wave, 0, 0});
    out.translations[f * joints].y += 1 + 0.01f * static_cast<float>(f);
  }
  return out;
}

TEST(Calibration, the_floor_is_where_the_lower_toe_is_lowest) {
  // Heights 1.00, 1.01, ... 2.00: a fiftieth of the way up is 1.02. Long clips are sampled, and the
  // floor of two frames is between them.
  for (const auto& [frames, floor, tolerance] : {std::tuple{101, 1.02f, 1e-4f},
                                                 {6001, 1 + 60 * 0.02f, 0.01f},
                                                 {2, 1.005f, 1e-4f},
                                                 {1, 1.0f, 1e-5f}}) {
    const Rig rig = rig_of(standing(frames));
    EXPECT_NEAR(rig.floor(), floor, tolerance) << frames;
    EXPECT_EQ(rig.first_frame(), 0) << frames;
  }
}

// Motion that hardly moves: a quarter of a degree from frame to frame.
Clip calm(int frames) {
  Clip clip = random_clip(canonical_skeleton(), 1, 0.3f, 4);
  std::mt19937 random(4);
  clip.frames = frames;
  for (int f = 1; f < frames; ++f) {
    for (size_t j = 0; j < clip.joints(); ++j) {
      clip.rotations.push_back(clip.rotations[j] * random_rotation(random, 0.004f));
      clip.translations.push_back(clip.translations[j]);
    }
  }
  return clip;
}

TEST(Calibration, a_first_frame_in_rest_pose_is_left_out) {
  Clip clip = calm(30);
  for (size_t j = 1; j < clip.joints(); ++j) clip.rotations[j] = clip.skeleton.joints[j].rest;
  const Rig rig = rig_of(clip);
  EXPECT_EQ(rig.first_frame(), 1);
  EXPECT_TRUE(has_note(rig.notes(), "rest pose"));
  for (size_t j = 1; j < clip.joints(); ++j) {
    clip.rotations[clip.joints() + j] = clip.skeleton.joints[j].rest;
  }
  EXPECT_EQ(rig_of(clip).first_frame(), 0);
}

TEST(Calibration, a_motion_that_begins_in_rest_pose_keeps_its_first_frame) {
  Clip clip = calm(30);
  for (size_t j = 0; j < clip.joints(); ++j) clip.skeleton.joints[j].rest = clip.rotations[j];
  EXPECT_EQ(rig_of(clip).first_frame(), 0);
}

TEST(Calibration, a_first_frame_far_from_the_second_is_left_out_unless_others_are_as_far) {
  const auto arm = [](Clip& clip, int f) -> Quat& {
    return clip.rotations[f * clip.joints() + index(left_upper_arm)];
  };
  const auto move = [](Clip& clip, int f, float x) { clip.translations[f * clip.joints()].x += x; };
  const struct {
    const char* what;
    std::function<void(Clip&)> change;
    int first_frame;
  } cases[] = {
      {"calm", [](Clip&) {}, 0},
      {"nudged", [&](Clip& clip) { move(clip, 0, 0.1f); }, 0},
      {"moved", [&](Clip& clip) { move(clip, 0, 1); }, 1},
      {"raised",
       [&](Clip& clip) {
         arm(clip, 0) = exp_rotation(Vec3{0, 0, 1.2f});
       },
       1},
      {"fast",
       [&](Clip& clip) {
         for (int f = 0; f < clip.frames; ++f) move(clip, f, 0.4f * static_cast<float>(f));
       },
       0},
      {"fast, then at rest",
       [&](Clip& clip) {
         for (int f = 0; f < 5; ++f) {
           arm(clip, f) = arm(clip, f) * exp_rotation(Vec3{0, 0, 0.7f * static_cast<float>(5 - f)});
         }
       },
       0},
      {"a larger step among large ones",
       [&](Clip& clip) {
         for (int f = 0; f < clip.frames; ++f) {
           const float to_and_fro = f == 0 ? -1.2f : f % 2 ? 0.3f : -0.3f;
           arm(clip, f) = arm(clip, f) * exp_rotation(Vec3{0, 0, to_and_fro});
         }
       },
       0}};
  for (const auto& [what, change, first_frame] : cases) {
    Clip clip = calm(40);
    change(clip);
    const Rig rig = rig_of(clip);
    EXPECT_EQ(rig.first_frame(), first_frame) << what;
    EXPECT_EQ(has_note(rig.notes(), "jumps by"), first_frame == 1) << what;
  }
}

// The canonical skeleton without toes, each foot turned in its own axes by `twist`.
Clip toeless(Quat twist, bool ends) {
  Clip clip = calm(30);
  Clip out{clip.skeleton, clip.frame_time, clip.frames, {}, {}};
  const auto is = [](size_t j, HumanJoint left) {
    return static_cast<int>(j) == index(left) || kHumanMirror[j] == index(left);
  };
  for (size_t i = 0; i < clip.rotations.size(); ++i) {
    const size_t j = i % clip.joints();
    if (is(j, left_toes)) continue;
    out.rotations.push_back(is(j, left_foot) ? clip.rotations[i] * twist : clip.rotations[i]);
    out.translations.push_back(clip.translations[i]);
  }
  out.skeleton.joints.clear();
  for (size_t j = 0; j < clip.joints(); ++j) {
    Joint joint = clip.skeleton.joints[j];
    if (is(j, left_toes)) continue;
    if (joint.parent > index(left_toes)) --joint.parent;
    if (is(j, left_foot) && ends) {
      const Vec3 toe = clip.skeleton.joints[j + 1].offset;
      joint.ends = {{0, 0, 0}, rotate(conjugate(twist), toe)};
    }
    out.skeleton.joints.push_back(joint);
  }
  return out;
}

TEST(Calibration, missing_toes_are_taken_from_end_sites) {
  const Quat twist = exp_rotation(Vec3{1, 2, -0.5f});
  const Clip clip = calm(30), other = toeless(twist, true);
  PosedRig whole(rig_of(clip)), rig(rig_of(other));
  EXPECT_EQ(rig.rig().joints()[index(left_toes)], -1);
  EXPECT_TRUE(has_note(rig.rig().notes(), "the left foot's direction is taken from the End Site"));
  for (int f = 0; f < clip.frames; ++f) {
    RotatedBodyPose want, got;
    whole.read(clip.pose(f), want);
    rig.read(other.pose(f), got);
    for (int j = 0; j < kHumanJoints; ++j) {
      EXPECT_LT(length(want.positions[j] - got.positions[j]), 1e-5f) << human_joint_name(j);
    }
    // Missing toes stand where they would be, and turn with the foot.
    EXPECT_LT(length(want.joints[index(left_toes)] - got.joints[index(left_toes)]), 1e-5f);
    EXPECT_EQ(got.rotations[index(right_toes)], got.rotations[index(right_foot)]);
  }
}

TEST(Calibration, missing_toes_are_estimated_from_the_standing_foot) {
  const Clip other = toeless(exp_rotation(Vec3{1, 2, -0.5f}), false);
  PosedRig rig(rig_of(other));
  EXPECT_TRUE(has_note(rig.rig().notes(), "estimated from the standing foot"));
  for (int f = 0; f < other.frames; ++f) {
    BodyPose body;
    rig.read(other.pose(f), body);
    const float slope = kProportions.toe_pitch;
    const Vec3 ahead = rotate(rotation_y(body.facing), Vec3{0, -std::sin(slope), std::cos(slope)});
    for (HumanJoint foot : {left_foot, right_foot}) {
      const Vec3 toes = body.positions[index(foot) + 1] - body.positions[index(foot)];
      EXPECT_LT(angle_deg(toes, ahead), 2);
    }
  }
}

TEST(Calibration, a_toe_joint_straight_below_the_ankle_says_nothing) {
  Clip clip = calm(30);
  for (int f = 0; f < clip.frames; ++f) {
    for (HumanJoint toes : {left_toes, right_toes}) {
      // Straight below in the world, whatever the foot does.
      std::vector<Quat> world(clip.joints());
      std::vector<Vec3> at(clip.joints());
      world_pose(clip.skeleton, clip.pose(f), {world, at});
      clip.translations[f * clip.joints() + index(toes)] =
          rotate(conjugate(world[index(toes) - 1]), Vec3{0, -0.08f, 0});
    }
  }
  EXPECT_TRUE(has_note(rig_of(clip).notes(), "estimated from the standing foot"));
}

TEST(Calibration, nothing_is_said_of_what_is_there) {
  const std::vector<std::string> notes = rig_of(rest_clip(canonical_skeleton())).notes();
  EXPECT_FALSE(has_note(notes, "wrist"));
  EXPECT_FALSE(has_note(notes, "foot"));
  EXPECT_FALSE(has_note(notes, "animated"));
}

TEST(Calibration, missing_wrists_are_taken_from_end_sites_or_estimated) {
  Clip clip = calm(30);
  PosedRig whole(rig_of(clip));
  const size_t lower = static_cast<size_t>(index(left_lower_arm));
  clip.skeleton.joints[lower].ends = {{0, 0, 0}, clip.skeleton.joints[lower + 1].offset};
  RigOptions options;
  options.joints = {{index(left_hand), ""}, {index(right_hand), ""}};
  Result<Rig> created = Rig::create(clip, options);
  ASSERT_TRUE(created.ok()) << created.error().message;
  EXPECT_TRUE(has_note(created->notes(), "the left wrist is the lower arm's End Site"));
  EXPECT_TRUE(has_note(created->notes(), "the right wrist is estimated from the upper arm"));
  PosedRig rig(*created);
  for (int f = 0; f < clip.frames; ++f) {
    BodyPose want, got;
    whole.read(clip.pose(f), want);
    rig.read(clip.pose(f), got);
    // Our own arms are straight at rest, so that the estimate is right too.
    for (HumanJoint hand : {left_hand, right_hand}) {
      EXPECT_LT(length(want.positions[index(hand)] - got.positions[index(hand)]), 2e-5f) << f;
    }
  }
}

TEST(Calibration, a_unit_or_an_axis_that_is_none_is_rejected) {
  const Clip clip = calm(1);
  const auto rejection = [&](std::optional<float> unit, std::optional<std::string> axis) {
    RigOptions options;
    options.metres_per_unit = unit;
    options.up_axis = axis;
    return rejection_of(clip, options);
  };
  EXPECT_EQ(rejection(0.01f, "-Z"), "");
  EXPECT_EQ(rejection(0.0f, {}), "expected metres per unit above 0, found 0.000000");
  EXPECT_EQ(rejection(-1.0f, {}), "expected metres per unit above 0, found -1.000000");
  EXPECT_EQ(rejection(INFINITY, {}), "expected metres per unit above 0, found inf");
  EXPECT_EQ(rejection({}, "Y"), "expected an up axis from +X to -Z, found 'Y'");
}

TEST(Calibration, a_unit_and_an_axis_that_are_given_are_believed) {
  const Clip clip = calm(5);
  RigOptions options;
  options.metres_per_unit = 0.5f;
  for (const char* axis : {"+X", "-X", "+Y", "-Y", "+Z", "-Z"}) {
    options.up_axis = axis;
    Result<Rig> rig = Rig::create(clip, options);
    ASSERT_TRUE(rig.ok()) << rig.error().message;
    EXPECT_EQ(rig->up_axis(), axis);
    EXPECT_EQ(rig->scale(), 0.5f);
    EXPECT_EQ(rig->unit(), 0.5f);
    // Turned so that the axis points up.
    Vec3 up;
    (axis[1] == 'X' ? up.x : axis[1] == 'Y' ? up.y : up.z) = axis[0] == '-' ? -1.0f : 1.0f;
    EXPECT_LT(length(rotate(*turn_up(axis), up) - Vec3{0, 1, 0}), 1e-6f) << axis;
  }
}

TEST(Calibration, legs_of_no_length_are_rejected) {
  Clip clip = calm(1);
  for (Vec3& translation : clip.translations) translation = {NAN, 0, 0};
  EXPECT_NE(rejection_of(clip), "");
  EXPECT_NE(rejection_of({}), "");
  clip.resize(0);
  EXPECT_EQ(rejection_of(clip), "expected at least one frame of motion, found none");
}

TEST(Calibration, one_low_frame_does_not_set_the_floor) {
  for (const int frames : {12, 30, 300}) {
    Clip clip = random_clip(canonical_skeleton(), frames, 0.05f, 3);
    const float floor = Rig::create(clip)->floor();
    // Not the first, which might be left out for the jump.
    clip.pose(frames / 2).translations[0].y -= 0.3f;
    EXPECT_NEAR(Rig::create(clip)->floor(), floor, 0.02f) << frames << " frames";
  }
}

}  // namespace
}  // namespace panache
