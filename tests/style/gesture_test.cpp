#include "style/model/gesture.h"

#include <cmath>
#include <functional>
#include <optional>

#include <gtest/gtest.h>

#include "allocations.h"
#include "make_clip.h"
#include "make_jump.h"
#include "make_model.h"
#include "rig/posed_rig.h"
#include "style/restyle.h"
#include "style_checks.h"

namespace panache {
namespace {

using test::same_bits;

using enum HumanJoint;

// Control points of `seconds` that come and go like a bell.
std::vector<GesturePose> bell(double seconds, const GesturePose& peak) {
  std::vector<GesturePose> points;
  const int count = static_cast<int>(seconds * double(Gesture::kRate)) - 3;
  for (int k = 0; k < count; ++k) {
    const float share =
        std::sin(3.14159265f * static_cast<float>(k + 1) / static_cast<float>(count + 1));
    points.push_back(scaled(share * share, peak));
  }
  return points;
}
GesturePose turned(HumanJoint joint, Vec3 turn) {
  GesturePose pose;
  pose.turns[index(joint)] = turn;
  return pose;
}
GesturePose dip(float height, float lift = 0) {
  GesturePose pose;
  pose.height = height;
  pose.lift = lift;
  return pose;
}
constexpr float kGlance = 0.8f;  // Radians to the left.

// A style of no change with a glance and a dip, and one without gestures.
TensorFile model_with_gestures() {
  TensorFile file = test::make_model({"nosy", "plain"}, 3);
  for (const char* head : {"pose.head.0", "pose.head.1"}) {
    for (const char* part : {".weight", ".bias"}) {
      for (float& number : file.tensors[std::string(head) + part].values) number = 0;
    }
  }
  file.tensors["gesture.0.0"] = Gesture(bell(1.2, turned(head, {0, kGlance, 0}))).tensor();
  file.tensors["gesture.0.1"] = Gesture(bell(1, dip(-0.15f))).tensor();
  file.tensors["gesture.0.2"] = Gesture(bell(0.7, dip(0.15f, 0.15f))).tensor();
  return file;
}
// The same, in whose takes the first style has so many of them a second.
std::shared_ptr<const Model> lively_model(const std::string& rates = "0.4\n\n") {
  TensorFile file = model_with_gestures();
  file.metadata["style_gesture_rates"] = rates;
  return read(file);
}

class GestureTest : public testing::Test {
 protected:
  GestureTest() : clip_(test::walking_clip(240, 60)), model_(read(model_with_gestures())) {}

  Stylizer character(const StylizerOptions& options = {}) const {
    return *Stylizer::create(model_, *Rig::create(clip_), options);
  }
  // All frames of `clip`; `before` is called before each step.
  Clip run(Stylizer& character, const std::function<void(int)>& before = {},
           float strength = 1) const {
    Clip out = clip_;
    for (int f = 0; f < clip_.frames; ++f) {
      if (before) before(f);
      character.step(clip_.pose(f), std::array{strength, 0.0f}, clip_.frame_time, out.pose(f));
    }
    return out;
  }
  // Of all joints in each frame, m/s^2 at 60 frames a second.
  std::vector<HumanPositions> accelerations(const Clip& clip) {
    std::vector<HumanPositions> body, out(static_cast<size_t>(clip.frames));
    for (int f = 0; f < clip.frames; ++f) body.push_back(world(clip, f));
    for (size_t f = 2; f < body.size(); ++f) {
      for (int j = 0; j < kHumanJoints; ++j) {
        out[f][j] = (body[f][j] - body[f - 1][j] * 2 + body[f - 2][j]) * 3600;
      }
    }
    return out;
  }
  HumanPositions world(const Clip& clip, int frame) {
    if (!reader_) reader_.emplace(*Rig::create(clip_));
    BodyPose body;
    reader_->read(clip.pose(frame), body);
    return body.positions;
  }
  // The clip without and with a gesture that begins at frame 60.
  std::pair<Clip, Clip> run_with(int gesture) const {
    Stylizer plain = character(), moved = character();
    const Clip before = run(plain);
    return {before, run(moved, [&](int f) {
              if (f == 60) moved.trigger(0, gesture);
            })};
  }
  // How far `joint` is turned in `clip` beyond the input, radians.
  float turn_of(const Clip& clip, int frame, HumanJoint joint) const {
    const Quat now = clip.pose(frame).rotations[index(joint)];
    return length(log_rotation(conjugate(clip_.pose(frame).rotations[index(joint)]) * now));
  }

  Clip clip_;
  std::shared_ptr<const Model> model_;

