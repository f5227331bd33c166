#include "retarget/retarget.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "clip/clip.h"
#include "clip/motion_file.h"
#include "retarget/ground.h"
#include "retarget/on_characters.h"
#include "retarget/reference_pose.h"

namespace panache {
namespace {

using namespace test;
namespace fs = std::filesystem;
using enum HumanJoint;

// Short legs, long arms, a broad torso: a goblin.
Maker other_proportions() {
  Maker maker = makers().front();
  maker.legs = 0.6f;
  maker.arms = 1.3f;
  maker.torso = 1.15f;
  return maker;
}

// The takes of other makers, of which a few seconds each.
std::vector<Clip> real_motion() {
  std::vector<Clip> out;
  const char* data = std::getenv("PANACHE_DATA");
  if (!data) return out;
  for (const char* name : {"formats/cmu/05_02.bvh", "formats/cmu21/kick.bvh", "cmu/01_01.bvh",
                           "bandai-1/dataset-1_run_normal_001.bvh"}) {
    const auto file = read_motion((fs::path(data) / name).string());
    if (!file.ok()) continue;
    Clip clip = (*file)->clip();
    clip.resize(std::min(clip.frames, 400));
    out.push_back(std::move(clip));
  }
  return out;
}

// Two rigs that need more in deep bends: this one's arms hang on its neck and its legs on its
// spine,
constexpr const char* kArmsOnNeck = "3ds Max Biped";
constexpr double kArmsOnNeckDeg = 2.2;
// and this one has no toes. Where a dancer's foot is never flat, its direction is a guess.
constexpr const char* kNoToes = "Perception Neuron";
constexpr double kNoToesDeg = 5.1;

void expect_round_trips(const Clip& motion, double usual_deg) {
  const std::vector<BodyPose> want = bodies(motion);
  for (const Maker& maker : makers()) {
    const Clip there = put(motion, character_of(maker));
    const Clip back = put(there, motion);
    const Rig rig = *Rig::create(motion);
    const double on_it = mean_direction_deg(want, bodies(there), false);
    const double returned = mean_direction_deg(want, bodies(back, rig, 0));
    std::printf("%-18s there %.2f deg, and back %.2f deg\n", maker.name, on_it, returned);
    const double max_deg = maker.name == std::string(kArmsOnNeck) ? kArmsOnNeckDeg
                           : maker.name == std::string(kNoToes)   ? kNoToesDeg
                                                                  : usual_deg;
    EXPECT_LT(on_it, max_deg) << maker.name;
    EXPECT_LT(returned, max_deg) << maker.name;
  }
}

TEST(Retarget, a_walk_keeps_its_directions_on_every_makers_rig_and_back) {
  expect_round_trips(neutral_walk(), 2);
}

TEST(Retarget, real_motion_keeps_its_directions_on_every_makers_rig_and_back) {
  const std::vector<Clip> motions = real_motion();
  if (motions.empty()) GTEST_SKIP() << "PANACHE_DATA is not set: no real motion to read";
  for (const Clip& motion : motions) expect_round_trips(motion, 2);
}

void expect_grounded(const Clip& motion, const Maker& maker, double more = 1.01) {
  const Clip character = character_of(maker);
  const Clip out = put(motion, character);
  const Rig rig = *Rig::create(motion), onto = *Rig::create(character);
  const std::vector<BodyPose> from = bodies(motion, rig, std::min(rig.first_frame(), 1));
  const std::vector<BodyPose> there = bodies(out, onto, 0);
  const std::vector<FootContacts> contacts = contacts_of(from, motion.frame_time);
  BodyPose rest;
  PosedRig(onto).read(character.pose(0), rest);
  float deepest = 0;
  for (const BodyPose& body : there)
    deepest = std::max(deepest, lowest_toe(rest) - lowest_toe(body));
  const double before = slide(from, contacts, motion.frame_time);
  const double after = slide(there, contacts, motion.frame_time);
  std::printf("%-18s slides %.1f cm/s, in the motion %.1f; deepest toe %.2f mm\n", maker.name,
              100 * after, 100 * before, 1000 * static_cast<double>(deepest));
  // As far as floats go: the same places, scaled.
  EXPECT_LE(after, more * before + 1e-4) << maker.name;
  // A rig whose legs hang on its spine is followed by another chain than the humanoid's.
  EXPECT_LT(deepest, 1e-3f) << maker.name;
}

TEST(Retarget, feet_slide_no_more_than_in_the_motion_and_no_toe_is_under_the_floor) {
  // The walker's knees are nearly straight as it lands and lifts a foot: legs that are short beside
  // their feet do not reach as far, and the foot follows by 3 mm/s.
  expect_grounded(neutral_walk(), other_proportions(), 1.25);
  for (const Maker& maker : makers()) expect_grounded(neutral_walk(), maker);
}

TEST(Retarget, feet_of_real_motion_keep_to_the_floor_of_another_body) {
  const std::vector<Clip> motions = real_motion();
  if (motions.empty()) GTEST_SKIP() << "PANACHE_DATA is not set: no real motion to read";
  for (const Clip& motion : motions) {
    for (const Maker& maker : {other_proportions(), makers()[1], makers()[3]}) {
      expect_grounded(motion, maker);
    }
  }
}

TEST(Retarget, units_axes_and_heading_of_the_character_make_no_difference) {
  const Clip motion = neutral_walk(2);
  const std::vector<BodyPose> want = bodies(put(motion, character_of(makers().front())));
  for (const double units : {1.0, 39.37}) {
    for (const bool z_up : {false, true}) {
      const Clip character = character_of(makers().front(), 0, units, z_up);
      const std::vector<BodyPose> got = bodies(put(motion, character));
      EXPECT_LT(mean_direction_deg(want, got), 0.01) << units << z_up;
      for (size_t f = 0; f < want.size(); ++f) {
        EXPECT_LT(length(got[f].positions[0] - want[f].positions[0]), 1e-3f) << units << z_up;
      }
    }
  }
}

// Twenty frames of the canonical body in T-pose.
Clip still() {
  const Clip rest = rest_clip(canonical_skeleton());
  Clip out = rest;
  while (out.frames < 20) out.append(rest.pose(0));
  out.frame_time = 1.0 / 30;
  return out;
}

// On one leg, the other thigh raised and the knee bent.
Clip stork(bool on_left) {
  Clip out = still();
  for (int f = 0; f < out.frames; ++f) {
    const Pose pose = out.pose(f);
    pose.rotations[index(on_left ? right_upper_leg : left_upper_leg)] =
        axis_angle({1, 0, 0}, -1.2f);
    pose.rotations[index(on_left ? right_lower_leg : left_lower_leg)] = axis_angle({1, 0, 0}, 1.4f);
  }
  return out;
}

TEST(Retarget, who_stands_on_one_leg_stands_as_straight_on_another_body) {
  const Clip character = character_of(other_proportions());
  const Rig onto = *Rig::create(character);
  for (const bool on_left : {false, true}) {
    const Clip motion = stork(on_left);
    const std::vector<BodyPose> want = bodies(motion);
    const std::vector<BodyPose> got = bodies(put(motion, character), onto, 0);
    EXPECT_LT(mean_direction_deg(want, got), 0.1) << on_left;
    EXPECT_NEAR(lowest_toe(got[10]), 0, 1e-3f);
  }
}

// Legs that rest astride, on the canonical body.
Clip astride(float left, float right) {
  Clip out{canonical_skeleton(), 1.0 / 30, 0, {}, {}};
  const auto spread = [&](HumanJoint upper, float angle) {
    const Quat by = axis_angle({0, 0, 1}, angle);
    for (int j = index(upper) + 1; j <= index(upper) + 2; ++j) {
      Vec3& offset = out.skeleton.joints[j].offset;
      offset = rotate(by, offset);
    }
  };
  spread(left_upper_leg, left);
  spread(right_upper_leg, -right);
  return rest_clip(out.skeleton);
}

TEST(Retarget, legs_that_rest_astride_walk_side_by_side) {
  const Clip motion = neutral_walk(2);
  const std::vector<BodyPose> want = bodies(motion);
  for (const auto& [left, right] :
       {std::pair(0.3f, 0.3f), std::pair(0.3f, 0.0f), std::pair(0.0f, 0.3f)}) {
    const Clip character = astride(left, right);
    const Rig onto = *Rig::create(character);
    const std::vector<BodyPose> got = bodies(put(motion, character), onto, 0);
    EXPECT_LT(mean_direction_deg(want, got, false), 0.1) << left << ", " << right;
  }
}

// Arms stretched ahead, wrists together.
Clip clap() {
  Clip out = still();
  for (int f = 0; f < out.frames; ++f) {
    // In T-pose shoulders are 17 cm from the middle and arms some 50 cm long.
    const float in = 1.5708f + 0.33f * static_cast<float>(f) / 19;
    out.pose(f).rotations[index(left_upper_arm)] = rotation_y(-in);
    out.pose(f).rotations[index(right_upper_arm)] = rotation_y(in);
  }
  return out;
}

double wrists_apart(const BodyPose& body) {
  return static_cast<double>(
      length(body.joints[index(left_hand)] - body.joints[index(right_hand)]));
}

TEST(Retarget, hands_that_meet_meet_on_longer_arms) {
  Maker maker = other_proportions();
  const Clip character = character_of(maker);
  const Rig onto = *Rig::create(character);
  const BodyPose from = bodies(clap()).back();
  const BodyPose met = bodies(put(clap(), character), onto, 0).back();
  const BodyPose missed = bodies(put(clap(), character, {true, false}), onto, 0).back();
  ASSERT_LT(wrists_apart(from), 0.12);
  EXPECT_GT(wrists_apart(missed), 0.2);
  // As far in lengths of an arm, and the rig scales short legs up to ours.
  const double ratio = 1.3 / 0.6;
  EXPECT_NEAR(wrists_apart(met), wrists_apart(from) * ratio, 0.01);
}

// Turns one joint of every frame by `turn` in its own axes.
void turn_joint(Clip& clip, const std::string& name, Quat turn) {
  for (size_t j = 0; j < clip.joints(); ++j) {
    if (clip.skeleton.joints[j].name != name) continue;
    for (int f = 0; f < clip.frames; ++f) {
      clip.pose(f).rotations[j] = normalized(clip.pose(f).rotations[j] * turn);
    }
  }
}

// The angle of a joint against its rest, degrees.
double bent_deg(const Clip& clip, const std::string& name) {
  for (size_t j = 0; j < clip.joints(); ++j) {
    const Joint& joint = clip.skeleton.joints[j];
    if (joint.name != name) continue;
    const Quat off = conjugate(joint.rest) * clip.pose(clip.frames - 1).rotations[j];
    return static_cast<double>(length(log_rotation(off))) * 180 / 3.14159265;
  }
  ADD_FAILURE() << "no joint " << name;
  return 0;
}

TEST(Retarget, fingers_bend_as_in_the_motion_where_both_rigs_have_them) {
  Clip motion = put_on(makers()[0], neutral_walk(1)).clip;  // Mixamo.
  turn_joint(motion, "mixamorig5:LeftHandIndex1", exp_rotation(Vec3{0, 0, -0.7f}));
  turn_joint(motion, "mixamorig5:LeftHandThumb1", exp_rotation(Vec3{0, 0.5f, 0}));
  const Clip on_unreal = put(motion, character_of(makers()[1]));
  EXPECT_NEAR(bent_deg(on_unreal, "index_01_l"), 0.7 * 180 / 3.14159265, 0.1);
  EXPECT_NEAR(bent_deg(on_unreal, "index_01_r"), 0, 0.1);
  const Clip back = put(on_unreal, rest_clip(motion.skeleton));
  EXPECT_NEAR(bent_deg(back, "mixamorig5:LeftHandIndex1"), 0.7 * 180 / 3.14159265, 0.1);
  EXPECT_NEAR(bent_deg(back, "mixamorig5:LeftHandThumb1"), 0, 1e-3) << "Unreal here has no thumb";
}

TEST(Retarget, twist_joints_follow_those_of_the_motion_and_rest_without) {
  Clip motion = put_on(makers()[1], neutral_walk(1)).clip;  // Unreal 4.
  turn_joint(motion, "lowerarm_twist_01_l", exp_rotation(Vec3{0.6f, 0, 0}));
  const Clip same = put(motion, rest_clip(motion.skeleton));
  EXPECT_NEAR(bent_deg(same, "lowerarm_twist_01_l"), 0.6 * 180 / 3.14159265, 0.1);
  const Clip other = put(neutral_walk(1), rest_clip(motion.skeleton));
  EXPECT_LT(bent_deg(other, "lowerarm_twist_01_l"), 1e-3);
}

TEST(Retarget, twist_joints_of_the_hips_follow_too) {
  Clip motion = neutral_walk(1);
  Skeleton with_twist = motion.skeleton;
  Joint twist;
  twist.name = "hips_twist";
  twist.parent = 0;
  twist.offset = {0, 0.05f, 0};
  twist.can_rotate = true;
  with_twist.joints.push_back(twist);
  Clip twisted{with_twist, motion.frame_time, 0, {}, {}};
  for (int f = 0; f < motion.frames; ++f) {
    std::vector<Quat> rotations(motion.pose(f).rotations.begin(), motion.pose(f).rotations.end());
    std::vector<Vec3> translations(motion.pose(f).translations.begin(),
                                   motion.pose(f).translations.end());
    rotations.push_back(axis_angle(Vec3{0, 1, 0}, 0.6f));
    translations.push_back(twist.offset);
    twisted.append({rotations, translations});
  }
  const Clip same = put(twisted, rest_clip(with_twist));
  EXPECT_NEAR(bent_deg(same, "hips_twist"), 0.6 * 180 / 3.14159265, 0.1);
}

TEST(Retarget, a_motion_on_its_own_rig_is_itself) {
  for (const size_t which : {0u, 1u, 10u}) {
    const Clip motion = put_on(makers()[which], neutral_walk(2)).clip;
    const Clip same = put(motion, rest_clip(motion.skeleton), {false, false});
    ASSERT_EQ(same.frames, motion.frames);
    EXPECT_LT(mean_direction_deg(bodies(motion), bodies(same)), 0.1) << makers()[which].name;
  }
}

// The lowest that a toe comes in the file's own space, Y up.
float lowest_toe(const Clip& clip) {
  Clip world = clip;
  float low = INFINITY;
  for (int f = 0; f < clip.frames; ++f) {
    world_pose(clip.skeleton, clip.pose(f), world.pose(f));
    for (const HumanJoint toe : kToes) {
      low = std::min(low, world.pose(f).translations[index(toe)].y);
    }
  }
  return low;
}

// With its hips at the origin, as in many BVH files, a rest pose does not tell where the floor is.
TEST(Retarget, a_character_that_rests_under_the_floor_stands_where_its_own_motion_stands) {
  Clip character = rest_clip(canonical_skeleton());
  const float hips_up = character.skeleton.joints[0].offset.y - lowest_toe(character);
  character.skeleton.joints[0].offset = {};
  character.pose(0).translations[0] = {0, hips_up + 0.3f, 0};
  const Clip motion = neutral_walk(1);
  // One pose is no motion: there is the plane of the origin.
  EXPECT_NEAR(lowest_toe(put(motion, character)), 0, 1e-3f);
  character.append(character.pose(0));
  EXPECT_NEAR(lowest_toe(put(motion, character)), 0.3f, 1e-3f);
}

TEST(FindBody, a_rest_pose_that_stands_tells_the_floor_whatever_its_motion) {
  const Clip rest = rest_clip(canonical_skeleton());
  Clip on_a_box = neutral_walk(1);
  for (int f = 0; f < on_a_box.frames; ++f) on_a_box.pose(f).translations[0].y += 0.5f;
  const auto body = find_body(rest, &on_a_box, {});
  ASSERT_TRUE(body.ok()) << body.error().message;
  EXPECT_NEAR(body->second.floor(), 0, 0.05f);
}

TEST(HoldFeet, a_body_comes_up_and_goes_down_smoothly_around_where_it_would_be_under_the_floor) {
  const Clip rest = rest_clip(canonical_skeleton());
  const BodyPose body = bodies(rest)[0];
  // In one frame the hips are so far under the floor that no leg reaches up to it.
  constexpr int kDeep = 30;
  std::vector<GroundedFrame> frames(60);
  for (GroundedFrame& frame : frames) {
    for (int foot = 0; foot < kFeet; ++foot) frame.toes[foot] = body.joints[index(kToes[foot])];
  }
  frames[kDeep].change.translation.y = -2.5f;
  hold_feet(body, 1.0f / 30, frames);
  const auto lift = [&](int f) {
    return frames[static_cast<size_t>(f)].change.translation.y + (f == kDeep ? 2.5f : 0.0f);
  };
  EXPECT_GT(lift(kDeep), 0.8f);
  EXPECT_EQ(lift(kDeep - 10), 0);
  for (int f = 1; f < 60; ++f) {
    EXPECT_LT(std::abs(lift(f) - lift(f - 1)), 0.25f * lift(kDeep)) << f;
    EXPECT_NEAR(lift(f), lift(2 * kDeep - f), 1e-5f) << f;
  }
}

TEST(TPoseBody, has_the_limbs_of_its_rig_and_stands_on_the_floor) {
  Maker maker = makers().front();
  maker.legs = 0.8f;
  maker.arms = 1.2f;
  const Clip character = character_of(maker);
  const Clip body = t_pose_body(character, *Rig::create(character));
  const HumanPositions want = maker_body(maker);
  std::vector<Vec3> positions;
  for (const Joint& joint : body.skeleton.joints) {
    positions.push_back(joint.offset + (joint.parent < 0 ? Vec3{} : positions[joint.parent]));
  }
  for (int j = 0; j < kHumanJoints; ++j) {
    EXPECT_EQ(body.skeleton.joints[j].name, human_joint_name(j));
    EXPECT_EQ(body.skeleton.joints[j].role, human_joint_name(j));
    const Vec3 other = positions[kHumanMirror[j]];
    EXPECT_LT(length(positions[j] - Vec3{-other.x, other.y, other.z}), 1e-5f)
        << human_joint_name(j);
  }
  for (const HumanJoint joint : {left_lower_arm, left_hand, left_lower_leg, left_foot}) {
    const int j = index(joint), above = kHumanParent[j];
    EXPECT_LT(length(positions[j] - positions[above] - (want[j] - want[above])), 1e-4f)
        << human_joint_name(j);
  }
  EXPECT_NEAR(positions[index(left_toes)].y, 0, 1e-5f);
  EXPECT_TRUE(body.skeleton.joints[0].can_translate);
  // Thumbs point half ahead, fingers along the arm.
  for (const Joint& joint : body.skeleton.joints) {
    if (joint.name == "leftThumbProximal") {
      EXPECT_NEAR(joint.offset.z, joint.offset.x, 1e-6f);
    }
    if (joint.name == "leftIndexIntermediate") {
      EXPECT_EQ(joint.offset.z, 0);
    }
  }
  for (const char* finger : {"Thumb", "Index"}) {
    for (const std::string side : {"left", "right"}) {
      EXPECT_EQ(std::count_if(body.skeleton.joints.begin(), body.skeleton.joints.end(),
                              [&](const Joint& j) { return j.name.starts_with(side + finger); }),
                3)
          << side << finger;
    }
  }
}

TEST(Retarget, a_character_that_cannot_move_is_rejected) {
  Clip character = character_of(makers().front());
  for (Joint& joint : character.skeleton.joints) joint.can_translate = false;
  const Clip motion = neutral_walk(1);
  const Result<Retargeted> out =
      retarget(motion, *Rig::create(motion), character, *Rig::create(character));
  ASSERT_FALSE(out.ok());
  EXPECT_EQ(out.error().message,
            "neither the hips of the character nor a joint above them can move; expected "
            "translation channels at one of them");
}

}  // namespace
}  // namespace panache
