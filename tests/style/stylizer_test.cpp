#include "style/stylizer.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include <gtest/gtest.h>

#include "count_allocations.h"
#include "make_clip.h"
#include "make_model.h"
#include "style/model/person.h"
#include "style_checks.h"

namespace panache {
namespace {

using test::same_bits;

std::shared_ptr<const Model> random_model(const Recipe& recipe = test::kPanache) {
  return read(test::make_model({"old", "proud"}, 3, recipe));
}

std::shared_ptr<const Model> gated_model(float limit) {
  TensorFile file = test::make_model({"old", "proud"}, 3);
  test::add_gate(file, limit);
  return read(file);
}

class StylizerTest : public testing::Test {
 protected:
  explicit StylizerTest(double fps = 30) : clip_(test::walking_clip(int(fps * 4), fps)) {}

  Stylizer stylizer(const StylizerOptions& options = {},
                    const Recipe& recipe = test::kPanache) const {
    return *Stylizer::create(random_model(recipe), *Rig::create(clip_), options);
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

TEST_F(StylizerTest, strength_zero_gives_the_input_back_bit_for_bit_behind_any_gate_on_any_side) {
  for (const auto& model : {random_model(), gated_model(1e-3f)}) {
    for (const float side : {1.0f, -1.0f, 0.5f}) {
      StylizerOptions options;
      options.sides = {side, side};
      Stylizer character = *Stylizer::create(model, *Rig::create(clip_), options);
      EXPECT_TRUE(same_bits(played(character, clip_, {0, 0}), clip_)) << side;
      EXPECT_EQ(character.rate(), 1);
    }
  }
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
  Stylizer character = *Stylizer::create(read(file), *Rig::create(clip_), options);
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
  played(character, clip_, {1, 0});
  const Clip after = played(character, clip_, {0, 0});
  const size_t joints = clip_.joints(), last = (clip_.frames - 1) * joints;
  for (size_t j = 0; j < joints; ++j) {
    EXPECT_EQ(after.rotations[last + j], clip_.rotations[last + j]) << "joint " << j;
  }
}

TEST_F(StylizerTest, a_step_allocates_nothing) {
  TensorFile rich = test::make_model({"old", "proud"}, 3);
  test::add_gate(rich, 1e-3f);
  test::add_persons(rich);
  for (const auto& model : {random_model(), random_model(test::kSmith2019), read(rich)}) {
    Stylizer character = *Stylizer::create(model, *Rig::create(clip_));
    Clip out = clip_;
    std::vector<float> strengths = {0.5f, 0.5f};
    const long before = test::allocations;
    for (int i = 0; i < 1000; ++i) {
      strengths[0] = static_cast<float>(i % 7) * 0.2f;
      if (i == 300) character.set_side(0, 0.5f);
      if (i == 600 && model->persons()) character.set_person(person_of_seed(*model, 3, 1));
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

TEST_F(StylizerTest, behind_a_closed_gate_the_root_motion_is_the_inputs) {
  const auto drift = [&](std::shared_ptr<const Model> model) {
    Stylizer character = *Stylizer::create(model, *Rig::create(clip_));
    played(character, clip_, {1, 0});
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

TEST_F(StylizerTest, the_same_input_gives_the_same_bits_and_a_reset_one_starts_anew) {
  for (const auto& model : {random_model(), gated_model(1e-3f), gated_model(1), gated_model(2)}) {
    Stylizer first = *Stylizer::create(model, *Rig::create(clip_)), second = first;
    const Clip once = played(first, clip_, {1, 0.5f});
    EXPECT_TRUE(same_bits(played(second, clip_, {1, 0.5f}), once));
    first.reset();
    EXPECT_TRUE(same_bits(played(first, clip_, {1, 0.5f}), once));
  }
}

TEST_F(StylizerTest, garbage_in_gives_finite_poses_out) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  constexpr float infinity = std::numeric_limits<float>::infinity();
  const std::function<void(Pose, size_t)> spoil[] = {[](Pose pose, size_t j) {
                                                       pose.rotations[j] = {nan, 0, 0, 1};
                                                     },
                                                     [](Pose pose, size_t) {
                                                       pose.translations[0] = {infinity, 0, 0};
                                                     },
                                                     [](Pose pose, size_t) {
                                                       pose.translations[0] = {0, 0, 1e8f};
                                                     },  // A teleport.
                                                     [](Pose pose, size_t j) {
                                                       pose.rotations[j] = {0, 0, 0, 0};
                                                     },
                                                     [](Pose pose, size_t j) {
                                                       pose.translations[j] = {nan, nan, nan};
                                                     },
                                                     [](Pose pose, size_t) {
                                                       pose.rotations[0] = {1e30f, 0, 0, 0};
                                                     },
                                                     [](Pose, size_t) {}};
  for (const Recipe* recipe : {&test::kPanache, &test::kSmith2019}) {
    Stylizer character = stylizer({}, *recipe);
    Clip in = clip_, out = clip_;
    Random random(11);
    for (int f = 0; f < in.frames; ++f) {
      spoil[f / 2 % 7](in.pose(f), random.below(static_cast<uint32_t>(in.joints())));
      const double seconds[] = {0, 1e9, -1, 1e-9, 1 / 30.0, nan, infinity};
      const float strengths[] = {f % 3 ? 1.5f : nan, f % 5 ? 0.5f : infinity};
      character.step(in.pose(f), strengths, seconds[f % 7], out.pose(f));
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
    seen.push_back(played(character, clip, {1, 0}).pose(clip.frames - 1).rotations[0]);
  }
  for (const Quat q : seen) {
    // The filter of 40 ms lags by half a frame more at 30 fps than at 120; the random style moves
    // by up to 1 rad/s.
    EXPECT_LT(length(log_rotation(conjugate(seen.back()) * q)), 0.03f);
  }
}

TEST_F(StylizerTest, a_state_that_is_damaged_or_of_another_model_is_rejected) {
  Stylizer character = stylizer();
  played(character, clip_, {1, 0});
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
  const auto model = read(file);
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
