// Playing: the head that moves in time, a clip, a loop, and the input that it looks back on.

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "make_clip.h"
#include "make_jump.h"
#include "style/play/input_ring.h"
#include "style/play/play_clip.h"
#include "style/play/playback.h"

namespace panache {
namespace {

TEST(PlayHead, without_bounds_to_move_in_it_stays_now_whatever_the_style_asks) {
  PlayHead head(0, 0);
  for (const double rate : {0.5, 1.0, 2.0}) EXPECT_EQ(head.advance(0.1, rate, true), 0.1);
  EXPECT_EQ(head.ahead(), 0);
}

TEST(PlayHead, goes_as_fast_as_the_style_asks_and_eases_at_the_bounds) {
  for (const double rate : {0.8, 1.25}) {
    PlayHead head(0.5, 0.25);
    double last = 0.01 * rate;
    for (int i = 0; i < 2000; ++i) {
      const double played = head.advance(0.01, rate, true);
      EXPECT_GE(head.ahead(), -0.5);
      EXPECT_LE(head.ahead(), 0.25);
      // From one step to the next the rate changes by little, never in a jump.
      EXPECT_LT(std::abs(played - last), 0.01 * 0.05);
      last = played;
    }
    // At the bound it goes at the input's own rate.
    EXPECT_NEAR(last, 0.01, 1e-5);
    EXPECT_NEAR(head.ahead(), rate < 1 ? -0.5 : 0.25, 0.02);
  }
}

TEST(PlayHead, between_near_bounds_it_eases_all_the_way_from_their_middle) {
  PlayHead head(0.06, 0.02);
  head.jump(-0.02);
  EXPECT_NEAR(head.room_ahead(), 1, 1e-9);
  EXPECT_NEAR(head.room_behind(), 1, 1e-9);
  head.jump(-0.02);
  EXPECT_NEAR(head.room_ahead(), 1, 1e-9);
  EXPECT_NEAR(head.room_behind(), 0.5, 1e-9);
  head.jump(0.04);
  EXPECT_NEAR(head.room_ahead(), 0.5, 1e-9);
  EXPECT_NEAR(head.room_behind(), 1, 1e-9);
}

TEST(PlayHead, without_a_style_it_returns_to_now_and_then_is_exactly_there) {
  PlayHead head(1, 0.25);
  for (int i = 0; i < 500; ++i) head.advance(0.02, 0.8, true);
  EXPECT_LT(head.ahead(), -0.9);
  double fastest = 0;
  for (int i = 0; i < 1500; ++i) fastest = std::max(fastest, head.advance(0.01, 1, false));
  EXPECT_EQ(head.ahead(), 0);
  EXPECT_EQ(head.advance(0.01, 1, false), 0.01);
  EXPECT_LE(fastest, 0.0111);
}

TEST(PlayHead, no_step_is_so_long_that_a_bound_is_passed_or_time_runs_back) {
  PlayHead head(0.2, 0.1);
  for (const double seconds : {5.0, 0.0, 1e-9, 0.3, 100.0}) {
    for (const double rate : {0.5, 2.0}) {
      EXPECT_GE(head.advance(seconds, rate, true), 0);
      EXPECT_GE(head.ahead(), -0.2);
      EXPECT_LE(head.ahead(), 0.1);
    }
  }
}

// Asks for nothing but a tempo.
class Tempo final : public ChangeSource {
 public:
  explicit Tempo(double rate) { asked_.log_rate = static_cast<float>(std::log(rate)); }
  AskedChange ask(const SourceInput&) override { return asked_; }

