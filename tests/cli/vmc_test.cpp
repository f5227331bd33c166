// The way from Unity's coordinates to ours and back.

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>

#include <gtest/gtest.h>

#include "../../apps/cli/vmc_bones.h"
#include "../../apps/cli/vmc_filter.h"
#include "../../apps/cli/vmc_messages.h"

namespace panache::test {
namespace {

using cli::mirrored_position;
using cli::mirrored_rotation;

const Vec3 kVectors[] = {{0.1f, -0.2f, 0.3f}, {-0.0f, 0.0f, 1e-30f}, {3, 5, -7}};
const Quat kQuarterTurns[] = {{0.70710678f, 0, 0, 0.70710678f},
                              {0, 0.70710678f, 0, 0.70710678f},
                              {0, 0, 0.70710678f, 0.70710678f}};

std::array<uint32_t, 4> bits(Quat q) {
  return {std::bit_cast<uint32_t>(q.x), std::bit_cast<uint32_t>(q.y), std::bit_cast<uint32_t>(q.z),
          std::bit_cast<uint32_t>(q.w)};
}
std::array<uint32_t, 4> bits(Vec3 v) { return bits(Quat{v.x, v.y, v.z, 0}); }

TEST(VmcCoordinates, there_and_back_is_the_same_to_the_bit) {
  for (const Vec3 v : kVectors) {
    EXPECT_EQ(bits(mirrored_position(mirrored_position(v))), bits(v));
    const Quat q = {v.x, v.y, v.z, -0.0f};
    EXPECT_EQ(bits(mirrored_rotation(mirrored_rotation(q))), bits(q));
  }
}

TEST(VmcCoordinates, left_changes_its_sign_and_up_and_ahead_stay) {
  EXPECT_EQ(mirrored_position({1, 2, 3}), (Vec3{-1, 2, 3}));
}

// Unity's rotations are of the same formula on numbers, so that rotating before or after the change
// must be the same.
TEST(VmcCoordinates, a_rotated_point_changes_like_any_other) {
  for (const Quat q : kQuarterTurns) {
    for (const Vec3 v : kVectors) {
      EXPECT_EQ(mirrored_position(rotate(q, v)),
                rotate(mirrored_rotation(q), mirrored_position(v)));
    }
  }
}

// Mirroring and smoothing of tracked poses.

using cli::VmcFilter;

// The skeleton of a few bones, their poses and places.
struct Tracked {
  explicit Tracked(const std::vector<std::string_view>& names) {
    bones.push_back(cli::kVmcRoot);
    for (const std::string_view name : names) bones.push_back(cli::find_vmc_bone(name).value());
    rotations.resize(bones.size());
    translations.resize(bones.size());
  }
  Pose pose() { return {rotations, translations}; }

  std::vector<int> bones;
  std::vector<Quat> rotations;
  std::vector<Vec3> translations;
};

TEST(VmcFilter, a_mirror_raises_the_other_hand_and_turns_the_other_way) {
  Tracked body({"Hips", "LeftUpperArm", "RightUpperArm", "LeftEye"});
  const Quat raised = axis_angle(Vec3{0, 0, 1}, 1.2f);  // The left arm, which points along +x.
  body.rotations = {Quat{}, rotation_y(0.5f), raised, Quat{}, rotation_y(0.2f)};
  body.translations = {{0.3f, 0, 1}, {0.1f, 0.9f, 0}, {0.1f, 0.3f, 0}, {-0.1f, 0.3f, 0}, {}};
  VmcFilter(body.bones, true, 0).apply(body.pose(), 1.0 / 60);
  EXPECT_EQ(body.rotations[2], Quat{});
  // The right arm points along -x, and its hand is as high as the left one was.
  EXPECT_EQ(rotate(body.rotations[3], Vec3{-1, 0, 0}).y, rotate(raised, Vec3{1, 0, 0}).y);
  EXPECT_EQ(body.rotations[1], rotation_y(-0.5f));
  EXPECT_EQ(body.rotations[4], rotation_y(-0.2f));  // Its twin is not tracked.
  EXPECT_EQ(body.translations[0], (Vec3{-0.3f, 0, 1}));
  EXPECT_EQ(body.translations[1], (Vec3{-0.1f, 0.9f, 0}));
  EXPECT_EQ(body.translations[2], (Vec3{0.1f, 0.3f, 0}));  // Its place in the chest.
}

TEST(VmcFilter, two_mirrors_are_none) {
  Tracked body({"Hips", "LeftHand", "RightHand", "Head"});
  for (size_t j = 0; j < body.bones.size(); ++j) {
    const float angle = 0.3f * static_cast<float>(j + 1);
    body.rotations[j] = axis_angle(normalized(Vec3{1, angle, -2}), angle);
    body.translations[j] = {angle, 2 * angle, -angle};
  }
  const Tracked before = body;
  VmcFilter filter(body.bones, true, 0);
  filter.apply(body.pose(), 0.01);
  EXPECT_NE(body.rotations[2], before.rotations[2]);
  filter.apply(body.pose(), 0.01);
  EXPECT_EQ(body.rotations, before.rotations);
  EXPECT_EQ(body.translations, before.translations);
}

// A steady movement lags by the delay and no more; jitter between frames is cut.
TEST(VmcFilter, smoothing_delays_by_its_seconds_and_cuts_jitter) {
  constexpr double kSmooth = 0.1, kStep = 1.0 / 60;
  constexpr float kSpeed = 2, kJitter = 0.05f;
  Tracked body({"Hips"});
  VmcFilter filter(body.bones, false, kSmooth);
  float before = 0, largest = 0;
  for (int f = 0; f < 120; ++f) {
    const float x = kSpeed * static_cast<float>(f * kStep);
    const float jitter = f % 2 ? kJitter : -kJitter;
    body.translations[1] = {x, jitter, 0};
    body.rotations[1] = rotation_y(0.5f * x);
    filter.apply(body.pose(), kStep);
    if (f > 60) {
      const double late = static_cast<double>((x - body.translations[1].x) / kSpeed);
      EXPECT_LE(late, kSmooth);
      EXPECT_GT(late, kSmooth - kStep);  // A frame earlier: the filter takes the newest pose.
      const Quat turned = rotation_y(0.5f * (x - kSpeed * static_cast<float>(late)));
      EXPECT_NEAR(dot(body.rotations[1], turned), 1, 1e-5);
      largest = std::max(largest, std::abs(body.translations[1].y - before));
    }
    before = body.translations[1].y;
  }
  EXPECT_LT(largest, 0.1f * 2 * kJitter);
}

TEST(VmcFilter, a_pause_a_reset_and_numbers_that_are_no_pose_leave_no_trace) {
  Tracked body({"Hips"});
  VmcFilter filter(body.bones, false, 0.2);
  const auto at = [&](float x, double seconds) {
    body.translations[1] = {x, 0, 0};
    body.rotations[1] = Quat{};
    filter.apply(body.pose(), seconds);
    return body.translations[1].x;
  };
  EXPECT_EQ(at(1, 0), 1);
  EXPECT_LT(at(2, 0.01), 1.1f);
  EXPECT_EQ(at(3, 0.6), 3);
  EXPECT_LT(at(4, 0.01), 3.1f);
  filter.reset();
  EXPECT_EQ(at(5, 0.01), 5);
  EXPECT_TRUE(std::isnan(at(std::numeric_limits<float>::quiet_NaN(), 0.01)));
  EXPECT_EQ(at(5, 0.01), 5);
}

}  // namespace
}  // namespace panache::test
