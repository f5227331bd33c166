#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "learn/learn_style.h"
#include "learn/style_file.h"
#include "make_walks.h"
#include "style/restyle.h"
#include "style/style_checks.h"

namespace panache {
namespace {

std::string failure(const Clip& neutral, const Clip& styled) {
  const auto a = Rig::create(neutral), b = Rig::create(styled);
  const auto pair = make_learn_pair({neutral, *a, "a.bvh"}, {styled, *b, "b.bvh"});
  return pair.ok() ? "" : pair.error().message;
}

LearntStyle learn(const Clip& neutral, const Clip& styled) {
  return test::learn({test::make_pair(neutral, styled)});
}

// The motion of `clip` with the axes of each joint turned by turns[joint], so that the skeleton
// rests otherwise.
Clip with_rest(Clip clip, const std::vector<Quat>& turns) {
  const std::vector<Joint> joints = clip.skeleton.joints;
  for (size_t j = 0; j < joints.size(); ++j) {
    const Quat above = joints[j].parent < 0 ? Quat{} : turns[static_cast<size_t>(joints[j].parent)];
    Joint& joint = clip.skeleton.joints[j];
    joint.offset = rotate(above, joint.offset);
    for (Vec3& end : joint.ends) end = rotate(turns[j], end);
    for (int f = 0; f < clip.frames; ++f) {
      Quat& q = clip.pose(f).rotations[j];
      q = normalized(above * q * conjugate(turns[j]));
      if (joints[j].parent >= 0) clip.pose(f).translations[j] = joint.offset;
    }
  }
  return clip;
}

// Arms that rest 40 degrees below a T-pose's, with elbows slightly bent.
std::vector<Quat> a_pose() {
  using enum HumanJoint;
  std::vector<Quat> turns(kHumanJoints);
  const auto turn = [&](std::initializer_list<HumanJoint> joints, Vec3 axis, float degrees) {
    for (const HumanJoint joint : joints) {
      turns[index(joint)] = axis_angle(axis, degrees * 3.14159265f / 180) * turns[index(joint)];
    }
  };
  turn({left_upper_arm, left_lower_arm, left_hand}, {0, 0, 1}, -40);
  turn({right_upper_arm, right_lower_arm, right_hand}, {0, 0, 1}, 40);
  turn({left_lower_arm, left_hand}, {0, 1, 0}, -15);
  turn({right_lower_arm, right_hand}, {0, 1, 0}, 15);
  return turns;
}

// Legs longer by a fifth, of a body that is larger by a third.
Clip of_another_size(Clip clip) {
  for (size_t j = 0; j < clip.joints(); ++j) {
    Joint& joint = clip.skeleton.joints[j];
    const auto human = static_cast<HumanJoint>(j);
    const bool leg = human == HumanJoint::left_lower_leg || human == HumanJoint::right_lower_leg ||
                     human == HumanJoint::left_foot || human == HumanJoint::right_foot;
    joint.offset = joint.offset * (leg ? 1.6f : 4 / 3.0f);
    for (int f = 0; f < clip.frames; ++f) {
      Vec3& at = clip.pose(f).translations[j];
      at = j == 0 ? at * 1.6f : joint.offset;
    }
  }
  return clip;
}

// How far the rotations of two takes are apart, degrees: the mean over joints and frames.
double turned(const Take& a, const Take& b) {
  double sum = 0;
  for (int f = 0; f < a.frames(); ++f) {
    for (int j = 0; j < kHumanJoints; ++j) {
      sum += static_cast<double>(
          length(log_rotation(a.rotations[f][j] * conjugate(b.rotations[f][j]))));
    }
  }
  return sum / (a.frames() * kHumanJoints) * 180 / 3.14159265;
}

TEST(LearnPair, of_two_rest_poses_is_as_of_one) {
  const Clip walk = test::neutral_walk(), bent = test::bent_walk();
  const LearnPair plain = test::make_pair(walk, bent);
  const Clip other = with_rest(bent, a_pose());
  for (const Clip& styled : {other, of_another_size(other)}) {
    const LearnPair pair = test::make_pair(walk, styled);
    ASSERT_EQ(pair.styled.frames(), plain.styled.frames());
    // Elbows that rest bent are straightened by the smallest rotation; untreated it is 17 degrees.
    EXPECT_LT(turned(pair.styled, plain.styled), 3);
  }
  const LearntStyle learnt = learn(with_rest(walk, a_pose()), of_another_size(bent));
  EXPECT_TRUE(learnt.pairs[0].warnings.empty());
  EXPECT_STREQ(learnt.verdict(), "good");
  EXPECT_LT(learnt.held_back_cm, 0.25 * learnt.untouched_cm);
}

TEST(LearnPair, may_have_its_joints_in_another_order) {
  // The right leg before the left one.
  const Clip bent = test::bent_walk();
  std::vector<size_t> order;
  for (size_t j = 0; j < 13; ++j) order.push_back(j);
  for (size_t j = 17; j < 21; ++j) order.push_back(j);
  for (size_t j = 13; j < 17; ++j) order.push_back(j);
  Clip other = bent;
  for (size_t j = 0; j < order.size(); ++j) {
    other.skeleton.joints[j] = bent.skeleton.joints[order[j]];
    int& parent = other.skeleton.joints[j].parent;
    if (parent >= 0)
      parent = static_cast<int>(std::ranges::find(order, size_t(parent)) - order.begin());
    for (int f = 0; f < bent.frames; ++f) {
      other.pose(f).rotations[j] = bent.pose(f).rotations[order[j]];
      other.pose(f).translations[j] = bent.pose(f).translations[order[j]];
    }
  }
  const Clip walk = test::neutral_walk();
  EXPECT_EQ(format_safetensors(learn(walk, other).file),
            format_safetensors(learn(walk, bent).file));
}

TEST(LearnPair, of_different_skeletons_is_rejected) {
  const Clip walk = test::neutral_walk(2);
  Clip fewer = walk, renamed = walk, moved = walk;
  renamed.skeleton.joints[5].name = "leftCollar";
  moved.skeleton.joints[5].parent = index(HumanJoint::spine);
  fewer.skeleton.joints.pop_back();
  const std::string start = "a.bvh and b.bvh: have different skeletons (";
  const std::string end =
      "); a pair needs the same joints of the body: leave the neutral clip out, or "
      "retarget the styled clip onto it";
  // Bodies are compared, not names.
  EXPECT_EQ(failure(walk, renamed), "");
  EXPECT_EQ(failure(walk, moved), start + "'leftShoulder' is below 'chest' and 'spine'" + end);
  EXPECT_EQ(failure(walk, fewer), start + "21 and 20 joints" + end);
}

TEST(LearnPair, of_clips_that_are_empty_or_too_short_is_rejected) {
  const Clip walk = test::neutral_walk(2);
  Clip empty = walk, brief = walk;
  empty.frames = 0;
  brief.frames = 10;
  const auto rig = Rig::create(walk);
  const auto message = [&](const Clip& styled) {
    const auto pair = make_learn_pair({walk, *rig, "a.bvh"}, {styled, *rig, "b.bvh"});
    return pair.ok() ? "" : pair.error().message;
  };
  const std::string rest =
      " s of motion; a style is learnt from 0.50 s at least, better from 2 to 3 s; give a longer "
      "clip";
  EXPECT_EQ(message(empty), "b.bvh: has 0.00" + rest);
  EXPECT_EQ(message(brief), "b.bvh: has 0.33" + rest);
}

// Styles of two poses, and of one.

// A frame of a walk as a clip of its own.
Clip pose_of(const Clip& clip, int frame) {
  Clip out{clip.skeleton, clip.frame_time, 0, {}, {}};
  out.resize(1);
  sample(clip, frame, out.pose(0));
  return out;
}

std::shared_ptr<const Model> with_pose(const LearnPair& pair) {
  const LearntStyle learnt = test::learn({pair});
  EXPECT_FALSE(learnt.judged);
  EXPECT_TRUE(learnt.pairs[0].warnings.empty() && learnt.warnings.empty());
  return read(*add_style(test::shipped_model(), "m", learnt.file, "style.safetensors", false));
}

// By how much a walk in the style leans more, on average.
double lean_of(const std::shared_ptr<const Model>& model, const Clip& walk) {
  const StrengthTrack track{*model->find_style("bent"), {{0, 1}}};
  const Restyled styled = restyle(walk, *Rig::create(walk), model, {track}).value();
  EXPECT_EQ(styled.clip.frames, walk.frames) << "a pose has no tempo";
  EXPECT_GT(*std::min_element(styled.gates.begin(), styled.gates.end()), 0.99f);
  double sum = 0;
  for (int f = 30; f < 120; ++f) {
    sum += static_cast<double>(test::lean(styled.clip, f) - test::lean(walk, f)) / 90;
  }
  return sum;
}

TEST(LearnPose, two_poses_give_their_difference_to_all_motion) {
  const Clip neutral = pose_of(test::neutral_walk(), 20), bent = pose_of(test::bent_walk(), 20);
  const LearnPair pair = test::make_pair(neutral, bent);
  EXPECT_TRUE(pair.is_pose);
  const std::shared_ptr<const Model> model = with_pose(pair);
  EXPECT_NEAR(lean_of(model, test::neutral_walk(5, 1.1f)), 0.5, 0.05);
  EXPECT_NEAR(lean_of(model, test::neutral_walk(5, 3.f)), 0.5, 0.1);  // No action is unknown.
}

TEST(LearnPose, a_single_pose_is_compared_with_a_body_that_stands) {
  const Clip bent = pose_of(test::bent_walk(4, 0.7f), 20);
  const LearnPair pair = make_pose_pair({bent, *Rig::create(bent), "bent.bvh"}).value();
  EXPECT_NEAR(lean_of(with_pose(pair), test::neutral_walk(5, 1.1f)), 0.7, 0.12);
}

TEST(LearnPose, poses_and_motions_do_not_mix) {
  const Clip walk = test::neutral_walk(), bent = pose_of(test::bent_walk(), 20);
  const Result<Rig> a = Rig::create(walk), b = Rig::create(bent);
  const auto mixed = make_learn_pair({walk, *a, "walk.bvh"}, {bent, *b, "bent.bvh"});
  ASSERT_FALSE(mixed.ok());
  EXPECT_EQ(
      mixed.error().message,
      "bent.bvh: is a pose, and the other of the pair a motion; give two poses or two motions");
  const auto motion = make_pose_pair({walk, *a, "walk.bvh"});
  ASSERT_FALSE(motion.ok());
  EXPECT_EQ(motion.error().message, "walk.bvh: has 120 frames; expected a pose, which is one");
  const std::vector<LearnPair> pairs(2, test::make_pair(bent, bent));
  const auto two = learn_style(test::shipped_model(), "model.safetensors", pairs, "bent", "");
  ASSERT_FALSE(two.ok());
  EXPECT_EQ(two.error().message, "a style of poses is learnt from one pair of them; found 2 pairs");
}

}  // namespace
}  // namespace panache
