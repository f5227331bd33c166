#include "style/stages/flight.h"

#include <functional>

#include <gtest/gtest.h>

#include "make_clip.h"
#include "make_jump.h"
#include "make_model.h"
#include "rig/posed_rig.h"
#include "style/live_stylizer.h"
#include "style/restyle.h"
#include "style_checks.h"

namespace panache {
namespace {

FlightWatch watch(const Clip& clip, double until = 1e9) {
  FlightWatch flights;
  PosedRig rig(*Rig::create(clip));
  BodyPose body;
  for (int f = 0; f < clip.frames && f * clip.frame_time <= until; ++f) {
    rig.read(clip.pose(f), body);
    flights.push(f * clip.frame_time, body.positions);
  }
  return flights;
}

// A jump from standing has no steps.
const RestyleOptions kTempoEverywhere = [] {
  RestyleOptions options;
  options.stylizer.tempo_everywhere = true;
  return options;
}();

float max(const FlightWatch& flights, double seconds) {
  float out = 0;
  for (double t = 0; t < seconds; t += 0.01) out = std::max(out, flights.amount(t));
  return out;
}

// Acceleration of the parabola that fits the heights best (least squares), m/s^2.
double fall(const std::vector<double>& seconds, const std::vector<double>& heights) {
  const double n = static_cast<double>(seconds.size());
  double mean = 0, y0 = 0;
  for (size_t i = 0; i < seconds.size(); ++i) mean += seconds[i] / n, y0 += heights[i] / n;
  double s2 = 0, s3 = 0, s4 = 0, y1 = 0, y2 = 0;
  for (size_t i = 0; i < seconds.size(); ++i) {
    const double x = seconds[i] - mean, y = heights[i] - y0;
    s2 += x * x, s3 += x * x * x, s4 += x * x * x * x, y1 += x * y, y2 += x * x * y;
  }
  return 2 * (y2 - s3 * y1 / s2) / (s4 - s2 * s2 / n - s3 * s3 / s2);
}

// Heights of mid-hip in the output while the input is in the air. times[frames]: of the input.
double fall_in_flight(const test::Jump& jump, const Clip& out, const std::vector<double>& times) {
  PosedRig rig(*Rig::create(out));
  BodyPose body;
  std::vector<double> seconds, heights;
  for (int f = 0; f < out.frames; ++f) {
    const double t = times[static_cast<size_t>(f)];
    if (t < jump.take_off() + 0.02 || t > jump.landing() - 0.02) continue;
    rig.read(out.pose(f), body);
    seconds.push_back(f * out.frame_time);
    heights.push_back(static_cast<double>(mid_hip(body).y));
  }
  EXPECT_GT(seconds.size(), 5u);
  return fall(seconds, heights);
}

// One style of this tempo.
std::shared_ptr<const Model> model_at_rate(double rate) {
  TensorFile file = test::make_model({"slow"});
  test::set_rate(file, rate);
  return read(file);
}

TEST(Flight, a_jump_is_one_at_any_frame_rate_and_is_seen_before_it_begins) {
  const test::Jump jump;
  for (const double fps : {24, 30, 60, 120, 240}) {
    const FlightWatch flights = watch(jump.clip(fps));
    for (double t = jump.take_off(); t < jump.landing() + 0.1; t += 0.01) {
      EXPECT_GT(flights.amount(t), 0.99f) << fps << " fps, " << t;
    }
    EXPECT_EQ(flights.amount(jump.take_off() - 0.5), 0) << fps;
    EXPECT_EQ(flights.amount(jump.landing() + 0.5), 0) << fps;
    float before = 0;
    for (double t = jump.take_off() - 0.6; t < jump.landing() + 0.6; t += 0.01) {
      // A smooth step over a fifth of a second rises by 7.5 a second.
      EXPECT_NEAR(flights.amount(t), before, 0.08f) << fps << " fps, " << t;
      before = flights.amount(t);
    }
  }
}

TEST(Flight, a_jump_counts_for_more_than_half_before_its_take_off) {
  const test::Jump jump;
  for (const double fps : {60, 120, 240}) {
    EXPECT_GT(watch(jump.clip(fps)).amount(jump.take_off() - 0.14), 0.5f) << fps << " fps";
  }
}

// Where poses are further apart than the parabola reaches, it is laid through three of them.
TEST(Flight, a_jump_is_one_at_a_few_poses_a_second) {
  const test::Jump jump;
  for (const double fps : {10, 12, 15}) {
    const FlightWatch flights = watch(jump.clip(fps));
    EXPECT_GT(flights.amount((jump.take_off() + jump.landing()) / 2), 0.99f) << fps;
    EXPECT_EQ(flights.amount(jump.take_off() - 0.5), 0) << fps;
    EXPECT_EQ(flights.amount(jump.landing() + 0.5), 0) << fps;
  }
}

// A body whose height is given, its feet off the floor; poses come at uneven times.
float max_at_uneven_times(const std::function<float(double)>& height) {
  FlightWatch flights;
  HumanPositions body;
  const double gaps[] = {0.008, 0.008, 0.008, 0.008, 0.03, 0.03, 0.03};
  double time = 0;
  float max = 0;
  for (int i = 0; i < 200; ++i) {
    time += gaps[i % 7];
    body.fill({0, 1 + height(time), 0});
    flights.push(time, body);
    max = std::max(max, flights.amount(time));
  }
  return max;
}

TEST(Flight, at_uneven_times_too_only_what_falls_flies) {
  for (const float speed : {-6.0f, -2.0f, 0.0f, 2.0f, 6.0f}) {
    const auto carried = [&](double t) { return 20 + speed * static_cast<float>(t); };
    EXPECT_EQ(max_at_uneven_times(carried), 0) << speed;
    const auto falls = [&](double t) {
      return carried(t) - static_cast<float>(test::kGravity * t * t / 2);
    };
    EXPECT_GT(max_at_uneven_times(falls), 0.99f) << speed;
  }
}

TEST(Flight, who_plays_what_comes_learns_of_it_in_the_air) {
  const test::Jump jump;
  EXPECT_EQ(watch(jump.clip(), jump.take_off()).amount(jump.take_off()), 0);
  const double late = jump.take_off() + 0.75 * (jump.landing() - jump.take_off());
  EXPECT_GT(watch(jump.clip(), late).amount(late), 0.9f);
  // Long before it has lasted long enough: by how fast the body rises.
  const double soon = jump.take_off() + 0.18;
  EXPECT_GT(watch(jump.clip(), soon).amount(soon), 0.9f);
}

TEST(Flight, walks_runs_and_crouches_are_none) {
  EXPECT_EQ(max(watch(test::walking_clip(300, 60)), 5), 0);
  const auto walker = *WalkerModel::load(PANACHE_SOURCE_DIR "/models/walker.safetensors");
  for (const float speed : {1.4f, 3.0f, kMaxWalkerSpeed}) {
    const Clip clip = walk_clip(walker, {.seconds = 5, .speed = speed});
    EXPECT_LT(max(watch(clip), 5), 0.2f) << speed << " m/s";
  }
  // Feet on the floor, however fast the body goes down; and a body on a box stands high.
  Clip crouch = test::Jump(0.01).clip();
  EXPECT_EQ(max(watch(crouch), 6), 0);
}

TEST(Flight, a_jump_falls_as_its_input_does_in_every_shipped_style) {
  const test::Jump jump;
  const Clip clip = jump.clip();
  const auto model = shipped_model();
  bool slower = false;
  for (size_t s = 0; s < model->styles().size(); ++s) {
    const auto styled = restyle(clip, *Rig::create(clip), model, {{static_cast<int>(s), {{0, 1}}}},
                                kTempoEverywhere);
    std::vector<double> times;
    for (const double frame : styled->source_frames) times.push_back(frame * clip.frame_time);
    EXPECT_NEAR(fall_in_flight(jump, styled->clip, times), -test::kGravity, 0.1 * test::kGravity)
        << model->styles()[s].name;
    slower |= styled->clip.frames > clip.frames * 1.2;
  }
  EXPECT_TRUE(slower) << "and on the ground a style has its own tempo";
}

TEST(Flight, on_the_way_into_a_flight_the_tempo_is_between_the_two) {
  const Clip clip = test::walking_clip(100, 60);
  const auto model = model_at_rate(0.8);
  const auto rate = [&](float flight) {
    Stylizer stylizer = *Stylizer::create(model, *Rig::create(clip));
    Clip out = clip;
    for (int f = 0; f < clip.frames; ++f) {
      stylizer.step(clip.pose(f), std::vector<float>{1}, {clip.frame_time, clip.frame_time, flight},
                    out.pose(f));
    }
    return stylizer.rate();
  };
  EXPECT_EQ(rate(1), 1);
  EXPECT_LT(rate(0), 0.85);
  EXPECT_NEAR(rate(0.5f), std::sqrt(rate(0)), 1e-3);
}

// Between two frames of the input the impact of a landing would be a mean of both.
TEST(Flight, a_jump_lands_on_a_whole_frame_of_its_input) {
  for (const double before : {3.0, 3.1, 3.2}) {
    const test::Jump jump(0.25, before);
    const Clip clip = jump.clip();
    const auto model = model_at_rate(0.83);
    const auto styled = restyle(clip, *Rig::create(clip), model, {{0, {{0, 1}}}}, kTempoEverywhere);
    const double landing = jump.landing() / clip.frame_time;
    double on_foot = 0;
    for (const double frame : styled->source_frames) {
      const double off = std::abs(frame - std::round(frame));
      if (frame < 60) on_foot = std::max(on_foot, off);
      if (std::abs(frame - landing) < 3) {
        EXPECT_LT(off, 0.001) << before;
      }
    }
    EXPECT_GT(on_foot, 0.4);
  }
}

TEST(Flight, live_a_jump_falls_as_its_input_does_in_every_shipped_style) {
  const test::Jump jump;
  const Clip clip = jump.clip();
  const auto model = shipped_model();
  LiveOptions options;
  options.stylizer = kTempoEverywhere.stylizer;
  options.max_lag = 1.5;
  options.stylizer.gesture_rate = 0;
  for (size_t s = 0; s < model->styles().size(); ++s) {
    LiveStylizer live = *LiveStylizer::create(model, *Rig::create(clip), options);
    std::vector<float> strengths(model->styles().size());
    strengths[s] = 1;
    // The clip, and then its last pose until all of it was played.
    Clip out = clip;
    out.resize(clip.frames + 90);
    std::vector<double> times;
    for (int f = 0; f < out.frames; ++f) {
      const int from = std::min(f, clip.frames - 1);
      live.step(clip.pose(from), strengths, clip.frame_time, out.pose(f));
      times.push_back((f + 1) * clip.frame_time + live.ahead() - clip.frame_time);
    }
    EXPECT_NEAR(fall_in_flight(jump, out, times), -test::kGravity, 0.2 * test::kGravity)
        << model->styles()[s].name;
  }
}

TEST(Flight, a_jump_goes_on_bit_for_bit_where_it_was_saved) {
  const test::Jump jump;
  const Clip clip = jump.clip();
  LiveOptions options;
  options.stylizer = kTempoEverywhere.stylizer;
  options.max_lag = 1;
  LiveStylizer live = *LiveStylizer::create(shipped_model(), *Rig::create(clip), options);
  std::vector<float> strengths(live.stylizer().model().styles().size());
  strengths[static_cast<size_t>(*shipped_model()->find_style("old"))] = 1;
  std::vector<std::byte> state(live.state_size());
  Clip once = clip, again = clip;
  const int saved = static_cast<int>((jump.take_off() + 0.4) / clip.frame_time);
  for (int f = 0; f < clip.frames; ++f) {
    if (f == saved) live.save(state);
    live.step(clip.pose(f), strengths, clip.frame_time, once.pose(f));
  }
  ASSERT_TRUE(live.restore(state));
  for (int f = saved; f < clip.frames; ++f) {
    live.step(clip.pose(f), strengths, clip.frame_time, again.pose(f));
    for (size_t j = 0; j < clip.joints(); ++j) {
      ASSERT_EQ(once.pose(f).rotations[j], again.pose(f).rotations[j]) << f;
    }
  }
}

}  // namespace
}  // namespace panache