 private:
  AskedChange asked_;
};

// The impact of a landing between two frames would be a mean of both.
TEST(PlayClip, with_any_source_a_body_lands_on_whole_frames) {
  const test::Jump jump;
  Clip clip = jump.clip(60);
  // Carried ahead, because a body that stands keeps its input's time.
  for (int f = 0; f < clip.frames; ++f) {
    clip.pose(f).translations[0].z += static_cast<float>(f * clip.frame_time);
  }
  for (const double rate : {0.8, 1.3}) {
    const auto make = [&] { return std::make_unique<Tempo>(rate); };
    const Restyled out = play_clip(clip, *Rig::create(clip), make, false, {});
    EXPECT_NE(out.clip.frames, clip.frames);
    int in_the_air = 0;
    for (const double frame : out.source_frames) {
      const double seconds = frame * clip.frame_time;
      if (seconds < jump.take_off() + 0.2 || seconds > jump.landing() + 0.05) continue;
      EXPECT_NEAR(frame, std::round(frame), 0.05) << "at " << seconds << " s, rate " << rate;
      ++in_the_air;
    }
    EXPECT_GT(in_the_air, 10);
  }
}

// Asks for nothing, and remembers when.
class Witness final : public ChangeSource {
 public:
  explicit Witness(std::vector<StepTime>& times) : times_(times) {}
  AskedChange ask(const SourceInput& seen) override {
    times_.push_back(seen.time);
    AskedChange nothing;
    nothing.amount = 0;
    return nothing;
  }

 private:
  std::vector<StepTime>& times_;
};

TEST(PlayClip, a_source_is_told_the_time_of_the_clip_and_where_motion_begins) {
  const Clip clip = test::Jump().clip(60);
  std::vector<StepTime> times;
  const auto make = [&] { return std::make_unique<Witness>(times); };
  EXPECT_TRUE(is_unchanged(clip, play_clip(clip, *Rig::create(clip), make, false, {})));
  ASSERT_EQ(times.size(), static_cast<size_t>(clip.frames));
  for (size_t f = 0; f < times.size(); ++f) {
    EXPECT_EQ(times[f].first, f == 0);
    EXPECT_EQ(times[f].clip, static_cast<double>(f) * clip.frame_time);
  }
}

// A round whose rate swings about `rate`, with a flight from phase 10 to 16.
std::vector<PaceSample> round_at(double rate, double swing, int length) {
  std::vector<PaceSample> round;
  for (double phase = 0; phase < length; phase += 0.9) {
    const bool flies = phase >= 10 && phase <= 16;
    const double now = flies ? 1 : rate + swing * std::sin(6.2831853 * phase / length);
    round.push_back({phase, now, flies ? 1.0f : 0.0f});
  }
  return round;
}

TEST(LoopSchedule, a_round_takes_whole_frames_from_end_to_end) {
  for (const double rate : {0.55, 0.8, 0.97, 1.03, 1.3, 1.9}) {
    const std::vector<double> phases = loop_schedule(round_at(rate, 0.1, 32), 32, 0);
    EXPECT_EQ(phases.front(), 0);
    EXPECT_EQ(phases.back(), 32);
    EXPECT_NEAR(static_cast<double>(phases.size() - 1), 7 + 25 / rate, 4) << rate;
    for (size_t i = 1; i < phases.size(); ++i) {
      const double step = phases[i] - phases[i - 1];
      EXPECT_GT(step, 0.4);
      // A flight keeps its time.
      const bool flies = phases[i - 1] > 10.5 && phases[i] < 15.5;
      EXPECT_NEAR(flies ? step : 1, 1, 1e-9) << rate;
      EXPECT_NEAR(flies ? phases[i] : 0, flies ? std::round(phases[i]) : 0, 1e-9) << rate;
    }
  }
}

TEST(LoopSchedule, a_round_without_a_tempo_has_the_frames_of_the_input) {
  const std::vector<double> phases = loop_schedule({{0, 1, 0}, {20, 1, 1}}, 32, 0);
  ASSERT_EQ(phases.size(), 33u);
  for (int i = 0; i < 33; ++i) EXPECT_EQ(phases[static_cast<size_t>(i)], i);
}

TEST(LoopSchedule, the_number_of_frames_stays_where_either_would_do) {
  const auto frames = [](double wanted, int before) {
    return loop_schedule({{0, 32 / wanted, 0}}, 32, before).size() - 1;
  };
  EXPECT_EQ(frames(40.4, 0), 40u);
  EXPECT_EQ(frames(40.55, 40), 40u);
  EXPECT_EQ(frames(40.45, 41), 41u);
  EXPECT_EQ(frames(45, 39), 45u);
}

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
