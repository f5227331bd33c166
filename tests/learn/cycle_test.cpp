#include "learn/pairing.h"

#include <cmath>

#include <gtest/gtest.h>

#include "learn/learn_style.h"
#include "make_walks.h"

namespace panache {
namespace {

constexpr int kStart = 30;  // The walker walks evenly from here on.

double seam(const Clip& clip, int a, int b) {
  double sum = 0;
  for (size_t j = 0; j < clip.joints(); ++j) {
    const Quat between = conjugate(clip.pose(a).rotations[j]) * clip.pose(b).rotations[j];
    sum += static_cast<double>(length(log_rotation(between)));
  }
  return sum;
}

// Frames of a stride.
int stride(const Clip& walk) {
  int best = 20;
  for (int n = 20; n < 50; ++n) {
    if (seam(walk, kStart, kStart + n) < seam(walk, kStart, kStart + best)) best = n;
  }
  return best;
}

// One stride from a frame on, whose last pose is its first one again but for the way it went.
Clip one_cycle(const Clip& walk, int first, int frames) {
  Clip out{walk.skeleton, walk.frame_time, 0, {}, {}};
  out.resize(frames + 1);
  for (int f = 0; f <= frames; ++f) {
    const Pose pose = out.pose(f);
    sample(walk, first + f, pose);
  }
  std::ranges::copy(out.pose(0).rotations, out.pose(frames).rotations.begin());
  out.pose(frames).translations[0].y = out.pose(0).translations[0].y;
  return out;
}

bool has(const std::vector<std::string>& warnings, const std::string& what) {
  return std::ranges::any_of(
      warnings, [&](const std::string& one) { return one.find(what) != std::string::npos; });
}

TEST(Cycle, is_found_where_the_last_pose_is_the_first) {
  const Clip walk = test::neutral_walk(6);
  const int frames = stride(walk);
  const auto cycle = [&](const Clip& clip) { return cycle_frames(clip, *Rig::create(clip)); };
  EXPECT_EQ(cycle(one_cycle(walk, kStart, frames)), frames);
  // The frame that repeats the first may be missing.
  Clip open = one_cycle(walk, kStart, frames);
  open.resize(frames);
  EXPECT_EQ(cycle(open), frames);
  open.resize(frames * 3 / 4);
  EXPECT_EQ(cycle(open), 0);
  EXPECT_EQ(cycle(walk), 0);
}

TEST(Cycle, of_a_pair_may_start_anywhere) {
  const Clip walk = test::neutral_walk(8), bent = test::bent_walk(8);
  const int frames = stride(walk);
  Clip neutral = one_cycle(walk, kStart, frames);
  neutral.frame_time = 0.0333333;  // As files have it: the take ends a frame earlier.
  for (const int quarter : {0, 1, 2, 3}) {
    const Clip styled = one_cycle(bent, kStart + quarter * frames / 4, frames);
    const LearnPair pair = test::make_pair(neutral, styled);
    const LearntStyle learnt = test::learn({pair});
    const PairReport& report = learnt.pairs[0];
    EXPECT_LT(report.match, 0.2) << quarter;
    EXPECT_NEAR(report.tempo, 1, 0.05) << quarter;  // Whole frames, smoothed over 7.
    EXPECT_FALSE(has(report.warnings, "left and right")) << quarter;
    EXPECT_FALSE(has(report.warnings, "out of step")) << quarter;
    EXPECT_TRUE(has(report.warnings, "neutral.bvh: has only")) << quarter;
    EXPECT_STREQ(learnt.verdict(), "good") << quarter;
    // In the time of the clip that was given.
    const double late = quarter * frames / 4 / kTakeRate, length = frames / kTakeRate;
    for (const MatchedInstant& at : report.instants) {
      EXPECT_LT(at.neutral_seconds, length + 1e-6);
      const double apart = at.neutral_seconds - at.styled_seconds - late;
      EXPECT_LT(std::abs(std::remainder(apart, length)), 0.1) << quarter;
    }
  }
}

TEST(Cycle, goes_on_where_it_ended) {
  // A walk in a circle: each cycle turns and goes as the first did.
  Clip walk = test::neutral_walk(6);
  for (int f = 0; f < walk.frames; ++f) {
    const Quat turn = rotation_y(0.02f * static_cast<float>(f));
    const Pose pose = walk.pose(f);
    pose.rotations[0] = turn * pose.rotations[0];
    const Vec3 at = pose.translations[0];
    pose.translations[0] = rotate(turn, Vec3{2, 0, 0}) + Vec3{0, at.y, 0};
  }
  const int frames = stride(test::neutral_walk(6));
  Clip cycle{walk.skeleton, walk.frame_time, 0, {}, {}};
  cycle.resize(frames + 1);
  for (int f = 0; f <= frames; ++f) sample(walk, kStart + f, cycle.pose(f));
  Clip styled = one_cycle(test::bent_walk(8), kStart + frames / 2, frames);
  const LearnPair pair = test::make_pair(cycle, styled);
  std::vector<Take> takes = {pair.neutral, pair.styled};
  takes[0].row.neutral = true;
  takes[1].row.style = "styled";
  pair_in_phase(takes, 1, 0, pair.neutral_cycle);
  ASSERT_GT(takes[0].frames(), 2 * frames);
  for (int f = 1; f < takes[0].frames(); ++f) {
    const RootPose &before = takes[0].root[f - 1], &now = takes[0].root[f];
    EXPECT_NEAR(now.facing - before.facing, 0.02f, 0.04f) << f;
    EXPECT_NEAR(length(now.position - before.position), 0.04f, 0.03f) << f;
    EXPECT_NEAR(length(now.position), 2, 0.3f) << f;
  }
}

}  // namespace
}  // namespace panache
