#include "learn/pairing.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "learn/make_takes.h"

namespace panache {
namespace {

TEST(Pairing, a_faster_styled_take_finds_its_phase_and_its_rate) {
  constexpr float kRate = 1.3f;
  const std::vector<Take> takes = {test::make_take("neutral", 200, 0, 1, 0),
                                   test::make_take("old", 90, 1.7f, kRate, 0.4f)};
  const std::vector<Pairing> pairings = pair_takes(takes, {1}, {0});
  ASSERT_FALSE(pairings.empty());
  for (const Pairing& p : pairings) {
    const int frames = static_cast<int>(p.neutral_frames.size());
    double mean_rate = 0;
    for (int i = 4; i < frames - 4; ++i) {
      const float styled_phase = 1.7f + kRate * 0.2f * static_cast<float>(p.first + i);
      const float off =
          std::remainder(0.2f * p.neutral_frames[i] - styled_phase, 2 * std::numbers::pi_v<float>);
      // A neutral frame is 0.2 rad of phase, and the path is made of whole frames before smoothing.
      EXPECT_LT(std::abs(off), 0.2f) << "window at " << p.first << ", frame " << i;
      mean_rate += p.rates[i] / (frames - 8);
    }
    EXPECT_NEAR(mean_rate, kRate, 0.1);
  }
}

TEST(Pairing, windows_cover_the_styled_take_to_its_end) {
  const std::vector<Take> takes = {test::make_take("neutral", 200, 0, 1, 0),
                                   test::make_take("old", 100, 0.5f, 1, 0.4f)};
  const std::vector<Pairing> pairings = pair_takes(takes, {1}, {0});
  EXPECT_EQ(pairings.front().first, 0);
  EXPECT_EQ(pairings.back().first + static_cast<int>(pairings.back().neutral_frames.size()), 100);
}

TEST(Pairing, a_window_never_crosses_from_one_neutral_take_to_another) {
  const std::vector<Take> takes = {test::make_take("neutral", 50, 0, 1, 0),
                                   test::make_take("neutral", 60, 2, 1, 0),
                                   test::make_take("old", 90, 1, 1, 0.4f)};
  for (const Pairing& p : pair_takes(takes, {2}, {0, 1})) {
    for (const float frame : p.neutral_frames) {
      EXPECT_GE(frame, -1);
      EXPECT_LE(frame, static_cast<float>(takes[p.neutral].frames()));
    }
  }
}

TEST(Pairing, without_a_long_enough_neutral_take_there_is_no_pair) {
  const std::vector<Take> takes = {test::make_take("neutral", 10, 0, 1, 0),
                                   test::make_take("old", 90, 1, 1, 0.4f)};
  EXPECT_TRUE(pair_takes(takes, {1}, {0}).empty());
}

// make_take()'s cycle of 31 frames, on feet that step in turn.
Take stepping(const std::string& style, int frames, float start, float rate) {
  Take take = test::make_take(style, frames, start, rate, 0.4f);
  for (int f = 0; f < frames; ++f) {
    const float ahead = 0.3f * std::sin(start + rate * 0.2f * static_cast<float>(f));
    for (const HumanJoint joint : {HumanJoint::left_foot, HumanJoint::left_toes}) {
      take.body[f][index(joint)].z = ahead;
    }
    for (const HumanJoint joint : {HumanJoint::right_foot, HumanJoint::right_toes}) {
      take.body[f][index(joint)].z = -ahead;
    }
  }
  write_numbers(PoseLayout::positions, take);
  return take;
}

TEST(Pairing, a_run_shorter_than_a_window_is_paired_in_step) {
  // One cycle and a third of it: 45 frames find no place there that is in step to their end.
  for (const float start : {1.0f, 2.0f, 3.0f, 4.0f, 5.0f}) {
    const std::vector<Take> takes = {stepping("neutral", 41, 0, 1), stepping("old", 60, start, 1)};
    const std::vector<Pairing> pairings = pair_takes(takes, {1}, {0});
    ASSERT_FALSE(pairings.empty());
    EXPECT_GT(*step_agreement(takes, pairings), 0.95) << start;
    EXPECT_EQ(pairings.front().first, 0);
    EXPECT_EQ(pairings.back().first + static_cast<int>(pairings.back().neutral_frames.size()), 60);
  }
}

TEST(Pairing, step_agreement_tells_left_from_right) {
  const std::vector<Take> takes = {stepping("neutral", 60, 0, 1), stepping("old", 60, 0, 1),
                                   stepping("old", 60, std::numbers::pi_v<float>, 1),
                                   test::make_take("old", 60, 0, 1, 0)};
  Pairing same;
  for (int f = 0; f < 60; ++f) same.neutral_frames.push_back(static_cast<float>(f));
  const auto agreement = [&](int styled) {
    same.styled = styled;
    return step_agreement(takes, {same});
  };
  EXPECT_NEAR(*agreement(1), 1, 1e-6);
  EXPECT_NEAR(*agreement(2), -1, 1e-6);
  EXPECT_FALSE(agreement(3).has_value());  // Its feet move together.
}

TEST(Pairing, styles_are_compared_within_their_own_set_only) {
  std::vector<Take> takes = {test::make_take("neutral", 200, 0, 1, 0),
                             test::make_take("old", 90, 1, 1, 0.4f)};
  takes[1].row.set = 1;
  EXPECT_TRUE(pair_takes(takes, {1}, {0}).empty());
}

// A body that stands, its joints where make_take() has them, and shakes by `shake` metres; its
// right hand goes up and down once, as the share 0 to 1 of `course` says.
Take raising(const std::string& style, const std::vector<float>& course, float shake,
             uint64_t seed) {
  Take take = test::make_take(style, static_cast<int>(course.size()), 0, 0, 0);
  Random random(seed);
  HumanPositions sway{};
  for (size_t f = 0; f < course.size(); ++f) {
    for (int j = 1; j < kHumanJoints; ++j) {
      // Slow wandering, as of someone who stands and waits.
      sway[j] = sway[j] * 0.95f + Vec3{random.normal(), random.normal(), random.normal()} * 0.31f;
      take.body[f][j] += sway[j] * shake;
    }
    take.body[f][index(HumanJoint::right_hand)].y +=
        0.6f * std::sin(std::numbers::pi_v<float> * course[f]);
  }
  write_numbers(PoseLayout::positions, take);
  return take;
}

// `frames` frames from 0 to 1, with `still` frames of rest at either end.
std::vector<float> evenly(int frames, int still = 30) {
  std::vector<float> course(still, 0.0f);
  for (int f = 0; f < frames; ++f) {
    course.push_back(static_cast<float>(f) / static_cast<float>(frames - 1));
  }
  course.insert(course.end(), still, 1.0f);
  return course;
}

TEST(Pairing, an_action_of_one_arm_is_aligned_by_it_although_the_body_shakes) {
  // The styled hand begins 20 frames later. Everything else moves by a centimetre.
  std::vector<float> later = evenly(60);
  later.insert(later.begin(), 20, 0.0f);
  const std::vector<float> course = evenly(60);
  double off = 0, count = 0;
  for (const uint64_t seed : {1, 2, 3}) {
    const std::vector<Take> takes = {raising("neutral", course, 0.01f, seed),
                                     raising("old", later, 0.01f, seed + 100)};
    for (const Pairing& p : pair_takes(takes, {1}, {0})) {
      for (size_t i = 4; i + 4 < p.neutral_frames.size(); ++i) {
        const float wanted = later[p.first + i];
        // Where the hand moves clearly; at the top and at rest no frame is like its neighbours.
        if (wanted < 0.1f || wanted > 0.9f || std::abs(wanted - 0.5f) < 0.15f) continue;
        const float at = std::clamp(p.neutral_frames[i], 0.0f, course.size() - 1.0f);
        off += std::abs(course[static_cast<size_t>(at + 0.5f)] - wanted) * 59;
        ++count;
      }
    }
  }
  ASSERT_GT(count, 100);
  EXPECT_LT(off / count, 4) << "frames";
}

TEST(Pairing, a_styled_take_that_dwells_is_followed) {
  // Half as fast all the way: one wait for every frame.
  const std::vector<float> course = evenly(40, 15), slow = evenly(80, 15);
  const std::vector<Take> takes = {raising("neutral", course, 0, 1), raising("old", slow, 0, 1)};
  double rate = 0, count = 0;
  for (const Pairing& p : pair_takes(takes, {1}, {0})) {
    for (size_t i = 4; i + 4 < p.neutral_frames.size(); ++i) {
      const float wanted = slow[p.first + i];
      if (wanted < 0.05f || wanted > 0.95f) continue;
      const float at = std::clamp(p.neutral_frames[i], 0.0f, course.size() - 1.0f);
      EXPECT_NEAR(course[static_cast<size_t>(at + 0.5f)], wanted, 0.1) << p.first + i;
      rate += p.rates[i];
      ++count;
    }
  }
  ASSERT_GT(count, 80);
  EXPECT_NEAR(rate / count, 0.5, 0.1);
}

}  // namespace
}  // namespace panache
