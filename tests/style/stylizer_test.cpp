#include "style/stylizer.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include <gtest/gtest.h>

#include "count_allocations.h"
#include "make_clip.h"
#include "make_model.h"

namespace panache {
namespace {

using test::same_bits;

std::shared_ptr<const Model> random_model(const Recipe& recipe = test::kPanache) {
  const TensorFile file = test::make_model({"old", "proud"}, 3, recipe);
  return *Model::parse(format_safetensors(file), "test model");
}

std::shared_ptr<const Model> gated_model(float limit) {
  TensorFile file = test::make_model({"old", "proud"}, 3);
  test::add_gate(file, limit);
  return *Model::parse(format_safetensors(file), "test model");
}

class StylizerTest : public testing::Test {
 protected:
  explicit StylizerTest(double fps = 30) : clip_(test::walking_clip(int(fps * 4), fps)) {}

  Stylizer stylizer(const StylizerOptions& options = {},
                    const Recipe& recipe = test::kPanache) const {
    return *Stylizer::create(random_model(recipe), *Rig::create(clip_), options);
  }
  // All frames restyled live.
  Clip run(Stylizer& stylizer, std::vector<float> strengths) const {
    Clip out = clip_;
    for (int f = 0; f < clip_.frames; ++f) {
      stylizer.step(clip_.pose(f), strengths, clip_.frame_time, out.pose(f));
    }
    return out;
  }

