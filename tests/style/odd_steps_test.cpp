// Clocks, poses, strengths and shapes as broken programs give them: a character goes on afterwards
// as if nothing had been.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "style/live_stylizer.h"
#include "style/stylizer.h"
#include "style_checks.h"

namespace panache {
namespace {

constexpr double kStepSeconds = 1.0 / 60, kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

class OddSteps : public testing::Test {
 protected:
  OddSteps() {
    // A slow one, which lags.
    strengths_[static_cast<size_t>(*model_->find_style("moping"))] = 1;
  }

  static std::vector<LiveOptions> option_sets() {
    LiveOptions late;
    late.max_lag = 1.2, late.max_lead = 0.2, late.skip_cycles = true;
    return {LiveOptions{}, late};
  }
  LiveStylizer character(const LiveOptions& options) const {
    return *LiveStylizer::create(model_, *Rig::create(walk_), options);
  }

  // The walk restyled, its frame kOdd after `seconds`, with what `spoil` makes of that frame.
  template <class Spoil>
  Clip play(LiveStylizer& character, double seconds, Spoil&& spoil) const {
    Clip out = walk_, in = walk_;
    for (int f = 0; f < kFrames; ++f) {
      std::vector<float> strengths = strengths_;
      if (f == kOdd) spoil(in.pose(f), strengths, character);
      if (f == kOdd + 1) character.stylizer().set_shape({});
      character.step(in.pose(f), strengths, f == kOdd ? seconds : kStepSeconds, out.pose(f));
      bool is_whole = std::isfinite(character.ahead()) &&
                      std::isfinite(character.stylizer().rate()) &&
                      std::isfinite(character.stylizer().gate());
      for (const Quat q : out.pose(f).rotations) is_whole &= std::abs(dot(q, q) - 1) <= 0.01f;
      for (const Vec3 t : out.pose(f).translations) is_whole &= is_finite(t);
      EXPECT_TRUE(is_whole) << "frame " << f;
    }
    return out;
  }
  Clip play(LiveStylizer& character, double seconds) const {
    return play(character, seconds, [](Pose, auto&, LiveStylizer&) {});
  }
  // How far apart the joints below the root are at most from a frame on, degrees.
  static float apart(const Clip& a, const Clip& b, int from) {
    float max = 0;
    for (int f = from; f < kFrames; ++f) {
      for (size_t j = 1; j < a.joints(); ++j) {
        max = std::max(
            max, length(log_rotation(conjugate(a.pose(f).rotations[j]) * b.pose(f).rotations[j])));
      }
    }
    return max * 180 / std::numbers::pi_v<float>;
  }

