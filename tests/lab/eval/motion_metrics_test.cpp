#include "eval/motion_metrics.h"

#include <cmath>
#include <functional>
#include <numbers>

#include <gtest/gtest.h>

#include "eval/metrics.h"
#include "make_clip.h"

namespace panache {
namespace {

// A body at rest, every joint a metre high, whose ground follows `path` (metres of seconds).
Take moving(int frames, const std::function<Vec3(float)>& path) {
  Take take;
  HumanPositions body;
  for (Vec3& joint : body) joint = {0, 1, 0};
  for (int f = 0; f < frames; ++f) {
    take.body.push_back(body);
    take.root.push_back({path(static_cast<float>(f) / 30), 0});
  }
  return take;
}

Take sliding(float speed, int frames = 91) {
  return moving(frames, [speed](float t) { return Vec3{0, 0, speed * t}; });
}

void put(Take& take, std::initializer_list<HumanJoint> joints, float height) {
  for (HumanPositions& body : take.body) {
    for (const HumanJoint joint : joints) body[index(joint)].y = height;
  }
}
constexpr std::initializer_list<HumanJoint> kBothToes = {HumanJoint::left_toes,
                                                         HumanJoint::right_toes};

TEST(Jerk, of_a_cubic_is_its_third_derivative) {
  const Take cubic = moving(31, [](float t) { return Vec3{2 * t * t * t, 0, t * t}; });
  // Third differences of numbers below 2 in single precision: 8 * 1e-7 * 30^3.
  EXPECT_NEAR(mean_jerk(cubic), 12, 0.03);
}

TEST(Jerk, of_one_joint_is_shared_among_all) {
  Take take = moving(31, [](float) { return Vec3{}; });
  for (int f = 0; f < take.frames(); ++f) {
    const float t = static_cast<float>(f) / 30;
    take.body[f][index(HumanJoint::left_hand)].x = 2 * t * t * t;
  }
  EXPECT_NEAR(mean_jerk(take), 12.0 / kHumanJoints, 0.03 / kHumanJoints);
}

TEST(Jerk, of_an_even_acceleration_and_of_too_few_frames_is_none) {
  EXPECT_NEAR(mean_jerk(moving(31, [](float t) { return Vec3{t * t, 0, 0}; })), 0, 0.03);
  EXPECT_EQ(mean_jerk(moving(3, [](float t) { return Vec3{t * t * t, 0, 0}; })), 0);
}

TEST(Skating, a_low_foot_that_slides_skates_all_the_time) {
  for (const HumanJoint toe : kToes) {
    Take take = sliding(0.6f);
    put(take, {toe}, 0.02f);
    EXPECT_DOUBLE_EQ(skating_ratio(take), 1);
  }
}

TEST(Skating, a_foot_that_stands_or_is_slow_or_high_does_not) {
  for (const auto& [speed, height] :
       {std::pair{0.0f, 0.02f}, std::pair{0.45f, 0.02f}, std::pair{2.0f, 0.06f}}) {
    Take take = sliding(speed);
    put(take, kBothToes, height);
    EXPECT_EQ(skating_ratio(take), 0) << speed << " m/s, " << height << " m high";
  }
}

TEST(Skating, up_and_down_is_no_slide) {
  Take take = moving(91, [](float t) { return Vec3{0, 0.02f * std::sin(40 * t), 0}; });
  put(take, kBothToes, 0.02f);
  EXPECT_EQ(skating_ratio(take), 0);
  EXPECT_EQ(weighted_skating(take), 0);
}

TEST(Skating, a_foot_that_is_high_half_of_the_time_skates_the_other_half) {
  Take take = sliding(1);
  for (int f = 0; f < take.frames(); ++f) {
    for (const HumanJoint toe : kToes) take.body[f][index(toe)].y = f < 45 ? 0.02f : 0.2f;
  }
  // 60 steps of 1/20 s, of which the first 29 both begin and end before 1.5 s, when it is lifted.
  EXPECT_DOUBLE_EQ(skating_ratio(take), 29.0 / 60);
}

TEST(Skating, a_single_jump_counts_once_and_only_if_the_mean_of_five_is_fast) {
  // A jump within one twentieth of a second, so five frames have the mean speed of 4 jumps.
  for (const auto& [jump, slides] : {std::pair{0.2f, 1}, std::pair{0.1f, 0}}) {
    Take take = moving(91, [jump](float t) { return Vec3{0, 0, t > 1.01f ? jump : 0}; });
    put(take, kBothToes, 0.02f);
    EXPECT_DOUBLE_EQ(skating_ratio(take), slides / 60.0) << jump;
  }
}

TEST(WeightedSkating, a_slide_on_the_floor_counts_whole_and_higher_up_less) {
  const auto toes_at = [](float height) {
    Take take = sliding(1);
    put(take, kBothToes, height);
    return weighted_skating(take);
  };
  // The ankles are a metre high and count nothing: half of the four joints slide at 1 m/s.
  EXPECT_NEAR(toes_at(0), 0.5, 1e-5);
  EXPECT_NEAR(toes_at(-0.1f), 0.5, 1e-5);
  EXPECT_NEAR(toes_at(0.0125f), 0.5 * (2 - std::sqrt(2.0)), 1e-5);
  EXPECT_NEAR(toes_at(0.025f), 0, 1e-5);
  EXPECT_EQ(toes_at(0.2f), 0);
}

TEST(WeightedSkating, is_proportional_to_the_speed_and_counts_the_ankles_too) {
  Take take = sliding(0.3f);
  put(take,
      {HumanJoint::left_toes, HumanJoint::right_toes, HumanJoint::left_foot,
       HumanJoint::right_foot},
      0);
  EXPECT_NEAR(weighted_skating(take), 0.3, 1e-5);
}

// Feet that swing past each other `cycles` times a second, there and back, with a tremor.
Take gait(float cycles, float speed, float tremor = 0, float seconds = 4) {
  Take take = sliding(speed, static_cast<int>(seconds * 30) + 1);
  for (int f = 0; f < take.frames(); ++f) {
    const float phase = 2 * std::numbers::pi_v<float> * cycles * static_cast<float>(f) / 30;
    const float z = 0.3f * std::sin(phase + 0.4f) + (f % 2 ? tremor : -tremor);
    take.body[f][index(kAnkles[0])].z = z;
    take.body[f][index(kAnkles[1])].z = -z;
  }
  return take;
}

TEST(Cadence, the_feet_pass_each_other_twice_a_cycle) {
  // Where they meet is found between frames; a sine is nearly straight there.
  EXPECT_NEAR(cadence(gait(0.9f, 1.2f)), 1.8, 0.01);
  EXPECT_NEAR(cadence(gait(1.4f, 3)), 2.8, 0.02);
}

TEST(Cadence, feet_that_tremble_where_they_meet_take_no_more_steps) {
  EXPECT_NEAR(cadence(gait(0.9f, 1.2f, 0.04f)), 1.8, 0.05);
}

TEST(Cadence, of_one_who_stands_or_hardly_steps_is_not_measured) {
  EXPECT_TRUE(std::isnan(cadence(gait(0.9f, 0))));
  EXPECT_TRUE(std::isnan(cadence(gait(0.9f, 0.45f))));
  EXPECT_TRUE(std::isnan(cadence(gait(0.9f, 1.2f, 0, 0.6f)))) << "one step";
  EXPECT_TRUE(std::isnan(cadence(sliding(1))));
  EXPECT_TRUE(std::isnan(cadence(sliding(1, 1))));
}

TEST(Distance, is_the_mean_over_joints_of_how_far_they_are_from_the_source_frame) {
  Take from = sliding(1), take = from;
  for (int f = 0; f < from.frames(); ++f) {
    for (Vec3& joint : from.body[f]) joint.x = 0.01f * static_cast<float>(f);
  }
  std::vector<float> source;
  for (int f = 0; f < take.frames(); ++f) {
    source.push_back(0.5f * static_cast<float>(f));
    for (Vec3& joint : take.body[f]) joint.x = 0.005f * static_cast<float>(f);
  }
  EXPECT_NEAR(mean_distance(take, from, source), 0, 1e-6);
  for (HumanPositions& body : take.body) body[index(HumanJoint::head)].y += 0.21f;
  EXPECT_NEAR(mean_distance(take, from, source), 0.01, 1e-6);
}

Take named(const std::string& path, const std::string& style, const std::string& content, float x) {
  Take take = sliding(1, 10);
  take.row.path = path;
  take.row.style = style;
  take.row.content = content;
  for (HumanPositions& body : take.body) {
    for (Vec3& joint : body) joint.x = x;
  }
  return take;
}

TEST(DistanceToReal, sums_the_joints_over_the_frames_that_both_have) {
  Take shorter = named("b", "old", "walk", 0.1f);
  shorter.body.resize(4);
  Take other = named("a", "old", "walk", 0);
  for (Vec3& joint : other.body[7]) joint.x = 100;  // The shorter one never comes to this frame.
  EXPECT_NEAR(summed_distance(other, shorter), 0.1 * kHumanJoints, 1e-5);
}

TEST(DistanceToReal, leaves_the_same_file_and_other_styles_and_contents_out) {
  const std::vector<Take> takes = {named("a", "old", "walk", 0)};
  const std::vector<Take> real = {named("a", "old", "walk", 9), named("b", "old", "walk", 0.1f),
                                  named("c", "sad", "walk", 9)};
  const std::vector<Take> more = {named("d", "old", "run", 9), named("e", "old", "walk", 0.3f)};
  EXPECT_NEAR(distance_to_real(takes, real, more), 0.2 * kHumanJoints, 1e-5);
  EXPECT_TRUE(std::isnan(distance_to_real(takes, takes, takes)));
}

TEST(BoneLengths, a_clip_that_only_turns_keeps_them) {
  const Clip from = test::walking_clip(20);
  Clip clip = from;
  for (int f = 0; f < clip.frames; ++f) {
    for (size_t j = 0; j < clip.joints(); ++j) {
      clip.pose(f).rotations[j] =
          axis_angle(Vec3{0, 1, 0}, 0.1f * static_cast<float>(j)) * clip.pose(f).rotations[j];
    }
    clip.pose(f).translations[0] += Vec3{5, 0, 3};  // The root may go anywhere.
  }
  std::vector<double> frames;
  for (int f = 0; f < clip.frames; ++f) frames.push_back(0.5 * f);
  // World positions up to 10 m in single precision.
  EXPECT_LT(bone_length_error(clip, from, frames), 5e-6);
}

TEST(BoneLengths, what_leads_to_the_hips_may_grow) {
  const Clip from = test::walking_clip(20);
  Clip clip = from;
  const std::vector<double> frames = {0, 1, 2};
  clip.resize(3);
  // Joint 1 stands for hips on a root of their own.
  clip.pose(1).translations[1] *= 3.0f;
  EXPECT_GT(bone_length_error(clip, from, frames), 0.01);
  EXPECT_LT(bone_length_error(clip, from, frames, 1), 1e-5);
}

TEST(BoneLengths, the_largest_stretch_of_any_frame_is_found) {
  const Clip from = test::walking_clip(20);
  Clip clip = from;
  const size_t knee = static_cast<size_t>(index(HumanJoint::left_lower_leg));
  const Vec3 thigh = clip.pose(13).translations[knee];
  clip.pose(13).translations[knee] = thigh * 0.9f;
  clip.pose(14).translations[knee] = thigh * 1.05f;
  std::vector<double> frames;
  for (int f = 0; f < clip.frames; ++f) frames.push_back(f);
  EXPECT_NEAR(bone_length_error(clip, from, frames), 0.1 * length(thigh), 1e-5);
}

TEST(BoneLengths, what_the_file_itself_stretches_is_no_error) {
  Clip from = test::walking_clip(20);
  const size_t knee = static_cast<size_t>(index(HumanJoint::left_lower_leg));
  for (int f = 0; f < from.frames; ++f) {
    const Vec3 thigh = from.pose(f).translations[knee];
    from.pose(f).translations[knee] = thigh * (1 + 0.01f * static_cast<float>(f));
  }
  Clip clip = from;
  std::vector<double> frames;
  for (int f = 0; f < clip.frames; ++f) frames.push_back(f);
  EXPECT_LT(bone_length_error(clip, from, frames), 1e-6);
  std::reverse(frames.begin(), frames.end());
  const Vec3 thigh = test::walking_clip(1).pose(0).translations[knee];
  EXPECT_NEAR(bone_length_error(clip, from, frames), 0.19 * length(thigh), 1e-5);
}

TEST(RankCorrelation, sees_order_and_not_size) {
  EXPECT_DOUBLE_EQ(rank_correlation({0, 0.25, 0.5, 1}, {-7, 0.1, 0.2, 900}), 1);
  EXPECT_DOUBLE_EQ(rank_correlation({0, 0.25, 0.5, 1}, {5, 4, 3, -80}), -1);
  // Differences of ranks 1, 1, 0, 0: 1 - 6 * 2 / (4 * 15).
  EXPECT_DOUBLE_EQ(rank_correlation({1, 2, 3, 4}, {2, 1, 3, 4}), 0.8);
}

TEST(RankCorrelation, equal_numbers_share_their_rank) {
  // Ranks 0, 1.5, 1.5, 3 against 0, 1, 2, 3: 4.5 / sqrt(4.5 * 5).
  const double expected = 4.5 / std::sqrt(4.5 * 5);
  EXPECT_DOUBLE_EQ(rank_correlation({1, 2, 2, 3}, {1, 2, 3, 4}), expected);
  EXPECT_DOUBLE_EQ(rank_correlation({1, 2, 2, 3}, {1, 3, 2, 4}), expected);
}

TEST(RankCorrelation, of_a_constant_is_none) {
  EXPECT_TRUE(std::isnan(rank_correlation({1, 2, 3}, {4, 4, 4})));
  EXPECT_TRUE(std::isnan(rank_correlation({4, 4, 4}, {1, 2, 3})));
  EXPECT_TRUE(std::isnan(rank_correlation({1}, {1})));
}

}  // namespace
}  // namespace panache
