#include "style/play/input_ring.h"

#include <cmath>

#include <gtest/gtest.h>

#include "make_clip.h"

namespace panache {
namespace {

// The clip's poses at times of their own; bodies and grounds that say which they are.
class InputRingTest : public testing::Test {
 protected:
  void push(InputRing& ring, int frame, double time) const {
    HumanPositions body{};
    body[0].x = static_cast<float>(time);
    ring.push(time, clip_.pose(frame), body, {{static_cast<float>(time), 0, 0}, 0});
  }
  Clip clip_ = test::walking_clip(200, 60);
  Clip out_ = test::walking_clip(1, 60);
};

TEST_F(InputRingTest, a_pose_comes_back_bit_for_bit_at_its_own_time) {
  InputRing ring(clip_.joints(), 1);
  for (int f = 0; f < 30; ++f) push(ring, f, f / 60.0);
  for (const int f : {0, 7, 29}) {
    ring.pose(f / 60.0, out_.pose(0));
    for (size_t j = 0; j < clip_.joints(); ++j) {
      EXPECT_EQ(out_.pose(0).rotations[j], clip_.pose(f).rotations[j]);
      EXPECT_EQ(out_.pose(0).translations[j], clip_.pose(f).translations[j]);
    }
  }
}

TEST_F(InputRingTest, every_pose_of_a_tracker_of_90_or_120_hz_is_kept) {
  for (const double rate : {90.0, 120.0}) {
    InputRing ring(clip_.joints(), 2);
    for (int f = 0; f < 150; ++f) push(ring, f, f / rate);
    for (int f = 0; f < 150; ++f) {
      ring.pose(f / rate, out_.pose(0));
      ASSERT_EQ(out_.pose(0).translations[0], clip_.pose(f).translations[0])
          << rate << " Hz, pose " << f;
    }
  }
}

TEST_F(InputRingTest, between_poses_and_beyond_them_time_is_straight_and_held) {
  InputRing ring(clip_.joints(), 1);
  for (int f = 0; f < 30; ++f) push(ring, f, 1 + f / 30.0);
  EXPECT_NEAR(ring.root(1.51).position.x, 1.51f, 1e-5f);
  EXPECT_NEAR(ring.body(1.77)[0].x, 1.77f, 1e-5f);
  EXPECT_EQ(ring.root(0).position.x, 1);
  EXPECT_EQ(ring.root(9).position.x, static_cast<float>(1 + 29 / 30.0));
}

TEST_F(InputRingTest, keeps_its_seconds_at_any_rate) {
  for (const double fps : {10.0, 60.0, 90.0, 1000.0}) {
    InputRing ring(clip_.joints(), 1.5);
    double time = 0;
    for (int i = 0; i < 5 * static_cast<int>(fps); ++i) push(ring, i % 200, time = i / fps);
    EXPECT_EQ(ring.newest(), time);
    EXPECT_LE(ring.oldest(), time - 1.5) << fps;
    // What lies between is there, not only the ends.
    EXPECT_NEAR(ring.root(time - 1).position.x, static_cast<float>(time - 1), 1e-4f) << fps;
  }
}

TEST_F(InputRingTest, one_pose_is_that_pose_at_any_time) {
  InputRing ring(clip_.joints(), 1);
  push(ring, 3, 7);
  for (const double time : {0.0, 7.0, 100.0}) EXPECT_EQ(ring.root(time).position.x, 7);
  ring.clear();
  EXPECT_TRUE(ring.empty());
}

}  // namespace
}  // namespace panache
