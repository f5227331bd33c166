// Styles of two poses, and of one.

#include <cmath>

#include <gtest/gtest.h>

#include "learn/learn_style.h"
#include "learn/style_file.h"
#include "make_walks.h"
#include "style/restyle.h"

namespace panache {
namespace {

// A frame of a walk as a clip of its own.
Clip pose_of(const Clip& clip, int frame) {
  Clip out{clip.skeleton, clip.frame_time, 0, {}, {}};
  out.resize(1);
  sample(clip, frame, out.pose(0));
  return out;
}

std::shared_ptr<const Model> with_pose(const LearnPair& pair) {
  const LearntStyle learnt =
      learn_style(test::shipped_model(), "model.safetensors", {&pair, 1}, "bent", "").value();
  EXPECT_FALSE(learnt.judged);
  EXPECT_TRUE(learnt.pairs[0].warnings.empty() && learnt.warnings.empty());
  const TensorFile model =
      add_style(test::shipped_model(), "model.safetensors", learnt.file, "style.safetensors", false)
          .value();
  return Model::parse(format_safetensors(model), "model.safetensors").value();
}

// By how much a walk in the style leans more, on average.
double lean_of(const std::shared_ptr<const Model>& model, const Clip& walk) {
  const StrengthTrack track{*model->find_style("bent"), {{0, 1}}};
  const Restyled styled = restyle(walk, *Rig::create(walk), model, {track}).value();
  EXPECT_EQ(styled.clip.frames, walk.frames) << "a pose has no tempo";
  EXPECT_GT(*std::min_element(styled.gates.begin(), styled.gates.end()), 0.99f);
  const auto lean = [](const Clip& clip, int frame) {
    const Quat q = clip.pose(frame).rotations[index(HumanJoint::spine)];
    return std::atan2(rotate(q, Vec3{0, 1, 0}).z, rotate(q, Vec3{0, 1, 0}).y);
  };
  double sum = 0;
  for (int f = 30; f < 120; ++f)
    sum += static_cast<double>(lean(styled.clip, f) - lean(walk, f)) / 90;
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