  Clip clip_;
};

void expect_finite(const Clip& clip) {
  for (const Quat q : clip.rotations) {
    ASSERT_TRUE(is_finite(q));
    ASSERT_NEAR(dot(q, q), 1, 1e-3);
  }
  for (const Vec3 t : clip.translations) ASSERT_TRUE(is_finite(t));
}

TEST_F(StylizerTest, strength_zero_gives_the_input_back_bit_for_bit) {
  Stylizer character = stylizer();
  EXPECT_TRUE(same_bits(run(character, {0, 0}), clip_));
  EXPECT_EQ(character.rate(), 1);
}

TEST_F(StylizerTest, a_body_that_a_style_puts_underground_is_lifted_without_a_start) {
  // A style that does nothing but take the hips 10 cm down.
  TensorFile file = test::make_model({"low", "other"}, 3);
  for (float& weight : file.tensors["pose.head.0.weight"].values) weight = 0;
  StyleDelta low;
  low.hips_height = -0.1f;
  pack(low, std::span(file.tensors["pose.head.0.bias"].values).first<StyleDelta::kSize>());
  file.tensors["output.scale"] = test::constant_tensor(StyleDelta::kSize, 1);
  StylizerOptions options;
  options.ease_seconds = options.smoothing_seconds = 0;
  Stylizer character =
      *Stylizer::create(*Model::parse(format_safetensors(file), "m"), *Rig::create(clip_), options);
  std::vector<float> sunk;
  Clip out = clip_;
  for (int f = 0; f < clip_.frames; ++f) {
    const std::vector<float> strengths = {f < 30 ? 0.0f : 1.0f, 0};
    character.step(clip_.pose(f), strengths, clip_.frame_time, out.pose(f));
    sunk.push_back(character.change().translation.y);
  }
  // At once down, then up again within some tenths of a second, a part at a time.
  EXPECT_EQ(sunk[29], 0);
  EXPECT_LT(sunk[30], -0.06f);
  for (int f = 31; f < 60; ++f) EXPECT_LT(std::abs(sunk[f] - sunk[f - 1]), 0.035f) << f;
  // Toes that the walk itself lifts may sink by as much.
  EXPECT_GT(*std::max_element(sunk.begin() + 60, sunk.end()), -0.02f);
  EXPECT_GT(*std::min_element(sunk.begin() + 60, sunk.end()), -0.085f);
}

TEST_F(StylizerTest, a_style_changes_the_pose_and_keeps_it_whole) {
  Stylizer character = stylizer();
  const Clip styled = run(character, {1, 0});
  EXPECT_FALSE(same_bits(styled, clip_));
  expect_finite(styled);
}

TEST_F(StylizerTest, a_clock_is_told_of_each_stage_once_a_step_and_in_order) {
  class SourceInput final : public StageClock {
   public:
    void done(Stage stage) noexcept override { stages.push_back(stage); }
    std::vector<Stage> stages;
  } clock;
  StylizerOptions still;
  still.root = still.foot_lock = false;
  for (const StylizerOptions& options : {StylizerOptions{}, still}) {
    Stylizer character = stylizer(options);
    Clip out = clip_;
    for (int f = 0; f < 3; ++f) {
      clock.stages.clear();
      character.step(clip_.pose(f), std::array{1.0f, 0.0f}, clip_.frame_time, out.pose(f), &clock);
      ASSERT_EQ(clock.stages.size(), kStageNames.size());
      for (size_t s = 0; s < kStageNames.size(); ++s) {
        EXPECT_EQ(kStageNames[static_cast<size_t>(clock.stages[s])], kStageNames[s]);
      }
    }
  }
}

TEST_F(StylizerTest, back_at_strength_zero_the_pose_is_the_input_again) {
  Stylizer character = stylizer();
  run(character, {1, 0});
  const Clip after = run(character, {0, 0});
  const size_t joints = clip_.joints(), last = (clip_.frames - 1) * joints;
  for (size_t j = 0; j < joints; ++j) {
    EXPECT_EQ(after.rotations[last + j], clip_.rotations[last + j]) << "joint " << j;
  }
}

TEST_F(StylizerTest, a_step_allocates_nothing) {
  for (const Recipe* recipe : {&test::kPanache, &test::kSmith2019}) {
    Stylizer character = stylizer({}, *recipe);
    Clip out = clip_;
    std::vector<float> strengths = {0.5f, 0.5f};
    const long before = test::allocations;
    for (int i = 0; i < 1000; ++i) {
      strengths[0] = static_cast<float>(i % 7) * 0.2f;
      const int f = i % clip_.frames;
      character.step(clip_.pose(f), strengths, 1 / 30.0, out.pose(f));
    }
    EXPECT_EQ(test::allocations - before, 0);
  }
}

TEST_F(StylizerTest, a_step_of_a_crowd_allocates_nothing) {
  std::vector<Stylizer> characters(17, stylizer());
  std::vector<Clip> outs(characters.size(), clip_);
  const std::vector<float> strengths = {0.5f, 0.5f};
  std::vector<CrowdMember> members;
  for (size_t i = 0; i < characters.size(); ++i) {
    members.push_back({&characters[i], clip_.pose(0), strengths, outs[i].pose(0)});
  }
  const long before = test::allocations;
  for (int i = 0; i < 20; ++i) step_crowd(members, 1 / 30.0);
  EXPECT_EQ(test::allocations - before, 0);
}

TEST_F(StylizerTest, a_step_through_a_gate_allocates_nothing_and_closes_it_gradually) {
  Stylizer character = *Stylizer::create(gated_model(1e-3f), *Rig::create(clip_));
  Clip out = clip_;
  const std::vector<float> strengths = {1, 0};
  const long before = test::allocations;
  for (int f = 0; f < clip_.frames; ++f) {
    character.step(clip_.pose(f), strengths, 1 / 30.0, out.pose(f));
  }
  EXPECT_EQ(test::allocations - before, 0);
  EXPECT_LT(character.gate(), 0.01f);
}

TEST_F(StylizerTest, behind_a_closed_gate_the_root_motion_is_the_inputs) {
  const auto drift = [&](std::shared_ptr<const Model> model) {
    Stylizer character = *Stylizer::create(model, *Rig::create(clip_));
    run(character, {1, 0});
    const Vec3 moved = character.change().translation;
    return std::hypot(moved.x, moved.z);
  };
  EXPECT_GT(drift(gated_model(1e6f)), 0.05f) << "an open gate leaves the style its way";
  EXPECT_LT(drift(gated_model(1e-3f)), 1e-3f);
}

// How far a style turns a body aside at most, radians.
float max_turned(const Clip& clip, float strength) {
  Stylizer character = *Stylizer::create(random_model(), *Rig::create(clip));
  Clip out = clip;
  float max = 0;
  for (int f = 0; f < clip.frames; ++f) {
    character.step(clip.pose(f), std::vector<float>{strength, 0}, clip.frame_time, out.pose(f));
    max = std::max(max, std::abs(character.change().turn));
  }
  return max;
}

TEST_F(StylizerTest, a_style_turns_who_walks_but_not_who_gets_nowhere) {
  const Clip walk = test::walking_clip(240);
  EXPECT_GT(max_turned(walk, 1), 0.05f);
  EXPECT_LT(max_turned(walk, 4), 0.45f);
  Clip to_and_fro = walk;
  for (int f = 0; f < walk.frames; ++f) {
    const float seconds = static_cast<float>(f * walk.frame_time);
    to_and_fro.pose(f).translations[0].z = 0.2f * std::sin(2 * 3.14159265f * seconds);
  }
  EXPECT_LT(max_turned(to_and_fro, 1), 0.25f * max_turned(walk, 1));
}

TEST_F(StylizerTest, the_gate_takes_its_time_but_not_at_the_start) {
  // How far the gate moves in a walk whose viewer's clock goes on by `seconds` a frame.
  const auto moved = [&](double seconds) {
    Stylizer character = *Stylizer::create(gated_model(1.5f), *Rig::create(clip_));
    Clip out = clip_;
    float first = 0, max = 0;
    for (int f = 0; f < clip_.frames; ++f) {
      character.step(clip_.pose(f), std::vector<float>{1, 0}, {1 / 30.0, seconds}, out.pose(f));
      if (f == 0) first = character.gate();
      max = std::max(max, std::abs(character.gate() - first));
    }
    EXPECT_LT(first, 1) << "the first step need not wait";
    return max;
  };
  EXPECT_GT(moved(1 / 30.0), 0.02f);
  // 120 frames of a millionth of the time constant.
  EXPECT_LT(moved(1.5e-7), 2e-4f);
}

TEST_F(StylizerTest, a_reset_character_remembers_no_gate) {
  for (const float limit : {1e-3f, 1.0f, 1.5f, 2.0f}) {
    const auto model = gated_model(limit);
    Stylizer first = *Stylizer::create(model, *Rig::create(clip_)), second = first;
    run(first, {1, 0.5f});
    first.reset();
    EXPECT_TRUE(same_bits(run(first, {1, 0.5f}), run(second, {1, 0.5f}))) << limit;
  }
}

TEST_F(StylizerTest, behind_a_closed_gate_strength_zero_is_still_the_input) {
  Stylizer character = *Stylizer::create(gated_model(1e-3f), *Rig::create(clip_));
  EXPECT_TRUE(same_bits(run(character, {0, 0}), clip_));
}

TEST_F(StylizerTest, the_same_input_gives_the_same_bits_and_a_reset_one_starts_anew) {
  Stylizer first = stylizer(), second = stylizer();
  EXPECT_TRUE(same_bits(run(first, {1, 0.5f}), run(second, {1, 0.5f})));
  Stylizer third = stylizer();
  first.reset();
  EXPECT_TRUE(same_bits(run(first, {1, 0.5f}), run(third, {1, 0.5f})));
}

TEST_F(StylizerTest, garbage_in_gives_finite_poses_out) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  constexpr float infinity = std::numeric_limits<float>::infinity();
  for (const Recipe* recipe : {&test::kPanache, &test::kSmith2019}) {
    Stylizer character = stylizer({}, *recipe);
    Clip in = clip_, out = clip_;
    Random random(11);
    for (int f = 0; f < in.frames; ++f) {
      const Pose pose = in.pose(f);
      const size_t j = random.below(static_cast<uint32_t>(in.joints()));
      switch (f % 8) {
        case 0:
          pose.rotations[j] = {nan, 0, 0, 1};
          break;
        case 1:
          pose.translations[0] = {infinity, 0, 0};
          break;
        case 2:
          pose.translations[0] = {0, 0, 1e8f};
          break;  // A teleport.
        case 3:
          pose.rotations[j] = {0, 0, 0, 0};
          break;
        case 4:
          pose.translations[j] = {nan, nan, nan};
          break;
        case 5:
          pose.rotations[0] = {1e30f, 0, 0, 0};
          break;
        default:
          break;
      }
      const double seconds[] = {0, 1e9, -1, 1e-9, 1 / 30.0, nan, infinity};
      const float strengths[] = {f % 3 ? 1.5f : nan, f % 5 ? 0.5f : infinity};
      character.step(pose, strengths, seconds[f % 7], out.pose(f));
    }
    expect_finite(out);
  }
}

TEST_F(StylizerTest, a_sudden_style_arrives_gradually) {
  Stylizer character = stylizer();
  Clip out = clip_;
  for (int f = 0; f < 30; ++f) {
    character.step(clip_.pose(f), std::vector<float>{0, 0}, 1 / 30.0, out.pose(f));
  }
  float largest = 0;
  for (int f = 30; f < 60; ++f) {
    character.step(clip_.pose(f), std::vector<float>{1, 0}, 1 / 30.0, out.pose(f));
    for (size_t j = 0; j < clip_.joints(); ++j) {
      const auto change = [&](int frame) {
        return conjugate(clip_.pose(frame).rotations[j]) * out.pose(frame).rotations[j];
      };
      largest = std::max(largest, length(log_rotation(conjugate(change(f - 1)) * change(f))));
    }
  }
  // The random style turns joints by up to half a radian; none of it comes at once.
  EXPECT_LT(largest, 0.2f);
  EXPECT_GT(largest, 0.001f);
}

TEST_F(StylizerTest, a_character_that_stands_is_not_carried_away) {
  Stylizer character = stylizer();
  Clip out = clip_;
  for (int i = 0; i < 600; ++i) {
    character.step(clip_.pose(5), std::vector<float>{1, 0}, 1 / 30.0, out.pose(5));
  }
  const Vec3 drift = out.pose(5).translations[0] - clip_.pose(5).translations[0];
  EXPECT_LT(std::hypot(drift.x, drift.z), 0.15f);
}

TEST(Stylizer, every_rate_looks_alike) {
  // The hips' rotation after two seconds of the same walk, seen at different rates.
  std::vector<Quat> seen;
  for (const double fps : {30.0, 60.0, 120.0}) {
    const Clip clip = test::walking_clip(int(fps * 2) + 1, fps);
    Stylizer character = *Stylizer::create(random_model(), *Rig::create(clip));
    Clip out = clip;
    for (int f = 0; f < clip.frames; ++f) {
      character.step(clip.pose(f), std::vector<float>{1, 0}, clip.frame_time, out.pose(f));
    }
    seen.push_back(out.pose(out.frames - 1).rotations[0]);
  }
  for (const Quat q : seen) {
    // The filter of 40 ms lags by half a frame more at 30 fps than at 120; the random style moves
    // by up to 1 rad/s.
    EXPECT_LT(length(log_rotation(conjugate(seen.back()) * q)), 0.03f);
  }
}

TEST(Stylizer, options_out_of_range_are_rejected_with_a_message) {
  const Clip clip = test::walking_clip(10);
  StylizerOptions options;
  options.ease_seconds = -1;
  const auto created = Stylizer::create(random_model(), *Rig::create(clip), options);
  ASSERT_FALSE(created.ok());
  EXPECT_EQ(created.error().message,
            "stylizer option of -1.000000 seconds; expected 0 to 10 seconds");
}

TEST_F(StylizerTest, a_state_that_is_damaged_or_of_another_model_is_rejected) {
  Stylizer character = stylizer();
  run(character, {1, 0});
  std::vector<std::byte> state(character.state_size()), kept(state.size());
  character.save(state);
  EXPECT_FALSE(character.restore(std::span(state).first(state.size() - 1)));
  EXPECT_FALSE(character.restore({}));
  for (size_t i = 0; i < state.size(); i += 97) {
    std::vector<std::byte> damaged = state;
    damaged[i] ^= std::byte{1};
    EXPECT_FALSE(character.restore(damaged)) << "byte " << i;
  }
  character.save(kept);
  EXPECT_EQ(kept, state);
  EXPECT_FALSE(stylizer({}, test::kSmith2019).restore(state));
}

TEST_F(StylizerTest, a_character_takes_at_most_17_kilobytes_beside_model_and_rig) {
  const auto model = Model::load(PANACHE_SOURCE_DIR "/models/panache.safetensors");
  const Rig rig = *Rig::create(clip_);
  const size_t before = test::allocated_bytes;
  const Stylizer character = *Stylizer::create(*model, rig);
  const size_t heap = test::allocated_bytes - before;
  // What is asked for while creating is an upper bound of what is kept.
  std::printf("%zu bytes, of which %zu on the heap while creating\n", sizeof character + heap,
              heap);
  EXPECT_LE(sizeof character + heap, 17 * 1024u);
}

// Hops of half a second, for which the networks take both feet to be planted all the time.
TEST_F(StylizerTest, feet_are_not_held_in_the_air) {
  TensorFile file = test::make_model({"old", "sad"}, 3);
  file.tensors["contact.head.0.bias"].values = {10, 10};
  const auto model = *Model::parse(format_safetensors(file), "test model");
  Clip hops = clip_;
  std::vector<float> height(static_cast<size_t>(hops.frames));
  for (int f = 0; f < hops.frames; ++f) {
    const float t = static_cast<float>(f % 30) / 15 - 1;
    height[size_t(f)] = f % 60 < 30 ? 0.35f * (1 - t * t) : 0;
    hops.pose(f).translations[0].y += height[size_t(f)];
  }
  Stylizer character = *Stylizer::create(model, *Rig::create(hops));
  Clip out = hops;
  int in_the_air = 0;
  for (int f = 0; f < hops.frames; ++f) {
    character.step(hops.pose(f), std::vector<float>{1, 0}, hops.frame_time, out.pose(f));
    // The walk itself lifts a toe by less than this.
    if (height[size_t(f)] < 0.25f) continue;
    ++in_the_air;
    EXPECT_LT(character.contacts()[0], 0.5f) << "frame " << f;
    EXPECT_LT(character.contacts()[1], 0.5f) << "frame " << f;
  }
  EXPECT_GT(in_the_air, 10);
}

}  // namespace
}  // namespace panache