 private:
  std::optional<PosedRig> reader_;
};

TEST(Gesture, begins_and_ends_without_a_jerk) {
  const Gesture gesture(bell(1.2, turned(head, {0, 1, 0})));
  EXPECT_NEAR(gesture.seconds(), 1.2f, 1e-5f);
  const auto yaw = [&](float time) { return gesture.at(time).turns[index(head)].y; };
  EXPECT_EQ(yaw(0), 0);
  EXPECT_EQ(yaw(gesture.seconds()), 0);
  EXPECT_EQ(yaw(-1), 0);
  EXPECT_EQ(yaw(std::nanf("")), 0);
  EXPECT_NEAR(yaw(0.6f), 1, 0.1f);
  // The second difference goes on from 0 and never jumps: a curve of third degree.
  constexpr float h = 1e-2f;
  float last = 0;
  for (float t = 0; t < gesture.seconds() + 0.1f; t += h) {
    const float acceleration = (yaw(t + h) - 2 * yaw(t) + yaw(t - h)) / (h * h);
    EXPECT_LT(std::abs(acceleration - last), 4) << t;
    last = acceleration;
  }
}

TEST(Gesture, is_the_same_from_its_file) {
  const Gesture gesture(bell(1, turned(left_upper_arm, {0.3f, -1.25f, 2})));
  const Tensor tensor = gesture.tensor();
  const Gesture read = *Gesture::read(tensor, "gesture.0", "file");
  EXPECT_EQ(read.tensor().values, tensor.values);
  EXPECT_EQ(read.name(), gesture.name());
  EXPECT_FALSE(read.moves_hips());
  EXPECT_TRUE(Gesture(bell(1, dip(-0.1f))).moves_hips());
}

TEST(Gesture, of_a_broken_file_is_rejected) {
  const Tensor good = Gesture(bell(1, dip(0.1f))).tensor();
  const auto message = [&](auto&& change) {
    Tensor tensor = good;
    change(tensor);
    const Result<Gesture> read = Gesture::read(tensor, "gesture.3.0", "m.safetensors");
    return read.ok() ? "" : read.error().message;
  };
  const std::string shape =
      "m.safetensors: tensor 'gesture.3.0' is no gesture; expected 4 to 60 rows of 41 numbers";
  EXPECT_EQ(message([](Tensor& t) { t.shape = {3, 41}; }), shape);
  EXPECT_EQ(message([](Tensor& t) { t.shape = {61, 41}; }), shape);
  EXPECT_EQ(message([](Tensor& t) { t.shape = {41}; }), shape);
  EXPECT_EQ(message([](Tensor& t) { t.shape = {12, 40}; }), shape);
  for (const float number : {11.0f, -11.0f, std::nanf(""), INFINITY}) {
    EXPECT_EQ(message([&](Tensor& t) { t.values[7] = number; }),
              "m.safetensors: tensor 'gesture.3.0' holds a number beyond 10 radians or metres");
  }
  TensorFile file = model_with_gestures();
  file.tensors["gesture.1.0"] = {{2, 2}, {0, 0, 0, 0}, false};
  EXPECT_FALSE(Model::create(file, "model").ok());
}

TEST(Gesture, tells_what_one_sees_and_how_long) {
  EXPECT_EQ(Gesture(bell(1.2, turned(head, {0, 0.8f, 0}))).name(), "glances left, 1.2 s");
  EXPECT_EQ(Gesture(bell(0.7, dip(0.15f, 0.15f))).name(), "hops, 0.7 s");
}

TEST_F(GestureTest, of_a_model_without_rates_none_is_played_unasked) {
  TensorFile bare = model_with_gestures();
  std::erase_if(bare.tensors, [](const auto& t) { return t.first.starts_with("gesture."); });
  const auto without = read(bare);
  Stylizer one = character(), other = *Stylizer::create(without, *Rig::create(clip_), {});
  EXPECT_TRUE(same_bits(run(one), run(other)));
  EXPECT_EQ(model_->parameter_count(), without->parameter_count());
}

TEST_F(GestureTest, a_trigger_turns_the_head_and_back) {
  const auto [before, after] = run_with(0);
  for (int f = 0; f < 61; ++f) EXPECT_EQ(turn_of(after, f, head), turn_of(before, f, head)) << f;
  EXPECT_NEAR(turn_of(after, 96, head), kGlance, 0.15f);
  for (int f = 150; f < 240; ++f) EXPECT_LT(turn_of(after, f, head), 0.01f) << f;
  // Nothing else moves.
  for (int f = 0; f < 240; ++f) EXPECT_LT(turn_of(after, f, left_upper_arm), 0.02f) << f;
}

TEST_F(GestureTest, its_amount_is_the_styles_strength) {
  const auto turn_at = [&](float strength) {
    Stylizer one = character();
    const auto at_60 = [&](int f) { f == 60 && one.trigger(0, 0); };
    return turn_of(run(one, at_60, strength), 96, head);
  };
  EXPECT_NEAR(turn_at(0.5f), turn_at(1) / 2, 0.03f);
  EXPECT_EQ(turn_at(0), 0);
  EXPECT_EQ(turn_at(-1), 0);
}

TEST_F(GestureTest, at_strength_zero_a_trigger_keeps_the_bits) {
  Stylizer one = character();
  const auto always = [&](int) { one.trigger(0, 1); };
  EXPECT_TRUE(same_bits(run(one, always, 0), clip_));
}

TEST_F(GestureTest, there_is_none_beyond_those_of_the_model) {
  Stylizer one = character();
  EXPECT_FALSE(one.trigger(0, 3));
  EXPECT_FALSE(one.trigger(0, -1));
  EXPECT_FALSE(one.trigger(1, 0));
  EXPECT_FALSE(one.trigger(2, 0));
  EXPECT_FALSE(one.trigger(-1, 0));
}

TEST_F(GestureTest, a_dip_bends_the_knees_and_keeps_the_feet) {
  const auto [before, after] = run_with(1);
  float deepest = 0;
  for (int f = 60; f < 130; ++f) {
    const HumanPositions a = world(before, f), b = world(after, f);
    deepest = std::max(deepest, a[0].y - b[0].y);
    for (const HumanJoint ankle : {left_foot, right_foot}) {
      EXPECT_LT(length(a[index(ankle)] - b[index(ankle)]), 0.03f) << f;
    }
  }
  EXPECT_GT(deepest, 0.1f);
}

TEST_F(GestureTest, a_hop_lifts_both_feet) {
  const auto [before, after] = run_with(2);
  float lifted = 0, risen = 0;
  for (int f = 60; f < 130; ++f) {
    const HumanPositions a = world(before, f), b = world(after, f);
    risen = std::max(risen, b[0].y - a[0].y);
    lifted = std::max(lifted, std::min(b[index(left_foot)].y - a[index(left_foot)].y,
                                       b[index(right_foot)].y - a[index(right_foot)].y));
  }
  EXPECT_GT(lifted, 0.08f);
  EXPECT_NEAR(risen, 0.15f, 0.03f);
}

TEST_F(GestureTest, no_joint_jumps) {
  clip_ = walker_walk(clip_.frames);
  Stylizer plain = character(), one = character();
  const Clip before = run(plain);
  const Clip after = run(one, [&](int f) {
    if (f % 20 == 0) one.trigger(0, (f / 20) % 3);
  });
  // m/s^2, at 60 frames a second. A foot that is set down stops with as much in the walk itself; a
  // knee that straightens after a dip adds 44, and a gesture that goes in steps of its points 123.
  constexpr float kMax = 55;
  const auto plainly = accelerations(before), moved = accelerations(after);
  float max_plain = 0;
  for (size_t f = 0; f < moved.size(); ++f) {
    for (int j = 0; j < kHumanJoints; ++j) {
      max_plain = std::max(max_plain, length(plainly[f][j]));
      EXPECT_LT(length(moved[f][j] - plainly[f][j]), kMax) << f << " " << j;
    }
  }
  EXPECT_GT(max_plain, kMax / 2) << "the bound says something about this walk";
}

// All that come with Panache, on a generated walk at full strength.
TEST_F(GestureTest, those_of_the_shipped_model_jump_nowhere) {
  model_ = *Model::load(PANACHE_SOURCE_DIR "/models/panache-int8.safetensors");
  clip_ = walker_walk(clip_.frames, 1.3f, 0);
  const auto accelerations_in = [&](int style, int gesture) {
    StylizerOptions options;
    options.gesture_rate = 0;  // None but the one in question.
    Stylizer one = character(options);
    std::vector<float> strengths(model_->styles().size());
    strengths[static_cast<size_t>(style)] = 1;
    Clip out = clip_;
    for (int f = 0; f < clip_.frames; ++f) {
      if (f == 40 && gesture >= 0) one.trigger(style, gesture);
      one.step(clip_.pose(f), strengths, clip_.frame_time, out.pose(f));
    }
    return accelerations(out);
  };
  int count = 0;
  for (int style = 0; style < static_cast<int>(model_->styles().size()); ++style) {
    const int gestures = static_cast<int>(model_->gestures(style).size());
    if (gestures == 0) continue;
    const auto plain = accelerations_in(style, -1);
    for (int k = 0; k < gestures; ++k, ++count) {
      const auto with = accelerations_in(style, k);
      float max = 0;
      for (size_t f = 0; f < with.size(); ++f) {
        for (int j = 0; j < kHumanJoints; ++j) {
          max = std::max(max, length(with[f][j] - plain[f][j]));
        }
      }
      // m/s^2; the styled walks themselves reach 80 to 100, an arm that meets the body 390. A joint
      // that is 20 cm elsewhere in the next frame has 720.
      EXPECT_LT(max, 450) << model_->styles()[static_cast<size_t>(style)].name << " " << k;
      EXPECT_GT(max, 0);
    }
  }
  EXPECT_GE(count, 20);
}

// A jump, with a trigger a moment after its take-off.
TEST_F(GestureTest, in_the_air_a_trigger_waits_for_the_floor) {
  const test::Jump jump(0.4, 1);
  clip_ = jump.clip(60);
  for (const int gesture : {0, 1}) {
    Stylizer one = character();
    const int asked = static_cast<int>((jump.take_off() + 0.06) * 60);
    int first = -1;
    Clip out = clip_;
    for (int f = 0; f < clip_.frames; ++f) {
      if (f == asked) one.trigger(0, gesture);
      one.step(clip_.pose(f), std::array{1.0f, 0.0f}, clip_.frame_time, out.pose(f));
      if (first < 0 && one.gesture()) first = f;
    }
    EXPECT_GE(first, static_cast<int>(jump.landing() * 60)) << gesture;
    EXPECT_LT(first, static_cast<int>((jump.landing() + 0.6) * 60)) << gesture;
  }
}

TEST_F(GestureTest, on_the_way_into_a_jump_it_ends) {
  const test::Jump jump(0.4, 1);
  clip_ = jump.clip(60);
  Stylizer one = character();
  const Clip out = run(one, [&](int f) {
    if (f == static_cast<int>((jump.take_off() - 0.3) * 60)) one.trigger(0, 0);
  });
  // The flight is detected within 0.15 s of its beginning, and eases in.
  for (double t = jump.take_off() + 0.3; t < jump.landing(); t += 0.02) {
    EXPECT_LT(turn_of(out, static_cast<int>(t * 60), head), 0.1f) << t;
  }
}

TEST_F(GestureTest, by_default_they_come_as_often_as_in_the_takes_and_the_same_each_time) {
  model_ = lively_model();
  StylizerOptions options;
  const auto starts = [&](Stylizer& one, float strength = 1) {
    std::vector<int> found;
    bool played = false;
    Clip out = clip_;
    for (int f = 0; f < 200 * 60; ++f) {
      one.step(clip_.pose(f % 200), std::array{strength, 0.0f}, clip_.frame_time, out.pose(0));
      if (one.gesture() && !played) found.push_back(f);
      played = one.gesture();
    }
    return found;
  };
  // The clip starts again and again on the spot; its jumps back are no jumps for this character.
  options.max_speed = std::numeric_limits<float>::infinity();
  Stylizer one = character(options), same = character(options);
  const std::vector<int> first = starts(one);
  EXPECT_NEAR(static_cast<double>(first.size()), 80, 12);
  EXPECT_EQ(first, starts(same));
  one.reset();
  EXPECT_EQ(first, starts(one)) << "a reset character starts anew";
  options.gesture_seed = 1;
  Stylizer other = character(options);
  EXPECT_NE(first, starts(other));
  // Half as often at half the strength, and where half as many are asked for; none for 0.
  Stylizer weak = character(options);
  EXPECT_NEAR(static_cast<double>(starts(weak, 0.5f).size()), 40, 8);
  options.gesture_rate = 0.5f;
  Stylizer rare = character(options);
  EXPECT_NEAR(static_cast<double>(starts(rare).size()), 40, 8);
  options.gesture_rate = 0;
  Stylizer still = character(options);
  EXPECT_TRUE(starts(still).empty());
}

TEST_F(GestureTest, of_a_mix_each_style_plays_its_own) {
  TensorFile file = model_with_gestures();
  file.tensors["gesture.1.0"] = Gesture(bell(0.6, turned(left_upper_arm, {0, 0, 1}))).tensor();
  file.metadata["style_gesture_rates"] = "0.2\n0.4\n";
  model_ = read(file);
  StylizerOptions options;
  options.max_speed = std::numeric_limits<float>::infinity();
  const auto count = [&](std::array<float, 2> strengths) {
    Stylizer one = character(options);
    std::array<double, 2> counts{};
    bool played = false;
    Clip out = clip_;
    for (int f = 0; f < 120 * 60; ++f) {
      one.step(clip_.pose(f % 200), strengths, clip_.frame_time, out.pose(0));
      // Only that of the second style moves an arm.
      if (one.gesture() && !played) {
        ++counts[0];
      } else if (one.gesture() && length(one.gesture()->turns[index(left_upper_arm)]) > 0.3f) {
        counts[1] += 1e-6;
      }
      played = one.gesture();
    }
    // Frames with a raised arm, as a share of all gestures: each has some twenty.
    return std::pair{counts[0], counts[1] * 1e6 / counts[0]};
  };
  const auto [first, arms_of_first] = count({1, 0});
  const auto [second, arms_of_second] = count({0, 1});
  const auto [both, arms_of_both] = count({1, 1});
  EXPECT_NEAR(first, 24, 6);
  EXPECT_NEAR(second, 48, 9);
  EXPECT_NEAR(both, 72, 12);
  EXPECT_EQ(arms_of_first, 0);
  EXPECT_NEAR(arms_of_both / arms_of_second, 2.0 / 3, 0.2);
}

TEST_F(GestureTest, of_a_mirrored_style_are_mirrored) {
  const auto turn_at = [&](float side) {
    StylizerOptions options;
    options.sides = {side, 1};
    Stylizer one = character(options);
    float max = 0;
    run(one, [&](int f) {
      if (f == 60) one.trigger(0, 0);
      if (!one.gesture()) return;
      const float turn = one.gesture()->turns[index(head)].y;
      if (std::abs(turn) > std::abs(max)) max = turn;
    });
    return max;
  };
  EXPECT_NEAR(turn_at(1), kGlance, 0.1f);
  EXPECT_EQ(turn_at(-1), -turn_at(1));
  EXPECT_NEAR(turn_at(0), 0, 1e-6f);
}

TEST_F(GestureTest, a_step_allocates_nothing) {
  model_ = lively_model("1\n\n");
  Stylizer one = character();
  Clip out = clip_;
  const auto before = test::allocations.load();
  for (int f = 0; f < clip_.frames; ++f) {
    if (f % 50 == 0) one.trigger(0, f / 50 % 3);
    one.step(clip_.pose(f), std::array{1.0f, 0.0f}, clip_.frame_time, out.pose(f));
  }
  EXPECT_EQ(test::allocations.load(), before);
}

TEST_F(GestureTest, rates_out_of_range_are_rejected) {
  for (const float rate : {-0.1f, 10.5f, std::nanf("")}) {
    StylizerOptions options;
    options.gesture_rate = rate;
    const auto made = Stylizer::create(model_, *Rig::create(clip_), options);
    ASSERT_FALSE(made.ok());
    EXPECT_EQ(made.error().message, "gesture rate of " + std::to_string(rate) +
                                        "; expected 0 to 10 times that of the takes");
  }
}

TEST_F(GestureTest, a_loop_has_none_at_random) {
  model_ = lively_model("2\n\n");
  const StrengthTrack track{0, {{0, 1}}};
  const auto restyled = [&](LoopMode loop, float rate) {
    RestyleOptions options;
    options.loop = loop;
    options.stylizer.gesture_rate = rate;
    return *restyle(clip_, *Rig::create(clip_), model_, {track}, options);
  };
  for (const LoopMode loop : {LoopMode::detect, LoopMode::force}) {
    const Restyled lively = restyled(loop, 1);
    EXPECT_TRUE(lively.loop.closed);
    EXPECT_TRUE(same_bits(lively.clip, restyled(loop, 0).clip));
  }
  EXPECT_FALSE(same_bits(restyled(LoopMode::off, 1).clip, restyled(LoopMode::off, 0).clip));
}

TEST(Gesture, rates_of_a_broken_file_are_rejected) {
  TensorFile file = model_with_gestures();
  const auto message = [&](const std::string& rates) {
    file.metadata["style_gesture_rates"] = rates;
    return failure(file);
  };
  EXPECT_EQ(message("0.25\n\n"), "");
  EXPECT_EQ(message("10\n0\n"), "");
  for (const std::string bad : {"-1", "11", "often", "1e1", "0.2.5", "0.00000001"}) {
    EXPECT_EQ(message(bad + "\n\n"),
              "m.safetensors: metadata 'style_gesture_rates': style 'nosy': '" + bad +
                  "'; expected gestures a second from 0 to 10, such as 0.25");
  }
  EXPECT_EQ(message("0.25\n"),
            "m.safetensors: metadata 'style_gesture_rates' has 1 lines; expected 2, one per style");
}

}  // namespace
}  // namespace panache
