#include "walker/walker.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "clip/clip.h"
#include "count_allocations.h"
#include "pose/contacts.h"
#include "rig/canonical_body.h"
#include "rig/rig.h"
#include "walker/feet.h"
#include "walker/made_up_gait.h"

namespace panache {
namespace {

constexpr float kDegree = std::numbers::pi_v<float> / 180;

std::shared_ptr<const WalkerModel> shipped() {
  static const auto model = WalkerModel::load(PANACHE_SOURCE_DIR "/models/walker.safetensors");
  EXPECT_TRUE(model.ok()) << (model.ok() ? "" : model.error().message);
  return *model;
}

struct Joints {
  std::array<Quat, kHumanJoints> rotations;
  std::array<Vec3, kHumanJoints> translations;
  operator Pose() { return {rotations, translations}; }
};

HumanPositions positions_of(Joints& local) {
  static const Skeleton skeleton = canonical_skeleton();
  Joints world;
  world_pose(skeleton, Pose(local), world);
  return world.translations;
}

// Someone who is steered, and what was seen of her.
struct Recording {
  std::vector<HumanPositions> frames;
  double fps;
};
const auto kStand = [](double) { return std::pair{0.0f, 0.0f}; };

template <class Steer>
Recording watch(Walker& walker, double seconds, double fps, Steer steer) {
  Recording seen{{}, fps};
  Joints joints;
  for (int f = 0; f < seconds * fps; ++f) {
    const auto [speed, turn] = steer(f / fps);
    walker.step(speed, turn, 1 / fps, joints);
    seen.frames.push_back(positions_of(joints));
  }
  return seen;
}
Recording watch_steady(float speed, float turn_deg, double seconds = 6, double fps = 120) {
  Walker walker(shipped());
  const auto steady = [&](double) { return std::pair{speed, turn_deg * kDegree}; };
  watch(walker, 5, 60, steady);
  return watch(walker, seconds, fps, steady);
}

// Mean horizontal speed of the toes that are on the ground, m/s.
float skate(const Recording& seen) {
  double distance = 0;
  int moves = 0;
  for (size_t f = 1; f < seen.frames.size(); ++f) {
    for (const HumanJoint toe : kToes) {
      const Vec3 a = seen.frames[f - 1][index(toe)], b = seen.frames[f][index(toe)];
      if (a.y > 0.002f || b.y > 0.002f) continue;
      distance += static_cast<double>(std::hypot(b.x - a.x, b.z - a.z));
      ++moves;
    }
  }
  return static_cast<float>(distance * seen.fps / std::max(moves, 1));
}

// Largest third difference of a joint's positions at 30 frames a second, m/s^3.
float largest_jerk(const Recording& seen) {
  const size_t h = static_cast<size_t>(seen.fps / 30);
  float max = 0;
  for (size_t f = 0; f + 3 * h < seen.frames.size(); ++f) {
    for (int j = 0; j < kHumanJoints; ++j) {
      const auto at = [&](size_t k) { return seen.frames[f + k * h][j]; };
      const Vec3 third = at(3) - at(2) * 3.0f + at(1) * 3.0f - at(0);
      max = std::max(max, length(third) * 27000);
    }
  }
  return max;
}

TEST(Walker, goes_as_far_as_its_speed_says) {
  for (const float speed : {0.3f, 0.8f, 1.4f, 1.9f, 3.0f, 4.5f}) {
    const Recording seen = watch_steady(speed, 0);
    const Vec3 travel = seen.frames.back()[0] - seen.frames.front()[0];
    const float seconds = static_cast<float>((seen.frames.size() - 1) / seen.fps);
    EXPECT_NEAR(std::hypot(travel.x, travel.z), speed * seconds, 0.05f * speed * seconds) << speed;
  }
}

TEST(Walker, turns_as_fast_as_asked) {
  for (const auto& [speed, turn] : {std::pair{0.0f, 60.0f}, std::pair{1.1f, 60.0f},
                                    std::pair{1.1f, -90.0f}, std::pair{3.0f, -40.0f}}) {
    Walker walker(shipped());
    const auto steady = [&, s = speed, t = turn](double) { return std::pair{s, t * kDegree}; };
    watch(walker, 5, 60, steady);
    const float begin = walker.root().facing;
    const Recording seen = watch(walker, 4, 60, steady);
    EXPECT_NEAR(walker.root().facing - begin, 4 * turn * kDegree,
                0.05f * 4 * std::abs(turn) * kDegree);
    // The body turns with its path.
    const HumanPositions& last = seen.frames.back();
    const Vec3 left =
        last[index(HumanJoint::left_upper_leg)] - last[index(HumanJoint::right_upper_leg)];
    EXPECT_GT(dot(normalized(left), rotate(rotation_y(walker.root().facing), Vec3{1, 0, 0})), 0.9f);
  }
}

TEST(Walker, plants_its_feet) {
  for (const auto& [speed, turn] :
       {std::pair{0.0f, 60.0f}, std::pair{0.3f, 0.0f}, std::pair{0.8f, 0.0f}, std::pair{1.4f, 0.0f},
        std::pair{1.1f, 60.0f}, std::pair{1.9f, 0.0f}, std::pair{3.0f, 0.0f},
        std::pair{3.0f, 40.0f}, std::pair{4.3f, 0.0f}}) {
    const Recording seen = watch_steady(speed, turn);
    EXPECT_LT(skate(seen), 0.1f) << speed << " m/s, " << turn << " degrees/s";
    float lowest = 1, ankles = 1;
    for (const HumanPositions& frame : seen.frames) {
      for (const HumanJoint toe : kToes) lowest = std::min(lowest, frame[index(toe)].y);
      for (const HumanJoint ankle : kAnkles) ankles = std::min(ankles, frame[index(ankle)].y);
    }
    EXPECT_NEAR(lowest, 0, 0.002f) << speed;  // Neither sinks nor floats.
    EXPECT_GT(ankles, 0.03f) << speed;
  }
}

TEST(Walker, walks_with_a_foot_down_and_runs_with_flights) {
  const auto air = [](const Recording& seen) {
    int flying = 0;
    for (const HumanPositions& frame : seen.frames) {
      flying += std::min(frame[index(kToes[0])].y, frame[index(kToes[1])].y) > 0.03f;
    }
    return static_cast<double>(flying) / static_cast<double>(seen.frames.size());
  };
  EXPECT_LT(air(watch_steady(1.2f, 0)), 0.02);
  EXPECT_GT(air(watch_steady(3.0f, 0)), 0.25);
}

TEST(Walker, swings_its_arms_against_its_legs) {
  const Recording seen = watch_steady(1.2f, 0);
  double sum = 0;
  for (const HumanPositions& frame : seen.frames) {
    const auto ahead = [&](HumanJoint left, HumanJoint right) {
      return static_cast<double>(frame[index(left)].z - frame[index(right)].z);
    };
    sum += ahead(HumanJoint::left_hand, HumanJoint::right_hand) *
           ahead(HumanJoint::left_foot, HumanJoint::right_foot);
  }
  // Amplitudes of hands and feet are about 0.4 and 0.6 m: opposite sines would give -0.12.
  EXPECT_LT(sum / static_cast<double>(seen.frames.size()), -0.05);
}

TEST(Walker, moves_the_same_at_any_rate) {
  const auto steer = [](double t) {
    return t < 4 ? std::pair{1.3f, 0.3f} : t < 8 ? std::pair{3.2f, -0.5f} : std::pair{0.0f, 0.0f};
  };
  const auto at = [&](double fps) {
    Walker walker(shipped());
    return watch(walker, 12, fps, steer).frames;
  };
  const auto fine = at(120), coarse = at(24);
  // Frame i of any rate ends at (i + 1) / fps. The changes of the wish come at whole seconds, one
  // step later at a lower rate: up to 1/24 s of easing apart.
  for (size_t f = 0; f < coarse.size(); ++f) {
    for (int j = 0; j < kHumanJoints; ++j) {
      const double seconds = static_cast<double>(f + 1) / 24;
      if (seconds < 4) {  // Before the first change only rounding differs.
        EXPECT_LT(length(coarse[f][j] - fine[5 * f + 4][j]), 1e-3f) << seconds;
      }
      EXPECT_LT(length(coarse[f][j] - fine[5 * f + 4][j]), 0.25f) << seconds;
    }
  }
  // At 50 a second poses fall between those of 120.
  for (const double fps : {50.0, 60.0}) {
    const auto between = at(fps);
    for (size_t f = 0; f < 4 * static_cast<size_t>(fps) - 1; ++f) {
      const double frame = static_cast<double>(f + 1) * 120 / fps - 1;
      const size_t a = static_cast<size_t>(frame);
      for (int j = 0; j < kHumanJoints; ++j) {
        const Vec3 expected =
            lerp(fine[a][j], fine[a + 1][j], static_cast<float>(frame - static_cast<double>(a)));
        EXPECT_LT(length(between[f][j] - expected), 1e-3f) << fps << " fps, " << f;
      }
    }
  }
}

TEST(Walker, stands_still_and_breathes) {
  Walker walker(shipped());
  const Recording seen = watch(walker, 20, 60, kStand);
  float min = 1, max = -1;
  for (const HumanPositions& frame : seen.frames) {
    for (const HumanJoint toe : kToes) {
      EXPECT_LT(length(frame[index(toe)] - seen.frames[0][index(toe)]), 0.001f);
    }
    min = std::min(min, frame[index(HumanJoint::hips)].x);
    max = std::max(max, frame[index(HumanJoint::hips)].x);
  }
  EXPECT_GT(max - min, 0.005f);  // Alive,
  EXPECT_LT(max - min, 0.06f);   // and calm.
}

float higher_left(const HumanPositions& frame, HumanJoint left, HumanJoint right) {
  return frame[index(left)].y - frame[index(right)].y;
}

TEST(Walker, standing_hips_tilt_with_the_weight_and_shoulders_stay_level) {
  Walker walker(shipped());
  const Recording seen = watch(walker, 60, 30, kStand);
  const auto bent = [](const HumanPositions& body) {
    return body[index(HumanJoint::chest)].z - body[index(HumanJoint::hips)].z;
  };
  float max = 0;
  for (const HumanPositions& frame : seen.frames) {
    const float side = frame[index(HumanJoint::hips)].x;
    const float hip = higher_left(frame, HumanJoint::left_upper_leg, HumanJoint::right_upper_leg);
    // The hip over the foot that carries is the higher one.
    if (std::abs(side) > 0.005f) {
      EXPECT_GT(hip * side, 0);
    }
    max = std::max(max, std::abs(hip));
    EXPECT_NEAR(higher_left(frame, HumanJoint::left_upper_arm, HumanJoint::right_upper_arm), 0,
                0.002f);
    EXPECT_NEAR(bent(frame), bent(seen.frames[0]), 0.001f);  // Nobody nods.
  }
  EXPECT_GT(max, 0.003f);
}

TEST(Walker, who_turns_on_the_spot_has_her_weight_on_both_feet_in_turn) {
  Walker walker(shipped());
  watch(walker, 5, 60, [](double) { return std::pair{0.0f, 1.0f}; });
  for (int part = 0; part < 20; ++part) {
    // Three seconds, which are several steps.
    float mean = 0;
    Joints joints;
    for (int f = 0; f < 180; ++f) {
      walker.step(0, 1, 1.0 / 60, joints);
      const RootPose root = walker.root();
      mean += rotate(rotation_y(-root.facing), joints.translations[0] - root.position).x / 180;
    }
    EXPECT_NEAR(mean, 0, 0.005f) << part;
  }
}

TEST(Walker, starts_and_comes_to_stand_under_its_body) {
  for (const float speed : {0.4f, 1.2f, 3.0f, 4.5f}) {
    Walker walker(shipped());
    const Recording start = watch(walker, 5, 120, [&](double t) {
      return std::pair{t < 0.5 ? 0.0f : speed, 0.0f};
    });
    const Recording stop = watch(walker, 6, 120, kStand);
    // Real takes have up to 2,200 m/s^3 in walks and 4,900 in runs.
    EXPECT_LT(largest_jerk(start), speed < 2 ? 2200 : 4900) << speed;
    EXPECT_LT(largest_jerk(stop), speed < 2 ? 2200 : 4900) << speed;
    const HumanPositions& last = stop.frames.back();
    const HumanPositions& before = stop.frames[stop.frames.size() - 60];
    const Vec3 hips = last[index(HumanJoint::hips)];
    for (const HumanJoint toe : kToes) {
      EXPECT_LT(length(last[index(toe)] - before[index(toe)]), 0.001f) << speed;
      EXPECT_LT(std::hypot(last[index(toe)].x - hips.x, last[index(toe)].z - hips.z), 0.25f);
    }
  }
}

TEST(Walker, never_pops_when_steered_wildly) {
  Walker walker(shipped());
  unsigned seed = 1;
  const auto random = [&] {
    seed = seed * 1664525u + 1013904223u;
    return static_cast<float>(seed >> 8) / 16777216.0f;
  };
  float speed = 0, turn = 0;
  int last = -1;
  const Recording seen = watch(walker, 60, 120, [&](double t) {
    if (const int now = static_cast<int>(t / 0.75); now != last) {
      last = now;
      speed = random() < 0.3f ? 0 : random() * kMaxWalkerSpeed;
      turn = random() < 0.3f ? 0 : (random() - 0.5f) * 4;
    }
    return std::pair{speed, turn};
  });
  float fastest = 0;
  for (size_t f = 1; f < seen.frames.size(); ++f) {
    for (int j = 0; j < kHumanJoints; ++j) {
      fastest = std::max(fastest, length(seen.frames[f][j] - seen.frames[f - 1][j]) * 120);
    }
  }
  // A real dash has 10 m/s and 4,900 m/s^3; nobody real was steered like this, nor did the
  // performers of these walks turn.
  EXPECT_LT(fastest, 13) << "seed 1";
  EXPECT_LT(largest_jerk(seen), 7500) << "seed 1";
}

TEST(Walker, allocates_nothing) {
  Walker walker(shipped());
  Joints joints;
  const long before = test::allocations;
  for (int f = 0; f < 1000; ++f) {
    walker.step(f < 700 ? 0.005f * static_cast<float>(f) : 0.0f, f % 300 < 150 ? 0.5f : -0.5f,
                1.0 / 60, joints);
    if (f == 900) walker.reset();
  }
  EXPECT_EQ(test::allocations, before);
}

TEST(Walker, stays_finite_whatever_it_is_told) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  for (const std::shared_ptr<const WalkerModel>& model :
       {shipped(), std::make_shared<const WalkerModel>(test::made_up_walker())}) {
    Walker walker(model);
    Joints joints;
    for (const float speed : {1.2f, nan, infinity, -infinity, -3.0f, 1e30f, 2.0f}) {
      for (const float turn : {0.0f, nan, infinity, -1e30f, 0.3f}) {
        for (const double seconds : {1.0 / 30, 0.0, -1.0, 1e9, double(nan), double(infinity)}) {
          walker.step(speed, turn, seconds, joints);
          for (int j = 0; j < kHumanJoints; ++j) {
            ASSERT_TRUE(is_finite(joints.rotations[j]) && is_finite(joints.translations[j]));
            ASSERT_NEAR(dot(joints.rotations[j], joints.rotations[j]), 1, 1e-4f);
          }
        }
      }
    }
  }
}

TEST(Walker, moves_from_the_first_moment_on) {
  Walker walker(shipped());
  Joints start, soon;
  walker.step(1, 0, 0, start);
  walker.step(1, 0, 1.0 / 1000, soon);
  EXPECT_NE(start.translations[0], soon.translations[0]);
}

TEST(Walker, begins_anew_after_reset) {
  Walker walker(shipped());
  Joints first, again;
  walker.step(1, 0, 0, first);
  watch(walker, 3, 60, [](double) { return std::pair{1.0f, 0.5f}; });
  walker.reset();
  walker.step(1, 0, 0, again);
  EXPECT_EQ(first.rotations, again.rotations);
  EXPECT_EQ(first.translations, again.translations);
}

TEST(Feet, trail_behind_a_body_that_is_carried_away_by_less_than_half_a_metre) {
  constexpr Vec3 kThigh{0, -0.42f, 0.02f}, kShin{0, -0.42f, -0.02f}, kSole{0, -0.06f, 0.13f};
  Feet feet;
  for (int f = 0; f <= 100; ++f) {
    const Vec3 hip{0, 0.9f, 0.02f * static_cast<float>(f)};
    Leg standing;
    standing.hip = hip;
    standing.knee = standing.hip + kThigh;
    standing.ankle = standing.knee + kShin;
    standing.toe = standing.ankle + kSole;
    Legs legs = {standing, standing};
    feet.tick(Drive(), {}, 0, 1 / 120.0f, legs);
    const Leg& leg = legs[0];
    const Vec3 toe =
        hip + rotate(leg.upper, kThigh) + rotate(leg.lower, kShin) + rotate(leg.foot, kSole);
    EXPECT_LT(standing.toe.z - toe.z, 0.5f) << f;
  }
}

TEST(WalkClip, maps_onto_the_canonical_body_with_all_joints) {
  WalkClipOptions options;
  options.seconds = 3;
  const Clip clip = walk_clip(shipped(), options);
  EXPECT_EQ(clip.frames, 180);
  EXPECT_NEAR(clip.pose(0).translations[0].z, 0, 0.1f);
  Result<Rig> rig = Rig::create(clip);
  ASSERT_TRUE(rig.ok()) << rig.error().message;
  for (int j = 0; j < kHumanJoints; ++j) EXPECT_EQ(rig->joints()[j], j);
  EXPECT_NEAR(rig->scale(), 1, 0.02f);
  EXPECT_EQ(rig->first_frame(), 0);
}

TEST(WalkClip, starts_and_ends_standing_if_asked) {
  for (const float speed : {1.4f, 4.5f}) {
    WalkClipOptions options;
    options.seconds = 10;
    options.speed = speed;
    options.start = options.stop = true;
    const Clip clip = walk_clip(shipped(), options);
    const auto moved = [&](int a, int b) {
      return length(clip.pose(b).translations[0] - clip.pose(a).translations[0]);
    };
    EXPECT_LT(moved(0, 20), 0.01f);
    EXPECT_GT(moved(60, clip.frames - 1), 3 * speed);
    EXPECT_LT(moved(clip.frames - 10, clip.frames - 1), 0.01f) << speed;
  }
}

}  // namespace
}  // namespace panache
