#include "style/live_stylizer.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "allocations.h"
#include "make_clip.h"
#include "make_model.h"
#include "rig/canonical_body.h"
#include "style_checks.h"
#include "walker/walker.h"

namespace panache {
namespace {

constexpr double kStep = 1.0 / 60;

// A model that asks for this tempo and changes nothing else by much.
std::shared_ptr<const Model> model_at_rate(double rate, bool predicts = true) {
  TensorFile file = test::make_model({"old", "proud"}, 3);
  file.tensors["output.scale"] = test::constant_tensor(StyleDelta::kSize, 1e-3f);
  test::set_rate(file, rate);
  if (predicts) test::add_predictor(file);
  return read(file);
}

// A walk of the walker, endless.
class LiveWalk {
 public:
  LiveWalk() {
    clip_.skeleton = canonical_skeleton();
    clip_.frame_time = kStep;
    clip_.resize(1);
  }
  ConstPose step(double seconds, float speed = 1.4f, float turn = 0) {
    walker_.step(speed, turn, seconds, clip_.pose(0));
    return std::as_const(clip_).pose(0);
  }

 private:
  Walker walker_{*WalkerModel::load(PANACHE_SOURCE_DIR "/models/walker.safetensors")};
  Clip clip_;
};

class LiveStylizerTest : public testing::Test {
 protected:
  // The play head is the matter here, whether or not feet step.
  LiveStylizer live(std::shared_ptr<const Model> model, LiveOptions options) const {
    options.stylizer.tempo_everywhere = true;
    Result<LiveStylizer> made = LiveStylizer::create(model, *Rig::create(clip_), options);
    EXPECT_TRUE(made.ok()) << (made ? "" : made.error().message);
    return *std::move(made);
  }
  Clip clip_ = test::walking_clip(600, 60);
  Clip out_ = test::walking_clip(600, 60);
};

TEST_F(LiveStylizerTest, by_default_it_is_the_stylizer_bit_for_bit) {
  const auto model = model_at_rate(0.8);
  LiveStylizer timed = live(model, {});
  Stylizer plain = *Stylizer::create(model, *Rig::create(clip_));
  EXPECT_TRUE(timed.is_pass_through());
  EXPECT_TRUE(test::same_bits(played(timed, clip_, {1, 0}), played(plain, clip_, {1, 0})));
}

// An arm that jerks in one frame: at which step does the output show it?
TEST_F(LiveStylizerTest, by_default_an_impulse_is_there_at_once) {
  const size_t arm = static_cast<size_t>(index(HumanJoint::left_lower_arm));
  const auto steps_until_seen = [&](const LiveOptions& options) {
    Clip still = clip_;
    for (int f = 0; f < still.frames; ++f) {
      std::copy_n(clip_.pose(0).rotations.begin(), still.joints(), still.pose(f).rotations.begin());
      std::copy_n(clip_.pose(0).translations.begin(), still.joints(),
                  still.pose(f).translations.begin());
    }
    constexpr int kImpulse = 300;
    still.pose(kImpulse).rotations[arm] =
        still.pose(0).rotations[arm] * axis_angle(Vec3{0, 1, 0}, 1.0f);
    LiveStylizer character = live(model_at_rate(0.8), options);
    std::optional<int> seen;
    for (int f = 0; f < 500; ++f) {
      character.step(still.pose(f), std::vector<float>{1, 0}, kStep, out_.pose(f));
      const Quat before = out_.pose(std::max(f - 1, 0)).rotations[arm];
      const bool jerks = std::abs(dot(out_.pose(f).rotations[arm], before)) < 0.97f;
      if (f > 0 && jerks && !seen) seen = f - kImpulse;
    }
    return seen;
  };
  EXPECT_EQ(steps_until_seen({}), 0);
  // A slower style that may be late is, by as much as it may.
  LiveOptions late;
  late.max_lag = 0.5;
  const auto seen = steps_until_seen(late);
  ASSERT_TRUE(seen);
  EXPECT_NEAR(*seen * kStep, 0.5, 0.05);
}

TEST_F(LiveStylizerTest, without_a_style_it_comes_back_and_is_the_input_bit_for_bit) {
  LiveOptions options;
  options.max_lag = 0.3;
  options.max_lead = 0.2;
  for (const double rate : {0.8, 1.25}) {
    LiveStylizer character = live(model_at_rate(rate), options);
    for (int f = 0; f < 200; ++f) {
      character.step(clip_.pose(f), std::vector<float>{1, 0}, kStep, out_.pose(f));
    }
    for (int f = 200; f < 600; ++f) {
      character.step(clip_.pose(f), std::vector<float>{0, 0}, kStep, out_.pose(f));
    }
    EXPECT_EQ(character.ahead(), 0);
    // But for the hips, whose turn off the course is still fading.
    for (size_t j = 1; j < clip_.joints(); ++j) {
      EXPECT_EQ(out_.pose(599).rotations[j], clip_.pose(599).rotations[j]) << "joint " << j;
    }
  }
}

// A head that is ahead shows guesses, but nothing may twitch. (A style changes nothing here, and
// constant velocity is all that the model's network knows.)
TEST_F(LiveStylizerTest, predicted_input_does_not_twitch) {
  const auto largest_turn = [&](const LiveOptions& options, double ahead) {
    LiveStylizer character = live(model_at_rate(1.25), options);
    LiveWalk walk;
    float largest = 0;
    for (int f = 0; f < 900; ++f) {
      character.step(walk.step(kStep), std::vector<float>{1, 0}, kStep, out_.pose(f % 2));
      for (size_t j = 0; f > 300 && j < clip_.joints(); ++j) {
        const float d = std::abs(dot(out_.pose(0).rotations[j], out_.pose(1).rotations[j]));
        largest = std::max(largest, 2 * std::acos(std::min(d, 1.0f)));
      }
    }
    EXPECT_NEAR(character.ahead(), ahead, 0.01);
    return largest;
  };
  LiveOptions early;
  early.max_lead = 0.1;
  // Constant velocity overshoots wherever a joint turns back.
  EXPECT_LT(largest_turn(early, 0.1), 2 * largest_turn({}, 0));
}

TEST_F(LiveStylizerTest, who_runs_ahead_shows_arms_where_they_will_be) {
  LiveOptions early;
  early.max_lead = 0.1;
  LiveStylizer character = live(model_at_rate(1.25), early);
  constexpr float kSpeed = 1;  // Radians a second, upwards.
  Clip in = clip_;
  for (int f = 0; f < 120; ++f) {
    std::copy_n(clip_.pose(0).rotations.begin(), clip_.joints(), in.pose(f).rotations.begin());
    std::copy_n(clip_.pose(0).translations.begin(), clip_.joints(),
                in.pose(f).translations.begin());
    const float angle = kSpeed * static_cast<float>(f * kStep) - 1;
    for (const auto& [arm, side] : {std::pair(HumanJoint::left_upper_arm, 1.0f),
                                    std::pair(HumanJoint::right_upper_arm, -1.0f)}) {
      in.pose(f).rotations[static_cast<size_t>(index(arm))] =
          axis_angle(Vec3{0, 0, 1}, side * angle);
    }
    character.step(in.pose(f), std::vector<float>{1, 0}, kStep, out_.pose(f));
    if (f < 90) continue;
    for (const HumanJoint arm : {HumanJoint::left_upper_arm, HumanJoint::right_upper_arm}) {
      const auto j = static_cast<size_t>(index(arm));
      const Quat before = in.pose(f).rotations[j], now = out_.pose(f).rotations[j];
      const float side = arm == HumanJoint::left_upper_arm ? 1.0f : -1.0f;
      EXPECT_NEAR(log_rotation(now * conjugate(before)).z, side * 0.1f * kSpeed, 0.01f) << f;
    }
  }
}

TEST_F(LiveStylizerTest, by_whole_cycles_a_slower_or_faster_style_is_held_for_ever) {
  for (const double rate : {0.9, 1.1}) {
    LiveOptions options;
    options.max_lag = 1.5;
    options.max_lead = 0.1;
    options.skip_cycles = true;
    LiveWalk walk;
    LiveStylizer character = live(model_at_rate(rate), options);
    double played = 0, ahead = 0;
    float fastest = 0, fastest_input = 0;
    Clip last_input = out_;
    constexpr int kSteps = 5 * 60 * 60;  // Five minutes.
    int blends = 0, before = 0;
    for (int f = 0; f < kSteps; ++f) {
      const ConstPose in = walk.step(kStep);
      character.step(in, std::vector<float>{1, 0}, kStep, out_.pose(f % 2));
      ASSERT_GE(character.ahead(), -1.5);
      ASSERT_LE(character.ahead(), 0.1);
      if (f < 120) continue;
      // What was played is what time went, and what the head went against it but for jumps.
      const double moved = character.ahead() - ahead;
      ahead = character.ahead();
      if (std::abs(moved) < 0.2) played += kStep + moved;
      blends += character.skipped_cycles() != before;
      before = character.skipped_cycles();
      for (size_t j = 0; j < in.rotations.size(); ++j) {
        const auto turn = [](Quat a, Quat b) {
          return 2 * std::acos(std::min(std::abs(dot(a, b)), 1.0f));
        };
        fastest = std::max(fastest, turn(out_.pose(0).rotations[j], out_.pose(1).rotations[j]));
        fastest_input =
            std::max(fastest_input, turn(in.rotations[j], last_input.pose(0).rotations[j]));
      }
      std::copy(in.rotations.begin(), in.rotations.end(), last_input.pose(0).rotations.begin());
    }
    // The tempo is the style's, over all.
    EXPECT_NEAR(played / ((kSteps - 120) * kStep), rate, 0.01);
    // 30 s of 300 are left out or played again, in cycles of about 1.1 s.
    EXPECT_NEAR(character.skipped_cycles(), rate < 1 ? 27 : -27, 6);
    EXPECT_EQ(blends, std::abs(character.skipped_cycles()));
    // No joint jumps where a cycle is left out: cycles of one walk differ by little, and 0.2 s is
    // long.
    EXPECT_LT(fastest, 1.3f * fastest_input);
  }
}

// Cycles of a walk whose speed changes are not the same: what is left between them is blended over
// 0.2 s, not jumped.
TEST_F(LiveStylizerTest, where_a_cycle_is_left_out_no_joint_jumps_and_the_way_goes_on) {
  LiveOptions options;
  options.max_lag = 1.5;
  options.skip_cycles = true;
  LiveWalk walk;
  LiveStylizer character = live(model_at_rate(0.85), options);
  // How much the joints' turns change from one step to the next, in the mean.
  double at_skips = 0, elsewhere = 0;
  float longest_step = 0;
  std::vector<float> before(clip_.joints());
  int skipped = 0;
  for (int f = 0; f < 90 * 60; ++f) {
    const float speed = 1.4f + 0.3f * std::sin(0.012f * static_cast<float>(f));
    character.step(walk.step(kStep, speed), std::vector<float>{1, 0}, kStep, out_.pose(f % 2));
    const bool skips = skipped != character.skipped_cycles();
    skipped = character.skipped_cycles();
    for (size_t j = 0; j < clip_.joints(); ++j) {
      const float d = std::abs(dot(out_.pose(0).rotations[j], out_.pose(1).rotations[j]));
      const float turn = 2 * std::acos(std::min(d, 1.0f));
      if (f > 60) (skips ? at_skips : elsewhere) += static_cast<double>(std::abs(turn - before[j]));
      before[j] = turn;
    }
    const Vec3 step = out_.pose(0).translations[0] - out_.pose(1).translations[0];
    if (f > 60) longest_step = std::max(longest_step, std::hypot(step.x, step.z));
  }
  ASSERT_GT(skipped, 6);
  EXPECT_LT(at_skips / skipped, 2 * elsewhere / (90 * 60));
  // A stride is 1.4 m; a step at 1.7 m/s, swaying, is below 4 cm.
  EXPECT_LT(longest_step, 0.04f);
}

TEST_F(LiveStylizerTest, after_a_jump_nothing_of_the_old_place_is_shown) {
  LiveOptions options;
  options.max_lag = 1;
  LiveStylizer character = live(model_at_rate(0.8), options);
  for (int f = 0; f < 400; ++f) {
    Clip moved = clip_;
    if (f >= 300) moved.pose(f).translations[0].x += 100;
    character.step(moved.pose(f), std::vector<float>{1, 0}, kStep, out_.pose(f));
    if (f >= 300) {
      ASSERT_GT(out_.pose(f).translations[0].x, 90) << f;
    }
  }
}

TEST_F(LiveStylizerTest, a_step_allocates_nothing) {
  LiveOptions options;
  options.max_lag = 1.5;
  options.max_lead = 0.25;
  options.skip_cycles = true;
  for (const double rate : {0.8, 1.25}) {
    LiveStylizer character = live(model_at_rate(rate), options);
    LiveWalk walk;
    const std::vector<float> strengths = {1, 0};
    long allocated = 0;
    for (int f = 0; f < 1200; ++f) {
      const ConstPose in = walk.step(kStep);
      const long before = test::allocations;
      character.step(in, strengths, kStep, out_.pose(0));
      allocated += test::allocations - before;
    }
    EXPECT_EQ(allocated, 0);
    EXPECT_NE(character.skipped_cycles(), 0);
  }
}

TEST_F(LiveStylizerTest, a_damaged_state_is_rejected) {
  LiveOptions options;
  options.max_lag = 1.5;
  options.skip_cycles = true;
  LiveStylizer character = live(model_at_rate(0.85), options);
  LiveWalk walk;
  for (int f = 0; f < 700; ++f) {
    character.step(walk.step(kStep), std::vector<float>{1, 0}, kStep, out_.pose(0));
  }
  std::vector<std::byte> state(character.state_size());
  character.save(state);
  for (const size_t byte : {size_t{3}, state.size() / 2, state.size() - 1}) {
    std::vector<std::byte> damaged = state;
    damaged[byte] ^= std::byte{1};
    EXPECT_FALSE(character.restore(damaged));
  }
  EXPECT_FALSE(character.restore(std::span(state).first(state.size() - 1)));
}

TEST_F(LiveStylizerTest, an_option_that_cannot_be_is_rejected_with_a_message) {
  const auto error = [&](LiveOptions options, bool predicts = true) {
    const auto made =
        LiveStylizer::create(model_at_rate(1, predicts), *Rig::create(clip_), options);
    return made ? std::string() : made.error().message;
  };
  LiveOptions late, early;
  late.max_lag = 5;
  EXPECT_EQ(error(late), "max_lag of 5.000000 seconds; expected 0 to 4 seconds");
  late.max_lag = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(error(late), "max_lag of nan seconds; expected 0 to 4 seconds");
  early.max_lead = 0.3;
  EXPECT_EQ(error(early), "max_lead of 0.300000 seconds; expected 0 to 0.25 seconds");
  early.max_lead = 0.1;
  EXPECT_EQ(error(early), "");
  EXPECT_EQ(error(early, false),
            "max_lead needs a model that predicts input, which this one does not; train it again "
            "or set max_lead to 0");
}

// An hour of walking, 5 km, at 30 frames a second: what the style does in the last minute is what
// it did in the second.
TEST(LongStream, of_an_hour_leaves_the_style_as_it_was) {
  const auto model = shipped_model();
  const Clip one = walk_clip(*WalkerModel::load(PANACHE_SOURCE_DIR "/models/walker.safetensors"),
                             {.seconds = 1});
  LiveWalk walk;
  LiveOptions options;
  options.max_lag = 1.5;
  options.max_lead = 0.1;
  options.skip_cycles = true;
  LiveStylizer character = *LiveStylizer::create(model, *Rig::create(one), options);
  std::vector<float> strengths(model->styles().size());
  strengths[static_cast<size_t>(*model->find_style("old"))] = 1;
  Clip out = one;
  constexpr int kMinute = 60 * 30;
  // Mean turn of each joint by the style, and its height of the hips, in a minute.
  struct Minute {
    std::array<double, kHumanJoints> turn{};
    double height = 0, rate = 0;
  } second, last;
  for (int f = 0; f < 60 * kMinute; ++f) {
    character.step(walk.step(1.0 / 30), strengths, 1.0 / 30, out.pose(0));
    Minute* minute = f / kMinute == 1 ? &second : f / kMinute == 59 ? &last : nullptr;
    if (!minute) continue;
    const Stylizer& stylizer = character.stylizer();
    for (size_t j = 0; j < kHumanJoints; ++j) {
      const Quat turned = stylizer.change().rotations[j];
      minute->turn[j] += 2 * std::asin(static_cast<double>(length(turned.xyz()))) / kMinute;
    }
    minute->height += static_cast<double>(stylizer.change().translation.y) / kMinute;
    minute->rate += stylizer.rate() / kMinute;
    ASSERT_GE(character.ahead(), -1.5);
    ASSERT_LE(character.ahead(), 0.1);
  }
  // At 5 km a float is 0.5 mm fine: half a degree, half a centimetre and a percent are far above
  // what that does, and far below what a style does.
  for (size_t j = 0; j < kHumanJoints; ++j) EXPECT_NEAR(last.turn[j], second.turn[j], 0.009) << j;
  EXPECT_NEAR(last.height, second.height, 0.005);
  EXPECT_NEAR(last.rate, second.rate, 0.01);
}

TEST_F(LiveStylizerTest, without_a_style_no_cycle_is_left_out_or_played_again) {
  LiveOptions options;
  options.max_lag = 1.5;
  options.skip_cycles = true;
  LiveStylizer character = live(model_at_rate(1.2), options);
  LiveWalk walk;
  for (int f = 0; f < 60 * 60; ++f) {
    const ConstPose in = walk.step(kStep);
    character.step(in, std::vector<float>{0, 0}, kStep, out_.pose(0));
    for (size_t j = 0; j < in.rotations.size(); ++j) {
      ASSERT_EQ(out_.pose(0).rotations[j], in.rotations[j]) << "frame " << f;
      ASSERT_EQ(out_.pose(0).translations[j], in.translations[j]) << "frame " << f;
    }
  }
  EXPECT_EQ(character.skipped_cycles(), 0);
}

}  // namespace
}  // namespace panache
