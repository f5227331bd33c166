#include "pose/loop.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <gtest/gtest.h>

#include "make_clip.h"
#include "pose/observer.h"
#include "rig/humanoid.h"

namespace panache {
namespace {

// A walk of one stride a second at 30 frames a second.
bool walk_is_loop(int frames) {
  const Clip clip = test::walking_clip(frames);
  return is_loop(measure_seam(clip, *Rig::create(clip)), clip.frame_time);
}

TEST(Loop, whole_strides_are_a_loop_and_others_are_not) {
  EXPECT_TRUE(walk_is_loop(31));
  EXPECT_TRUE(walk_is_loop(61));
  for (const int frames : {3, 9, 16, 24, 35, 40, 46, 55})
    EXPECT_FALSE(walk_is_loop(frames)) << frames;
}

TEST(Loop, the_seam_says_where_the_body_went) {
  const Clip clip = test::walking_clip(31);
  const LoopSeam seam = measure_seam(clip, *Rig::create(clip));
  EXPECT_EQ(seam.frames(), 30);
  EXPECT_LT(seam.gap, 1e-5f);
  EXPECT_NEAR(length(seam.end.position - seam.begin.position), 1.2f, 1e-3f);
  EXPECT_NEAR(seam.end.facing, seam.begin.facing, 1e-4f);
}

// Raises an arm and lowers it to `left` radians of where it was, at rest at both ends.
Clip gesture(float left) {
  const Clip stand = test::walking_clip(1);
  const ConstPose still = stand.pose(0);
  Clip clip = test::walking_clip(61);
  for (int f = 0; f < 61; ++f) {
    const Pose pose = clip.pose(f);
    std::ranges::copy(still.rotations, pose.rotations.begin());
    std::ranges::copy(still.translations, pose.translations.begin());
    const float t = static_cast<float>(f) / 60;
    const float raised = std::pow(std::sin(3.14159265f * t), 2.0f);
    const float rest = left * t * t * (3 - 2 * t);
    Quat& arm = pose.rotations[index(HumanJoint::left_upper_arm)];
    arm = normalized(axis_angle(Vec3{0, 0, 1}, 2 * raised + rest) * arm);
  }
  return clip;
}

TEST(Loop, a_gesture_that_ends_near_its_first_pose_is_no_loop_unless_it_ends_in_it) {
  for (const auto& [left, loop] : {std::pair{0.0f, true}, {0.2f, false}, {0.4f, false}}) {
    const Clip clip = gesture(left);
    const LoopSeam seam = measure_seam(clip, *Rig::create(clip));
    EXPECT_LT(seam.gap, 0.04f);
    EXPECT_EQ(is_loop(seam, clip.frame_time), loop) << left;
  }
}

TEST(Loop, what_cannot_be_closed_says_why) {
  const auto check = [](const Clip& clip) {
    const auto good = check_closable(measure_seam(clip, *Rig::create(clip)), clip.frame_time);
    return good ? std::string() : good.error().message;
  };
  EXPECT_EQ(check(test::walking_clip(31)), "");
  EXPECT_EQ(check(test::walking_clip(33)), "");
  EXPECT_EQ(check(test::walking_clip(6)),
            "the motion is not a loop: it lasts 0.17 s; expected at least 0.3 s and 4 frames");
  const Clip apart = test::walking_clip(39);
  char message[200];
  std::snprintf(
      message, sizeof message,
      "the motion is not a loop: its last pose is %.1f cm from its first in the mean of the "
      "joints; expected at most 10 cm, as where a clip is cut after a whole cycle",
      100.0 * static_cast<double>(measure_seam(apart, *Rig::create(apart)).gap));
  EXPECT_EQ(check(apart), message);
}

// A walk on bent knees whose cycle is cut two frames late and that turns and leans a little more
// with each frame.
Clip rough_cycle() {
  Clip clip = test::walking_clip(33);
  for (int f = 0; f < clip.frames; ++f) {
    const float t = static_cast<float>(f) / 32;
    const Pose pose = clip.pose(f);
    const Quat turned = axis_angle(Vec3{0, 1, 0}, 0.6f * t) * axis_angle(Vec3{1, 0, 0}, 0.1f * t);
    pose.rotations[0] = turned;
    pose.translations[0].y += 0.02f * t;
    for (const HumanJoint knee : kLowerLegs) {
      Quat& bent = pose.rotations[index(knee)];
      bent = bent * axis_angle(Vec3{1, 0, 0}, 0.6f);
    }
    pose.rotations[index(HumanJoint::left_hand)] = axis_angle(Vec3{0, 0, 1}, 0.3f * t);
  }
  return clip;
}

std::vector<FootContacts> all(int frames, FootContacts contacts) {
  return std::vector<FootContacts>(static_cast<size_t>(frames), contacts);
}

TEST(CloseLoop, the_first_and_the_last_pose_meet_half_way) {
  const Clip open = rough_cycle();
  const Rig rig = *Rig::create(open);
  Clip closed = open;
  close_loop(rig, 0, all(open.frames, {false, false}), closed);
  EXPECT_GT(measure_seam(open, rig).gap, 0.02f);
  const LoopSeam seam = measure_seam(closed, rig);
  EXPECT_LT(seam.worst, 1e-5f);
  EXPECT_NEAR(seam.end.facing, 0.6f, 0.05f);  // Travel stays.
  const ConstPose first = closed.pose(0), last = closed.pose(closed.frames - 1);
  const auto moved = [&](int frame) {
    Observation before, after;
    PosedRig reader(rig);
    observe(reader, open.pose(frame), 0, before);
    observe(reader, closed.pose(frame), before.root.facing, after);
    float mean = 0;
    for (int j = 0; j < kHumanJoints; ++j) {
      mean += length(before.body_frame[j] - after.body_frame[j]) / kHumanJoints;
    }
    return mean;
  };
  const float gap = measure_seam(open, rig).gap;
  EXPECT_NEAR(moved(0), gap / 2, gap / 8);
  EXPECT_NEAR(moved(32), gap / 2, gap / 8);
  EXPECT_LT(moved(16), gap / 8);
  for (size_t j = 1; j < closed.joints(); ++j) {
    EXPECT_GT(std::abs(dot(first.rotations[j], last.rotations[j])), 1 - 1e-6f) << j;
  }
}

TEST(CloseLoop, a_foot_stays_where_it_stands) {
  const Clip open = rough_cycle();
  const Rig rig = *Rig::create(open);
  std::vector<FootContacts> contacts = all(open.frames, {false, false});
  for (int f = 0; f < 12; ++f) contacts[f][0] = true;
  for (int f = 14; f < 27; ++f) contacts[f][1] = true;
  Clip closed = open;
  close_loop(rig, 0, contacts, closed);
  PosedRig reader(rig);
  const auto toe = [&](const Clip& clip, int frame, int foot) {
    BodyPose body;
    reader.read(clip.pose(frame), body);
    return body.joints[index(kToes[foot])];
  };
  for (int foot = 0; foot < kFeet; ++foot) {
    for (int f = 1; f < open.frames; ++f) {
      if (!contacts[f - 1][foot] || !contacts[f][foot]) continue;
      const Vec3 before = toe(open, f, foot) - toe(open, f - 1, foot);
      const Vec3 after = toe(closed, f, foot) - toe(closed, f - 1, foot);
      // What two-bone inverse kinematics leaves of a leg of 0.8 m.
      EXPECT_LT(length(after - before), 2e-4f) << "foot " << foot << ", frame " << f;
    }
  }
  EXPECT_LT(measure_seam(closed, rig).worst, 1e-5f);
}

TEST(CloseLoop, what_the_body_does_not_carry_is_left_alone) {
  Clip open = rough_cycle();
  // A prop beside the person that is somewhere else at the end.
  Joint prop;
  prop.name = "Prop";
  prop.can_rotate = prop.can_translate = true;
  Clip clip{open.skeleton, open.frame_time, 0, {}, {}};
  clip.skeleton.joints.push_back(prop);
  for (int f = 0; f < open.frames; ++f) {
    std::vector<Quat> rotations(open.pose(f).rotations.begin(), open.pose(f).rotations.end());
    std::vector<Vec3> translations(open.pose(f).translations.begin(),
                                   open.pose(f).translations.end());
    rotations.push_back(axis_angle(Vec3{0, 1, 0}, 0.01f * static_cast<float>(f)));
    translations.push_back({0, 0, 0.04f * static_cast<float>(f)});
    clip.append({rotations, translations});
  }
  Clip closed = clip;
  close_loop(*Rig::create(clip), 0, all(clip.frames, {false, false}), closed);
  for (int f = 0; f < clip.frames; ++f) {
    EXPECT_EQ(closed.pose(f).rotations.back(), clip.pose(f).rotations.back());
    EXPECT_EQ(closed.pose(f).translations.back(), clip.pose(f).translations.back());
  }
}

TEST(CloseLoop, a_repeated_loop_goes_on_where_it_ended) {
  Clip clip = rough_cycle();
  const Rig rig = *Rig::create(clip);
  close_loop(rig, 0, all(clip.frames, {false, false}), clip);
  const LoopSeam seam = measure_seam(clip, rig);
  const Clip three = repeat_loop(clip, rig, 0, Travel(seam.begin, seam.end), 3);
  ASSERT_EQ(three.frames, 3 * 32 + 1);
  PosedRig reader(rig);
  Observation a, b;
  for (int f = 0; f + 32 < three.frames; ++f) {
    observe(reader, three.pose(f), 0, a);
    observe(reader, three.pose(f + 32), a.root.facing + 0.6f, b);
    for (int j = 0; j < kHumanJoints; ++j) {
      EXPECT_LT(length(a.body_frame[j] - b.body_frame[j]), 2e-5f) << f << ", joint " << j;
    }
    // Each round turns by as much and goes as far, from where it is.
    EXPECT_NEAR(b.root.facing - a.root.facing, seam.end.facing - seam.begin.facing, 1e-4f);
  }
  observe(reader, three.pose(64), 0, a);
  EXPECT_LT(length(a.root.position - Travel(seam.begin, seam.end).position(2)), 1e-4f);
}

}  // namespace
}  // namespace panache
