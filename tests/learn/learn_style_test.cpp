#include "learn/learn_style.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "learn/style_file.h"
#include "make_model.h"
#include "make_walks.h"
#include "style/restyle.h"
#include "style/style_checks.h"

namespace panache {
namespace {

std::string failure(const Result<LearntStyle>& learnt) {
  return learnt.ok() ? "" : learnt.error().message;
}

using test::lean;
using test::learn;

TensorFile with_it(const LearntStyle& learnt) {
  return add_style(test::shipped_model(), "model.safetensors", learnt.file, "style.safetensors",
                   false)
      .value();
}

// A clip in the style, at its full strength.
Restyled in_style(const std::shared_ptr<const Model>& model, const std::string& style,
                  const Clip& clip) {
  const StrengthTrack track{*model->find_style(style), {{0, 1}}};
  return restyle(clip, *Rig::create(clip), model, {track}).value();
}

TEST(LearnStyle, a_bent_walk_bends_a_walk_of_another_speed) {
  const LearntStyle learnt = learn({test::make_pair(test::neutral_walk(), test::bent_walk())});
  EXPECT_TRUE(learnt.pairs[0].warnings.empty());
  EXPECT_LT(learnt.held_back_cm, 0.25 * learnt.untouched_cm);
  const Clip walk = test::neutral_walk(5, 1.1f);
  const Restyled bent = in_style(read(with_it(learnt)), "bent", walk);
  // A quarter of the bend may be lost to the ridge and to what the gate does not know.
  for (int f = 30; f < 120; f += 10) EXPECT_NEAR(lean(bent.clip, f) - lean(walk, f), 0.5, 0.12);
}

TEST(LearnStyle, a_slower_style_slows_the_motion_by_as_much) {
  const Clip slow = test::bent_walk(5, 0.5f, 1.3);
  const LearntStyle learnt = learn({test::make_pair(test::neutral_walk(), slow)});
  // The warping goes by whole frames, smoothed over 7 of them.
  EXPECT_NEAR(learnt.pairs[0].tempo, 1 / 1.3, 0.03);
  const Clip walk = test::neutral_walk(6);
  const Restyled styled = in_style(read(with_it(learnt)), "bent", walk);
  EXPECT_NEAR(styled.clip.duration() / walk.duration(), 1.3, 0.1);
}

TEST(LearnStyle, tells_which_instants_go_together) {
  const LearnPair pair = test::make_pair(test::neutral_walk(), test::bent_walk(5, 0.5f, 1.3));
  const std::vector<MatchedInstant> instants = learn({pair}).pairs[0].instants;
  // All of the styled clip but the last window's rest, which is shorter than a hop of half a
  // second.
  ASSERT_GT(instants.size(), size_t(pair.styled.frames() - 15));
  const auto foot_ahead = [](const Take& take, double seconds) {
    const auto& body = take.body[static_cast<size_t>(std::lround(seconds * kTakeRate))];
    return body[index(HumanJoint::left_foot)].z - body[index(HumanJoint::right_foot)].z;
  };
  int same_foot = 0;
  std::vector<double> tempos;
  for (size_t i = 0; i < instants.size(); ++i) {
    const MatchedInstant& at = instants[i];
    EXPECT_NEAR(at.styled_seconds, static_cast<double>(i) / kTakeRate, 1e-9);
    same_foot +=
        foot_ahead(pair.styled, at.styled_seconds) * foot_ahead(pair.neutral, at.neutral_seconds) >
        0;
    if (i < 10) continue;
    tempos.push_back((at.neutral_seconds - instants[i - 10].neutral_seconds) /
                     (at.styled_seconds - instants[i - 10].styled_seconds));
  }
  // Feet that pass each other are a frame off here and there: one in twenty.
  EXPECT_GT(same_foot, 0.85 * static_cast<double>(instants.size()));
  std::nth_element(tempos.begin(), tempos.begin() + tempos.size() / 2, tempos.end());
  EXPECT_NEAR(tempos[tempos.size() / 2], 1 / 1.3, 0.05);
}

TEST(LearnStyle, the_same_motion_gives_the_same_bytes_in_a_small_file) {
  const std::vector<LearnPair> pairs = {test::make_pair(test::neutral_walk(), test::bent_walk())};
  const std::string bytes = format_safetensors(learn(pairs).file);
  EXPECT_EQ(bytes, format_safetensors(learn(pairs).file));
  EXPECT_LE(bytes.size(), 110'000u);
}

TEST(LearnStyle, motion_unlike_what_it_learnt_gets_its_mean_posture) {
  const LearntStyle learnt = learn({test::make_pair(test::neutral_walk(), test::bent_walk())});
  const auto model = read(with_it(learnt));
  const Clip walk = test::neutral_walk(3);
  const Restyled known = in_style(model, "bent", walk);
  // Not at the start, where nothing has been seen yet.
  EXPECT_GT(*std::min_element(known.gates.begin() + 15, known.gates.end()), 0.8f);
  // Sitting in the air with the arms up: no walk of anybody.
  Clip odd = walk;
  for (int f = 0; f < odd.frames; ++f) {
    for (const HumanJoint joint : {HumanJoint::left_upper_arm, HumanJoint::right_upper_arm,
                                   HumanJoint::left_upper_leg, HumanJoint::right_upper_leg}) {
      Quat& q = odd.pose(f).rotations[index(joint)];
      q = axis_angle(Vec3{1, 0, 0}, -2.0f) * q;
    }
  }
  const Restyled unknown = in_style(model, "bent", odd);
  EXPECT_LT(unknown.gates.back(), 0.35f);
  // The mean posture is as bent as all of the style is.
  const int last = unknown.clip.frames - 1, from = static_cast<int>(unknown.source_frames[last]);
  EXPECT_NEAR(lean(unknown.clip, last) - lean(odd, from), 0.5, 0.12);
}

TEST(LearnStyle, a_walk_of_somebody_who_holds_himself_otherwise_is_known) {
  const LearntStyle learnt = learn({test::make_pair(test::neutral_walk(), test::bent_walk())});
  const auto model = read(with_it(learnt));
  Clip walk = test::neutral_walk(4, 1.2f);
  for (int f = 0; f < walk.frames; ++f) {
    const auto turn = [&](HumanJoint joint, Vec3 axis, float angle) {
      Quat& q = walk.pose(f).rotations[index(joint)];
      q = axis_angle(axis, angle) * q;
    };
    turn(HumanJoint::left_upper_arm, {0, 0, 1}, 0.25f);
    turn(HumanJoint::right_upper_arm, {0, 0, 1}, -0.25f);
    turn(HumanJoint::left_lower_arm, {1, 0, 0}, -0.3f);
    turn(HumanJoint::right_lower_arm, {1, 0, 0}, -0.3f);
    turn(HumanJoint::chest, {1, 0, 0}, 0.12f);
    turn(HumanJoint::head, {1, 0, 0}, -0.15f);
  }
  const std::vector<float> gates = in_style(model, "bent", walk).gates;
  EXPECT_GT(*std::min_element(gates.begin() + 15, gates.end()), 0.9f);
}

TEST(LearnStyle, says_that_a_pair_is_out_of_step) {
  // Two thirds of a second of a slow walk hold one step: the other foot's finds nothing like it.
  const LearntStyle learnt =
      learn({test::make_pair(test::neutral_walk(20 / 30.0, 1.2f), test::bent_walk(3))});
  const std::vector<std::string>& warnings = learnt.pairs[0].warnings;
  EXPECT_NE(std::ranges::find(warnings,
                              "neutral.bvh and styled.bvh: are out of step, left feet were paired "
                              "with right ones in part; give a neutral clip of four steps or more"),
            warnings.end());
}

TEST(LearnStyle, several_pairs_of_several_skeletons_make_one_style) {
  // The same walks under other names, in centimetres.
  const auto other = [](Clip clip) {
    for (Joint& joint : clip.skeleton.joints) joint.name = "rig:" + joint.name;
    for (Joint& joint : clip.skeleton.joints) joint.offset = joint.offset * 100;
    for (Joint& joint : clip.skeleton.joints) {
      for (Vec3& end : joint.ends) end = end * 100;
    }
    for (Vec3& v : clip.translations) v = v * 100;
    return clip;
  };
  const LearntStyle learnt = learn(
      {test::make_pair(test::neutral_walk(), test::bent_walk()),
       test::make_pair(other(test::neutral_walk(3, 2.8f)), other(test::neutral_walk(3, 2.9f)))},
      "bent", "bent forward");
  EXPECT_EQ(learnt.pairs.size(), 2u);
  const StyleInfo info = read_style_info(learnt.file, "style").value();
  EXPECT_EQ(info.origin, "2 pairs, 7.00 s: neutral.bvh -> styled.bvh; neutral.bvh -> styled.bvh");
  EXPECT_EQ(info.description, "bent forward");
}

TEST(LearnStyle, half_a_model_learns_too) {
  const TensorFile half = test::shipped_model("panache-int8.safetensors");
  const std::vector<LearnPair> pairs = {test::make_pair(test::neutral_walk(), test::bent_walk())};
  const LearntStyle learnt = learn_style(half, "int8.safetensors", pairs, "bent", "").value();
  EXPECT_LT(learnt.held_back_cm, 0.25 * learnt.untouched_cm);
  EXPECT_TRUE(add_style(half, "int8.safetensors", learnt.file, "style", false).ok());
}

TEST(LearnStyle, says_what_it_cannot_learn_on_or_from) {
  const std::vector<LearnPair> pairs = {test::make_pair(test::neutral_walk(2), test::bent_walk(2))};
  const std::string cure =
      ": has no trunk that styles can be learnt on; expected a model of recipe panache with "
      "'learn.mean' and 'learn.scale'";
  for (const Recipe* recipe : {&test::kPanache, &test::kSmith2019}) {
    const TensorFile model = test::make_model({"old"}, 1, *recipe);
    EXPECT_EQ(failure(learn_style(model, "m.safetensors", pairs, "bent", "")),
              "m.safetensors" + cure);
  }
  EXPECT_EQ(failure(learn_style(test::shipped_model(), "m", {}, "bent", "")),
            "there is nothing to learn 'bent' from; give a neutral and a styled clip");
  EXPECT_NE(failure(learn_style(test::shipped_model(), "m", pairs, "a=b", "")), "");
}

TEST(LearnStyle, finds_no_match_where_the_neutral_clip_is_much_too_short) {
  // 5 s that may advance by 3 of a half second's 15 frames at a time, and wait twice in a row.
  LearnPair pair = test::make_pair(test::neutral_walk(2), test::bent_walk(5));
  pair.neutral.body.resize(15);
  pair.neutral.rotations.resize(15);
  pair.neutral.root.resize(15);
  pair.neutral.contacts.resize(15);
  const std::string message =
      failure(learn_style(test::shipped_model(), "m", std::span(&pair, 1), "bent", ""));
  EXPECT_EQ(message,
            "neutral.bvh and styled.bvh: no match was found between them, as the neutral one is "
            "too short for the styled one; a pair shows one action, done neutrally and in the "
            "style");
}

TEST(LearnStyle, warns_of_what_does_not_match) {
  // A walk seen beside standing still with waving arms.
  Clip waving = test::neutral_walk(3);
  for (int f = 0; f < waving.frames; ++f) {
    const Pose pose = waving.pose(f);
    for (Quat& q : pose.rotations) q = Quat{};
    pose.translations[0] = waving.pose(0).translations[0];
    const float angle = 1.5f * std::sin(static_cast<float>(f) * 0.9f);
    pose.rotations[index(HumanJoint::left_upper_arm)] = axis_angle(Vec3{0, 0, 1}, angle);
    pose.rotations[index(HumanJoint::head)] = axis_angle(Vec3{0, 1, 0}, angle);
  }
  const LearntStyle odd = learn({test::make_pair(test::neutral_walk(), waving)});
  ASSERT_EQ(odd.pairs[0].warnings.size(), 1u);
  EXPECT_NE(odd.pairs[0].warnings[0].find("match badly"), std::string::npos)
      << odd.pairs[0].warnings[0];
  const LearntStyle slow =
      learn({test::make_pair(test::neutral_walk(6), test::bent_walk(6, 0.3f, 2.4))});
  ASSERT_EQ(slow.pairs[0].warnings.size(), 1u) << slow.pairs[0].tempo;
  char tempo[20];
  std::snprintf(tempo, sizeof tempo, "%.2f", 1 / slow.pairs[0].tempo);
  EXPECT_EQ(slow.pairs[0].warnings[0],
            "neutral.bvh and styled.bvh: the style takes " + std::string(tempo) +
                " times as long as the neutral motion, expected 0.50 to 2.00; beyond that the "
                "tempo is not followed; record a neutral take nearer to it");
}

TEST(LearnStyle, warns_of_clips_under_two_seconds) {
  const std::string more = " s; 2 to 3 s of a walk, or the whole of an action, teach more";
  const auto warnings = [](double neutral, double styled) {
    return learn({test::make_pair(test::neutral_walk(neutral), test::bent_walk(styled))})
        .pairs[0]
        .warnings;
  };
  EXPECT_EQ(warnings(3, 0.8), std::vector{"styled.bvh: has only 0.80" + more});
  EXPECT_EQ(warnings(1.8, 3), std::vector{"neutral.bvh: has only 1.80" + more});
  EXPECT_EQ(warnings(2, 2), std::vector<std::string>{});
}

TEST(LearnStyle, its_verdict_follows_the_error_on_what_was_held_back) {
  const auto verdict = [](double held_back, double mean_posture, double untouched) {
    LearntStyle learnt;
    learnt.judged = true;
    learnt.held_back_cm = held_back;
    learnt.mean_posture_cm = mean_posture;
    learnt.untouched_cm = untouched;
    return std::string(learnt.verdict());
  };
  EXPECT_STREQ(LearntStyle{}.verdict(), "");
  EXPECT_EQ(verdict(2.0, 5.6, 8.8), "good");
  EXPECT_EQ(verdict(0.3, 0.2, 8.8), "good");  // A style that is nothing but a posture.
  EXPECT_EQ(verdict(4.0, 3.0, 8.8), "fair");  // Its mean posture alone is better.
  EXPECT_EQ(verdict(7.5, 8.0, 8.8), "fair");
  EXPECT_EQ(verdict(8.8, 9.0, 8.8), "poor");
  EXPECT_EQ(verdict(9.5, 3.0, 8.8), "poor");
  EXPECT_EQ(verdict(0, 0, 0), "poor");
}

TEST(LearnStyle, that_is_no_better_than_the_input_says_so_though_the_clips_match) {
  // Bent in three quarters of the clip, and upright in the one that is held back.
  Clip half = test::bent_walk(6);
  const Clip walk = test::neutral_walk(6);
  for (int f = half.frames * 3 / 4; f < half.frames; ++f) {
    std::ranges::copy(walk.pose(f).rotations, half.pose(f).rotations.begin());
  }
  const LearntStyle learnt = learn({test::make_pair(walk, half)});
  EXPECT_LT(learnt.pairs[0].match, 0.35);
  EXPECT_STREQ(learnt.verdict(), "poor");
  ASSERT_EQ(learnt.warnings.size(), 1u);
  EXPECT_TRUE(learnt.warnings[0].starts_with(
      "'bent' is no better than the input on the part of the clips that was held back ("))
      << learnt.warnings[0];
  EXPECT_TRUE(
      learnt.warnings[0].ends_with("; record 2 to 3 s of one action, neutrally and in the style"));
  const LearntStyle good = learn({test::make_pair(walk, test::bent_walk(6))});
  EXPECT_STREQ(good.verdict(), "good");
  EXPECT_TRUE(good.warnings.empty());
}

TEST(LearnStyle, finds_no_style_between_a_motion_and_itself) {
  const LearnPair pair = test::make_pair(test::neutral_walk(), test::neutral_walk());
  EXPECT_EQ(
      failure(learn_style(test::shipped_model(), "model.safetensors", {&pair, 1}, "bent", "")),
      "neutral.bvh and styled.bvh: are the same motion, so there is no style to learn; give a "
      "clip in the style as the second one");
}

TEST(LearnStyle, warns_of_a_gesture_with_the_other_hand) {
  // A left and a right arm that is raised once.
  const auto raised = [](HumanJoint arm, float side) {
    Clip clip = test::neutral_walk(2);
    for (int f = 0; f < clip.frames; ++f) {
      const Pose pose = clip.pose(f);
      for (Quat& q : pose.rotations) q = Quat{};
      pose.translations[0] = clip.pose(0).translations[0];
      const float share = static_cast<float>(f) / static_cast<float>(clip.frames);
      const float angle = 2.5f * std::pow(std::sin(3.14159f * share), 2.0f);
      pose.rotations[index(arm)] = axis_angle(Vec3{0, 0, 1}, side * angle);
    }
    return clip;
  };
  const Clip left = raised(HumanJoint::left_upper_arm, 1);
  const Clip right = raised(HumanJoint::right_upper_arm, -1);
  const LearntStyle wrong = learn({test::make_pair(left, right)});
  ASSERT_EQ(wrong.pairs[0].warnings.size(), 1u) << wrong.pairs[0].match;
  EXPECT_EQ(wrong.pairs[0].warnings[0],
            "neutral.bvh and styled.bvh: match better with left and right exchanged; record the "
            "action with the same hand or foot first in both");
}

}  // namespace
}  // namespace panache
