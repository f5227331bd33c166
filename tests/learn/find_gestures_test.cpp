#include "learn/find_gestures.h"

#include <gtest/gtest.h>

#include "base/elementary.h"
#include "learn/learn_style.h"
#include "learn/style_file.h"
#include "make_walks.h"

namespace panache {
namespace {

using enum HumanJoint;

// Turns joints of a clip between two times, as far as `turn` says in the middle.
void gesture_in(Clip& clip, double from, double to, HumanJoint joint, Vec3 turn) {
  for (int f = 0; f < clip.frames; ++f) {
    const double t = f * clip.frame_time, ease = (to - from) / 3;
    const float share = smooth_step(static_cast<float>((t - from) / ease)) *
                        smooth_step(static_cast<float>((to - t) / ease));
    Quat& rotation = clip.pose(f).rotations[static_cast<size_t>(index(joint))];
    rotation = rotation * exp_rotation(turn * share);
  }
}

LearntStyle learn(const Clip& styled) {
  return test::learn({test::make_pair(test::neutral_walk(8), styled)}, "new");
}

TEST(FindGestures, a_glance_is_found_where_it_is_and_kept_with_the_style) {
  for (const float sign : {1.0f, -1.0f}) {
    Clip styled = test::bent_walk(8);
    gesture_in(styled, 3, 4.4, head, {0, 0.7f * sign, 0});
    const LearntStyle learnt = learn(styled);
    ASSERT_EQ(learnt.gestures.size(), 1u);
    const LearntGesture& glance = learnt.gestures[0];
    EXPECT_TRUE(glance.name.starts_with(sign > 0 ? "glances left, " : "glances right, "))
        << glance.name;
    EXPECT_EQ(glance.take, "styled.bvh");
    EXPECT_NEAR(glance.start, 2.9, 0.3);
    EXPECT_NEAR(glance.seconds, 1.6, 0.4);
    ASSERT_TRUE(learnt.file.tensors.contains("gesture.0"));
    EXPECT_FALSE(learnt.file.tensors.contains("gesture.1"));
    const Gesture kept = *Gesture::read(learnt.file.tensors.at("gesture.0"), "gesture.0", "");
    EXPECT_FALSE(kept.moves_hips());
    float max = 0;
    for (float t = 0; t < kept.seconds(); t += 0.05f) {
      max = std::max(max, sign * kept.at(t).turns[index(head)].y);
    }
    EXPECT_NEAR(max, 0.7f, 0.15f);
    EXPECT_EQ(learnt.file.metadata.at("gesture_rate"), "0.125") << "one in 8 s";
  }
}

TEST(FindGestures, a_steady_style_has_none) {
  EXPECT_TRUE(learn(test::bent_walk(8)).gestures.empty());
  EXPECT_TRUE(learn(test::bent_walk(8, 0.5f, 1.3)).gestures.empty());
}

// What lasts, and what is there all the time, is the style.
TEST(FindGestures, what_lasts_or_never_stops_is_none) {
  Clip lasting = test::bent_walk(8);
  gesture_in(lasting, 2, 7.5, head, {0, 0.9f, 0});
  EXPECT_TRUE(learn(lasting).gestures.empty());
  Clip cut = test::bent_walk(8);
  gesture_in(cut, 7.4, 9, head, {0, 0.9f, 0});
  EXPECT_TRUE(learn(cut).gestures.empty()) << "the clip ends within it";
}

TEST(FindGestures, the_strongest_four_are_kept_apart) {
  Clip styled = test::bent_walk(14);
  for (int k = 0; k < 6; ++k) {
    gesture_in(styled, 0.8 + 2.1 * k, 1.9 + 2.1 * k, k % 2 ? head : right_upper_arm,
               k % 2 ? Vec3{0, 0.7f + 0.05f * k, 0} : Vec3{0, 0, 1.2f + 0.05f * k});
  }
  const LearntStyle learnt = learn(styled);
  EXPECT_EQ(learnt.gestures.size(), 4u);
  // All six count: 6 / 14 s.
  EXPECT_NEAR(std::stod(learnt.file.metadata.at("gesture_rate")), 0.429, 0.05);
  for (const LearntGesture& a : learnt.gestures) {
    for (const LearntGesture& b : learnt.gestures) {
      if (&a == &b) continue;
      EXPECT_GT(std::abs(a.start - b.start), 1) << a.name << " " << b.name;
    }
  }
}

// Extracted, added to another model, renamed and taken out, with other styles before it.
TEST(FindGestures, gestures_go_where_their_style_goes) {
  Clip styled = test::bent_walk(8);
  gesture_in(styled, 3, 4.4, head, {0, 0.9f, 0});
  const LearntStyle learnt = learn(styled);
  const TensorFile with = *add_style(test::shipped_model(), "m", learnt.file, "s", false);
  const auto gestures_of = [](const TensorFile& file, const std::string& style) {
    const auto model = *Model::create(file, "m");
    return model->gestures(*model->find_style(style)).size();
  };
  EXPECT_EQ(gestures_of(with, "new"), 1u);
  EXPECT_EQ(gestures_of(*rename_style(with, "new", "old hat", "m"), "old hat"), 1u);
  EXPECT_EQ(gestures_of(*remove_style(with, "angry", "m"), "new"), 1u);
  const TensorFile out = *extract_style(with, "new", "m");
  EXPECT_EQ(format_safetensors(out), format_safetensors(learnt.file));
  EXPECT_TRUE(read_style_info(out, "s").ok());
  // A built-in style.
  const Gesture gesture = *Gesture::read(out.tensors.at("gesture.0"), "", "");
  const std::vector<Gesture> two = {gesture, gesture};
  const TensorFile proud = *set_gestures(with, "proud", two, 0.25f, "m");
  EXPECT_EQ(gestures_of(proud, "proud"), 2u);
  EXPECT_EQ(gestures_of(proud, "old"), gestures_of(with, "old"));
  const auto rate_of = [](const TensorFile& file, const std::string& style) {
    const auto model = *Model::create(file, "m");
    return model->gesture_rate(*model->find_style(style));
  };
  EXPECT_EQ(rate_of(proud, "proud"), 0.25f);
  EXPECT_EQ(rate_of(*remove_style(proud, "angry", "m"), "proud"), 0.25f);
  EXPECT_EQ(rate_of(proud, "new"), 0.125f);
  EXPECT_EQ(rate_of(*set_gestures(proud, "proud", {}, 0, "m"), "proud"), 0);
  EXPECT_EQ(gestures_of(*remove_style(proud, "angry", "m"), "proud"), 2u);
  EXPECT_EQ(gestures_of(*set_gestures(proud, "proud", {}, 0, "m"), "proud"), 0u);
  const TensorFile taken = *extract_style(proud, "proud", "m");
  EXPECT_TRUE(taken.tensors.contains("gesture.1"));
  EXPECT_EQ(gestures_of(*add_style(test::shipped_model(), "m", taken, "s", true), "proud"), 2u);
}

}  // namespace
}  // namespace panache
