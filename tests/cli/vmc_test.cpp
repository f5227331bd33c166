// The way from Unity's coordinates to ours and back.

#include <array>
#include <bit>
#include <cstdint>

#include <gtest/gtest.h>

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

// A turn to the right is a positive one about Unity's y, and a negative one about ours.
TEST(VmcCoordinates, a_turn_to_the_right_stays_one) {
  const Quat right = rotation_y(0.5f);
  EXPECT_GT(rotate(right, Vec3{0, 0, 1}).x, 0);                     // Unity's right is +x,
  EXPECT_LT(rotate(mirrored_rotation(right), Vec3{0, 0, 1}).x, 0);  // ours -x.
}

}  // namespace
}  // namespace panache::test
