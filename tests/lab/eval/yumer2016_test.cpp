#include "eval/systems/yumer2016/yumer2016.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "eval/make_swings.h"
#include "make_styles.h"
#include "style/stages/shaping.h"

namespace panache {
namespace {

using namespace yumer2016;

constexpr float kTurn = 2 * std::numbers::pi_v<float>;
constexpr int kSignal = 3 * index(HumanJoint::left_upper_arm);

// A body at rest of which one angle swings.
std::vector<Signals> swing(int frames, float amplitude, float rate, float phase, float mean = 0) {
  std::vector<Signals> motion(frames, Signals{});
  for (int f = 0; f < frames; ++f) {
    motion[f][kSignal] =
        mean + amplitude * std::sin(kTurn * rate * static_cast<float>(f) / 30 + phase);
  }
  return motion;
}

std::vector<Signals> restyled(const std::vector<Signals>& motion,
                              const std::vector<Style>& styles) {
  const int frames = static_cast<int>(motion.size());
  std::vector<Spectrum> windows;
  for (int w = 0; w < window_count(frames); ++w) {
    windows.push_back(transfer(spectrum_of(motion, first_window() + w * kHop), styles));
  }
  return overlap_add(windows, frames);
}

// Amplitude and phase of what swings at `rate`, over whole periods in the middle.
std::complex<float> swing_of(const std::vector<Signals>& motion, float rate) {
  std::complex<float> sum = 0;
  for (int f = 60; f < 120; ++f) {
    sum += motion[f][kSignal] * std::polar(1.0f, -kTurn * rate * static_cast<float>(f) / 30);
  }
  return sum * std::complex<float>(0, 1.0f / 30);  // Of a sine.
}

TEST(Spectra, windows_put_together_again_are_the_motion) {
  std::vector<Signals> motion = swing(100, 0.4f, 0.9f, 0.3f, 0.7f);
  for (int f = 0; f < 100; ++f) motion[f][kHipsHeight] = 0.9f + 0.001f * static_cast<float>(f);
  const std::vector<Signals> same = restyled(motion, {});
  ASSERT_EQ(same.size(), motion.size());
  for (size_t f = 0; f < motion.size(); ++f) {
    for (int s = 0; s < kSignals; ++s) ASSERT_NEAR(same[f][s], motion[f][s], 1e-5) << f << " " << s;
  }
}

TEST(Spectra, a_known_change_of_amplitude_is_transferred_and_phases_stay) {
  // Twice the amplitude in the style, of an action of another size and phase.
  const Reference neutral = reference_of({swing(200, 0.2f, 1, 0)});
  const Reference styled = reference_of({swing(200, 0.4f, 1, 1.5f)});
  const std::vector<Signals> input = swing(180, 0.3f, 1, 0.8f);
  const std::complex<float> before = swing_of(input, 1);
  const std::complex<float> whole = swing_of(restyled(input, {{&neutral, &styled, 1}}), 1);
  const std::complex<float> half = swing_of(restyled(input, {{&neutral, &styled, 0.5f}}), 1);
  EXPECT_NEAR(std::abs(before), 0.3, 1e-3);
  // Joints that hardly move count less: 2 cm/s of 20 are a hundredth.
  EXPECT_NEAR(std::abs(whole), 0.6, 0.01);
  EXPECT_NEAR(std::abs(half), 0.45, 0.01);
  EXPECT_NEAR(std::arg(whole / before), 0, 0.01);
}

TEST(Spectra, less_than_nothing_is_nothing) {
  const Reference neutral = reference_of({swing(200, 0.4f, 1, 0)});
  const Reference styled = reference_of({swing(200, 0.1f, 1, 0)});
  const std::vector<Signals> input = swing(180, 0.3f, 1, 0);
  const std::complex<float> before = swing_of(input, 1);
  const std::complex<float> out = swing_of(restyled(input, {{&neutral, &styled, 2}}), 1);
  EXPECT_LT(std::abs(out), 0.01);  // Not the swing the other way.
  EXPECT_GT(std::abs(before), 0.29);
}

TEST(Spectra, the_lasting_posture_is_transferred_as_it_is) {
  const Reference neutral = reference_of({swing(200, 0.2f, 1, 0, 0.1f)});
  const Reference styled = reference_of({swing(200, 0.2f, 1, 0, -0.2f)});
  const std::vector<Signals> input = swing(120, 0, 1, 0, 0.5f);
  EXPECT_NEAR(restyled(input, {{&neutral, &styled, 1}})[60][kSignal], 0.2, 0.002);
}

TEST(JointSignals, a_change_between_signals_is_the_change_between_bodies) {
  const Take take = test::swinging_take("neutral", 60, 0.5f);
  const std::vector<Signals> signals = joint_signals(take);
  for (int f = 0; f + 10 < 60; ++f) {
    const HumanPositions moved = change_body(take.body[f], change_of(signals[f], signals[f + 10]));
    for (int j = 0; j < kHumanJoints; ++j) {
      EXPECT_LT(length(moved[j] - take.body[f + 10][j]), 1e-3) << f << " " << j;
    }
  }
}

class Yumer : public testing::Test {
 protected:
  Yumer() {
    takes_ = {test::swinging_take("neutral", 150, 0.2f), test::swinging_take("old", 150, 0.4f)};
    pairings_ = pair_takes(takes_, {1}, {0});
    system_ = *Yumer2016::create("yumer2016", {takes_, pairings_, {{"old", {"old"}, ""}}});
  }
  std::vector<Take> takes_;
  std::vector<Pairing> pairings_;
  std::unique_ptr<Yumer2016> system_;
};

TEST_F(Yumer, a_style_of_one_action_is_seen_in_another) {
  // Standing, with the arm swung in the way of the references, and a clip of it.
  TestInput input = test::swinging_input(150, 0.3f);
  const Take output = system_->run(input, {"old", {{"old", 1.0f}}})->output.take;
  ASSERT_EQ(output.frames(), 150);  // The tempo stays.
  const auto reach = [](const Take& take) {
    float low = 1, high = -1;
    for (int f = 40; f < 110; ++f) {
      const float z = take.body[f][index(HumanJoint::left_hand)].z;
      low = std::min(low, z), high = std::max(high, z);
    }
    return high - low;
  };
  EXPECT_NEAR(reach(output) / reach(input.take), 2, 0.15);
}

TEST_F(Yumer, at_strength_0_a_clip_comes_out_as_it_went_in) {
  const TestInput input = test::swinging_input(60, 0.3f);
  const Take output = system_->run(input, {"old", {{"old", 0.0f}}})->output.take;
  for (int f = 0; f < output.frames(); ++f) ASSERT_EQ(output.body[f], input.take.body[f]) << f;
}

}  // namespace
}  // namespace panache
