// Loops stay loops: clips whose last pose is their first, travel aside, restyled.

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <tuple>

#include <gtest/gtest.h>

#include "clip/motion_file.h"
#include "make_clip.h"
#include "make_loop.h"
#include "pose/observer.h"
#include "rig/put_on.h"
#include "style/restyle.h"
#include "style_checks.h"

namespace panache {
namespace {

using namespace test;

StrengthTrack track(const std::string& style, float strength = 1) {
  return {*shipped_model()->find_style(style), {{0, strength}}};
}

Restyled styled(const Clip& clip, const StrengthTrack& wanted, LoopMode mode, bool timing = true) {
  RestyleOptions options;
  options.loop = mode;
  options.timing = timing;
  return *restyle(clip, *Rig::create(clip), shipped_model(), {wanted}, options);
}

LoopSeam seam_of(const Clip& clip) { return measure_seam(clip, *Rig::create(clip)); }

TEST(RestyleLoop, a_loop_stays_a_loop_in_every_style) {
  const Clip cycle = walk_cycle();
  ASSERT_TRUE(is_loop(seam_of(cycle), cycle.frame_time));
  int open_ones = 0;
  for (size_t s = 0; s < shipped_model()->styles().size(); ++s) {
    const StrengthTrack wanted = {static_cast<int>(s), {{0, 1}}};
    open_ones += seam_of(styled(cycle, wanted, LoopMode::off, false).clip).gap > 0.01f;
    for (const bool timing : {false, true}) {
      const Restyled result = styled(cycle, wanted, LoopMode::detect, timing);
      EXPECT_TRUE(result.loop.closed);
      EXPECT_TRUE(result.loop.settled) << shipped_model()->styles()[s].name;
      // Before the rest is spread: the target of 5 mm, and a quarter of the mean.
      EXPECT_LT(result.loop.spread, 0.005f) << shipped_model()->styles()[s].name;
      const LoopSeam seam = seam_of(result.clip);
      EXPECT_LT(seam.gap, 1e-4f) << shipped_model()->styles()[s].name;
      EXPECT_LT(seam.worst, 1e-4f) << shipped_model()->styles()[s].name;
    }
  }
  EXPECT_GT(open_ones, 45);  // Otherwise there would be nothing to close.
}

TEST(RestyleLoop, it_begins_at_the_first_frame_and_ends_at_the_last) {
  const Clip cycle = walk_cycle();
  const double last = cycle.frames - 1;
  const Restyled steady = styled(cycle, track("old"), LoopMode::detect, false);
  ASSERT_EQ(steady.clip.frames, cycle.frames);
  for (int f = 0; f < cycle.frames; ++f) EXPECT_EQ(steady.source_frames[f], f);
  const Restyled timed = styled(cycle, track("proud"), LoopMode::detect, true);
  EXPECT_GT(timed.clip.frames, cycle.frames + 20);
  EXPECT_EQ(timed.source_frames.front(), 0);
  EXPECT_EQ(timed.source_frames.back(), last);
  EXPECT_EQ(timed.source_frames.size(), static_cast<size_t>(timed.clip.frames));
  EXPECT_EQ(timed.contacts.size(), timed.gates.size());
  for (size_t f = 1; f < timed.source_frames.size(); ++f) {
    EXPECT_GT(timed.source_frames[f], timed.source_frames[f - 1]);
  }
  // Where the input's root is.
  PosedRig reader(*Rig::create(cycle));
  Observation in, out;
  observe(reader, cycle.pose(0), 0, in);
  observe(reader, timed.clip.pose(0), 0, out);
  EXPECT_LT(length(in.root.position - out.root.position), 0.02f);
}

// What the toes and the root go from the first frame to the last.
struct Travel {
  Vec3 left, right, root;
  float turned;
};
Travel travel_of(const Clip& clip) {
  PosedRig reader(*Rig::create(clip));
  Observation a, b;
  observe(reader, clip.pose(0), 0, a);
  observe(reader, clip.pose(clip.frames - 1), a.root.facing, b);
  const auto travel = [&](HumanJoint joint) {
    return b.world.joints[index(joint)] - a.world.joints[index(joint)];
  };
  return {travel(HumanJoint::left_toes), travel(HumanJoint::right_toes),
          b.root.position - a.root.position, b.root.facing - a.root.facing};
}

TEST(RestyleLoop, both_feet_travel_as_the_root_does) {
  const Clip cycle = walk_cycle();
  for (const char* style : {"old", "proud", "zombie"}) {
    const Travel travel = travel_of(styled(cycle, track(style), LoopMode::detect).clip);
    EXPECT_LT(std::abs(travel.turned), 0.02f);
    EXPECT_LT(length(travel.left - travel.right), 0.01f) << style;
    EXPECT_GT(length(travel.root), 0.45f) << style;
  }
}

TEST(RestyleLoop, a_loop_that_turns_closes_and_turns_as_far) {
  const Clip cycle = walk_cycle(1.2f, 0.8f);
  ASSERT_TRUE(is_loop(seam_of(cycle), cycle.frame_time));
  const float turned = travel_of(cycle).turned;
  EXPECT_GT(turned, 0.5f);
  for (const char* style : {"old", "proud", "zombie"}) {
    const Clip clip = styled(cycle, track(style), LoopMode::detect).clip;
    EXPECT_LT(seam_of(clip).worst, 1e-4f) << style;
    EXPECT_NEAR(travel_of(clip).turned, turned, 0.05f) << style;
  }
}

// Frames `first` to `last` of a result.
Restyled part_of(const Restyled& whole, int first, int last) {
  Restyled part;
  part.clip = cut(whole.clip, first, last);
  const auto copy = [&](const auto& from, auto& to) {
    to.assign(from.begin() + first, from.begin() + last + 1);
  };
  copy(whole.source_frames, part.source_frames);
  copy(whole.contacts, part.contacts);
  copy(whole.gates, part.gates);
  copy(whole.stages, part.stages);
  return part;
}

TEST(RestyleLoop, a_loop_is_what_a_long_walk_comes_to) {
  const Clip cycle = walk_cycle(), walk_on = walk(11, 1.3f);
  const int frames = cycle.frames - 1;
  // The ninth cycle: where the walk is as it was, but for half a frame.
  int begin = 0;
  float min = 1;
  for (int f = kCycleBegin + 8 * frames - 20; f < kCycleBegin + 8 * frames + 20; ++f) {
    const float gap = seam_of(cut(walk_on, kCycleBegin, f)).gap;
    if (gap < min) min = gap, begin = f;
  }
  const Rig rig = *Rig::create(cycle), long_rig = *Rig::create(walk_on);
  PosedRig reader(rig), long_reader(long_rig);
  double slide = 0, long_slide = 0, apart = 0;
  for (size_t s = 0; s < shipped_model()->styles().size(); ++s) {
    const StrengthTrack wanted = {static_cast<int>(s), {{0, 1}}};
    const Restyled loop = styled(cycle, wanted, LoopMode::detect, false);
    const Restyled ninth =
        part_of(styled(walk_on, wanted, LoopMode::off, false), begin, begin + frames);
    slide += static_cast<double>(restyle_facts(cycle, rig, loop).slide);
    long_slide += static_cast<double>(restyle_facts(walk_on, long_rig, ninth).slide);
    for (int f = 0; f <= frames; ++f) {
      Observation a, b;
      observe(reader, loop.clip.pose(f), 0, a);
      observe(long_reader, ninth.clip.pose(f), 0, b);
      for (int j = 0; j < kHumanJoints; ++j) {
        apart += static_cast<double>(length(a.body_frame[j] - b.body_frame[j]));
      }
    }
  }
  apart /= static_cast<double>(shipped_model()->styles().size() *
                               static_cast<size_t>(cycle.frames) * kHumanJoints);
  // A frame of such a walk is 9 mm, and neither begins at the same moment of it.
  EXPECT_LT(apart, 0.009);
  EXPECT_LT(slide, 1.03 * long_slide);
}

TEST(RestyleLoop, every_makers_rig_gets_a_loop) {
  const Clip cycle = walk_cycle(1.3f, 0.3f, 30);
  for (const Maker& maker : makers()) {
    const Clip character = put_on(maker, cycle).clip;
    const Restyled result = styled(character, track("old"), LoopMode::detect);
    EXPECT_TRUE(result.loop.closed) << maker.name;
    EXPECT_LT(seam_of(result.clip).worst, 2e-4f) << maker.name;
  }
}

TEST(RestyleLoop, loops_of_a_game_and_cycles_of_people_stay_loops) {
  const char* data = std::getenv("PANACHE_DATA");
  if (!data) GTEST_SKIP() << "PANACHE_DATA is not set: no real motion to read";
  const std::string folder = std::string(data) + "/";
  std::vector<Clip> loops;
  for (const char* name : {"Advanced", "Basic"}) {
    const auto file = read_motion(folder + "loops/kaykit_Med_Movement" + name + ".glb");
    ASSERT_TRUE(file.ok()) << file.error().message;
    for (size_t c = 0; c < (*file)->clip_names().size(); ++c) {
      const Clip& clip = (*file)->clip(static_cast<int>(c));
      if (is_loop(seam_of(clip), clip.frame_time)) loops.push_back(clip);
    }
  }
  EXPECT_EQ(loops.size(), 16u);  // All but T-poses, dodges, and the two halves of a jump.
  for (const auto& [name, first, last] : {std::tuple{"cmu/07_01", 79, 208},
                                          {"cmu/07_05", 179, 365},
                                          {"cmu/07_11", 149, 281},
                                          {"cmu/09_01", 47, 138},
                                          {"cmu/09_05", 36, 127},
                                          {"cmu/09_09", 38, 130},
                                          {"cmu/05_01", 179, 324},
                                          {"cmu-more/35_29", 40, 80}}) {
    const auto file = read_motion(folder + name + ".bvh");
    ASSERT_TRUE(file.ok()) << file.error().message;
    loops.push_back(cut((*file)->clip(), first, last));
    EXPECT_TRUE(is_loop(seam_of(loops.back()), loops.back().frame_time)) << name;
  }
  for (const Clip& loop : loops) {
    for (size_t s = 0; s < shipped_model()->styles().size(); s += 9) {
      const Restyled result =
          styled(loop, {static_cast<int>(s), {{0, 1}}}, LoopMode::detect, false);
      EXPECT_TRUE(result.loop.closed);
      EXPECT_LT(result.loop.spread, 0.005f);
      EXPECT_LT(seam_of(result.clip).worst, 1e-4f);
    }
  }
}

TEST(RestyleLoop, strength_zero_keeps_every_bit) {
  const Clip cycle = walk_cycle();
  for (const LoopMode mode : {LoopMode::detect, LoopMode::force}) {
    const Restyled same = styled(cycle, track("old", 0), mode);
    EXPECT_TRUE(is_unchanged(cycle, same));
    EXPECT_FALSE(same.loop.closed);
  }
  RestyleOptions nothing;
  nothing.stylizer.shape.strength = 0;
  EXPECT_TRUE(is_unchanged(
      cycle, *restyle(cycle, *Rig::create(cycle), shipped_model(), {track("old")}, nothing)));
}

TEST(RestyleLoop, what_is_no_loop_keeps_its_bits) {
  const Clip walk = walking_clip(46);
  const Restyled open = styled(walk, track("old"), LoopMode::off),
                 found = styled(walk, track("old"), LoopMode::detect);
  EXPECT_FALSE(found.loop.closed);
  EXPECT_EQ(found.clip.rotations, open.clip.rotations);
  EXPECT_EQ(found.clip.translations, open.clip.translations);
}

TEST(RestyleLoop, what_is_nearly_one_is_closed_where_that_is_wanted) {
  const Clip walk = walking_clip(35);  // Four frames more than a stride.
  EXPECT_FALSE(styled(walk, track("old"), LoopMode::detect).loop.closed);
  const Restyled forced = styled(walk, track("old"), LoopMode::force);
  EXPECT_TRUE(forced.loop.closed);
  EXPECT_GT(forced.loop.input_gap, 0.05f);
  EXPECT_LT(seam_of(forced.clip).worst, 1e-4f);
}

TEST(RestyleLoop, what_cannot_be_a_loop_says_why) {
  const auto message = [](const Clip& clip, const StrengthTrack& wanted) {
    RestyleOptions options;
    options.loop = LoopMode::force;
    const auto result = restyle(clip, *Rig::create(clip), shipped_model(), {wanted}, options);
    return result ? std::string() : result.error().message;
  };
  EXPECT_TRUE(message(walking_clip(39), track("old"))
                  .starts_with("the motion is not a loop: its last pose is "));
  StrengthTrack growing = track("old");
  growing.points = {{0, 0}, {1, 1}};
  EXPECT_EQ(message(walking_clip(31), growing),
            "the motion cannot be a loop: style 'old' has another strength at its last frame than "
            "at its first");
  EXPECT_FALSE(styled(walking_clip(31), growing, LoopMode::detect).loop.closed);
  growing.points = {{0, 0}, {0.5, 1}, {1, 0}};
  EXPECT_TRUE(styled(walking_clip(31), growing, LoopMode::detect).loop.closed);
}

TEST(RestyleLoop, a_calibration_pose_in_front_stays) {
  const Clip cycle = walking_clip(31);
  Clip clip{cycle.skeleton, cycle.frame_time, 0, {}, {}};
  clip.append(rest_clip(cycle.skeleton).pose(0));
  for (int f = 0; f < cycle.frames; ++f) clip.append(cycle.pose(f));
  ASSERT_EQ(Rig::create(clip)->first_frame(), 1);
  const Restyled result = styled(clip, track("old"), LoopMode::detect);
  EXPECT_TRUE(result.loop.closed);
  EXPECT_EQ(result.source_frames[0], 0);
  EXPECT_EQ(result.source_frames[1], 1);
  EXPECT_EQ(result.source_frames.back(), 31);
  EXPECT_TRUE(std::ranges::equal(result.clip.pose(0).rotations, clip.pose(0).rotations));
  EXPECT_LT(seam_of(result.clip).worst, 1e-4f);
}

TEST(RestyleFacts, tell_what_was_done) {
  const Clip cycle = walk_cycle();
  const Rig rig = *Rig::create(cycle);
  const RestyleFacts loop =
      restyle_facts(cycle, rig, styled(cycle, track("zombie"), LoopMode::detect));
  EXPECT_TRUE(loop.loop.closed);
  EXPECT_FALSE(loop.unchanged);
  EXPECT_GT(loop.planted, 0.7f);
  EXPECT_LT(loop.slide, 0.1f);
  EXPECT_GT(loop.known, 0.5f);
  EXPECT_EQ(loop.seated, 0);
  RestyleOptions free;
  free.stylizer.foot_lock = false;
  const RestyleFacts slides =
      restyle_facts(cycle, rig, *restyle(cycle, rig, shipped_model(), {track("zombie")}, free));
  EXPECT_GT(slides.slide, 2 * loop.slide);
  EXPECT_TRUE(
      restyle_facts(cycle, rig, styled(cycle, track("old", 0), LoopMode::detect)).unchanged);
}

}  // namespace
}  // namespace panache