  static constexpr int kOdd = 120, kFrames = kOdd + 320;
  Clip walk_ = walker_walk(kFrames);
  std::shared_ptr<const Model> model_ = shipped_model();
  std::vector<float> strengths_ = std::vector<float>(model_->styles().size());
};

TEST_F(OddSteps, a_pause_without_end_is_forgotten_like_any_pause) {
  for (const LiveOptions& options : option_sets()) {
    LiveStylizer after_an_hour = character(options), after_a_second = character(options);
    const Clip hour = play(after_an_hour, 3600), second = play(after_a_second, 1);
    // The same but for the filter's mean of the gate, which takes three seconds to forget: a foot
    // may be planted a frame sooner.
    EXPECT_LT(apart(hour, second, kOdd), 5);
    for (const double seconds : {1e5, 1e9, 1e18, 1e30, 1e308, kInfinity}) {
      LiveStylizer odd = character(options);
      const Clip out = play(odd, seconds);
      EXPECT_TRUE(out.rotations == hour.rotations)
          << seconds << ": " << apart(out, hour, kOdd + 200) << " degrees off after 3.3 s";
      EXPECT_EQ(odd.ahead(), after_an_hour.ahead()) << seconds;
    }
  }
}

TEST_F(OddSteps, a_clock_that_stands_still_or_goes_back_stands_still) {
  for (const LiveOptions& options : option_sets()) {
    LiveStylizer still = character(options);
    const Clip expected = play(still, 0);
    for (const double seconds : {-0.0, -1.0, -1e30, -kInfinity, kNan, 5e-324, 1e-310, 1e-40}) {
      LiveStylizer odd = character(options);
      const Clip out = play(odd, seconds);
      EXPECT_TRUE(out.rotations == expected.rotations)
          << seconds << ": " << apart(out, expected, kOdd) << " degrees off";
      EXPECT_EQ(odd.ahead(), still.ahead()) << seconds;
    }
  }
}

TEST_F(OddSteps, a_crowd_takes_the_same_seconds_as_one_alone) {
  for (const double seconds : {1e18, kInfinity, -kInfinity, kNan, 5e-324}) {
    LiveStylizer alone = character({}), member = character({});
    const Clip expected = play(alone, seconds);
    Clip out = walk_;
    for (int f = 0; f < kFrames; ++f) {
      const CrowdMember crowd[] = {
          {&member.stylizer(), std::as_const(walk_).pose(f), strengths_, out.pose(f)}};
      step_crowd(crowd, f == kOdd ? seconds : kStepSeconds);
    }
    EXPECT_TRUE(out.rotations == expected.rotations) << seconds;
  }
}

TEST_F(OddSteps, numbers_of_any_size_in_a_pose_a_strength_or_the_shape_pass_by) {
  const LiveOptions late = option_sets()[1];
  LiveStylizer even = character({});
  const Clip expected = play(even, kStepSeconds);
  // A body that jumps far away and back starts afresh, as after a pause.
  LiveStylizer paused = character({});
  const Clip afresh = play(paused, 1);
  for (const double size : {1e4, 9e8, 1e18, 3e38, kInfinity, kNan, 1e-40}) {
    const auto number = static_cast<float>(size);
    const auto position = [&](size_t joint) {
      return [=](Pose pose, auto&, LiveStylizer&) {
        pose.translations[joint] = {number, -number, number};
      };
    };
    const auto turn = [&](size_t joint) {
      return [=](Pose pose, auto&, LiveStylizer&) { pose.rotations[joint] = {0, number, 0, 1}; };
    };
    const auto wish = [&](Pose, std::vector<float>& strengths, LiveStylizer& character) {
      for (float& strength : strengths) strength = number;
      Shape shape{number, number, number, number, {}, number};
      shape.regions.fill(-number);
      character.stylizer().set_shape(shape);
    };
    const auto check = [&](auto&& spoil) {
      LiveStylizer odd = character({}), odd_and_late = character(late);
      // One frame of rest pose alone leaves 1.1 degrees, by filters of seconds, and 3 where a foot
      // is planted a frame sooner.
      const Clip out = play(odd, kStepSeconds, spoil);
      const int later = kOdd + 200;
      EXPECT_LT(std::min(apart(out, expected, later), apart(out, afresh, later)), 3.5f) << number;
      play(odd_and_late, kStepSeconds, spoil);  // Where it is in its cycle is up to its lag.
    };
    for (const size_t joint : {size_t{0}, size_t{3}, size_t{14}, walk_.joints() - 1}) {
      check(position(joint));
      check(turn(joint));
    }
    check(wish);
  }
}

// A walk on a train: at a limit below its speed the style starts afresh at each frame.
TEST_F(OddSteps, a_body_on_a_vehicle_keeps_its_style_where_the_limit_allows_its_speed) {
  const auto ride = [&](float speed, float max_speed, LiveOptions options) {
    options.stylizer.max_speed = max_speed;
    LiveStylizer one = character(options);
    Clip out = walk_;
    for (int f = 0; f < kFrames; ++f) {
      const Pose pose = out.pose(f);
      pose.translations[0].x += speed * static_cast<float>(f * kStepSeconds);
      one.step(pose, strengths_, kStepSeconds, pose);
    }
    return out;
  };
  const auto infinity = static_cast<float>(kInfinity);
  for (const LiveOptions& options : option_sets()) {
    for (const float speed : {0.0f, 10.0f, 40.0f, 80.0f}) {
      const Clip free = ride(speed, infinity, options);
      EXPECT_TRUE(free.rotations == ride(speed, 100, options).rotations) << speed;
      EXPECT_EQ(free.rotations == ride(speed, 15, options).rotations, speed < 15) << speed;
    }
  }
  LiveOptions none;
  for (const double limit : {0.0, -1.0, kNan}) {
    none.stylizer.max_speed = static_cast<float>(limit);
    EXPECT_FALSE(LiveStylizer::create(model_, *Rig::create(walk_), none)) << limit;
  }
}

}  // namespace
}  // namespace panache
