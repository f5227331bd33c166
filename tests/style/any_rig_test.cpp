// One motion on the rigs of twelve makers: styled there, it is the motion styled on our own body.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

#include "clip/motion_file.h"
#include "rig/put_on.h"
#include "rig/rig_checks.h"
#include "style/restyle.h"
#include "style_checks.h"

namespace panache {
namespace {

using namespace test;
namespace fs = std::filesystem;

Clip walk() {
  WalkClipOptions options;
  options.seconds = 4;
  options.fps = 30;
  options.turn = 0.3f;
  return walk_clip(*WalkerModel::load(PANACHE_SOURCE_DIR "/models/walker.safetensors"), options);
}

// A clip's motion on the canonical skeleton.
Clip on_canonical_body(const Clip& clip, int max_frames) {
  PosedRig rig(*Rig::create(clip));
  Clip out{canonical_skeleton(), clip.frame_time, 0, {}, {}};
  for (int f = rig.rig().first_frame(); f < std::min(clip.frames, max_frames); ++f) {
    BodyPose body;
    rig.read(clip.pose(f), body);
    std::array<Quat, kHumanJoints> world;
    canonical_frames(body.positions, body.facing, world);
    out.resize(out.frames + 1);
    const Pose pose = out.pose(out.frames - 1);
    for (int j = 0; j < kHumanJoints; ++j) {
      const int parent = kHumanParent[j];
      pose.rotations[j] = parent < 0 ? world[j] : normalized(conjugate(world[parent]) * world[j]);
      pose.translations[j] = parent < 0 ? body.positions[0] : out.skeleton.joints[j].offset;
    }
  }
  return out;
}

std::vector<HumanPositions> styled(const Clip& clip, const std::string& style, float strength,
                                   bool timing = false) {
  const auto model = shipped_model();
  const Result<Rig> rig = Rig::create(clip);
  EXPECT_TRUE(rig.ok()) << rig.error().message;
  RestyleOptions options;
  options.timing = timing;
  options.stylizer.gesture_rate = 0;  // Another rig may start one in another frame.
  const StrengthTrack track = {*model->find_style(style), {{0, strength}}};
  const Result<Restyled> restyled = restyle(clip, *rig, model, {track}, options);
  EXPECT_TRUE(restyled.ok());
  std::vector<HumanPositions> out;
  PosedRig reader(*rig);
  for (int f = rig->first_frame(); f < restyled->clip.frames; ++f) {
    BodyPose body;
    reader.read(restyled->clip.pose(f), body);
    // Facing +z at the start is all that a heading of the whole changes.
    out.push_back(body.positions);
  }
  return out;
}

struct Difference {
  double mean_deg = 0, max_deg = 0;
  int joint = 0;
};

// Between the directions from parent to joint, over all joints and frames.
Difference difference(const std::vector<HumanPositions>& a, const std::vector<HumanPositions>& b,
                      float turn = 0) {
  EXPECT_EQ(a.size(), b.size());
  Difference out;
  double sum = 0;
  int count = 0;
  for (size_t f = 0; f < std::min(a.size(), b.size()); ++f) {
    for (int j = 1; j < kHumanJoints; ++j) {
      const Vec3 p = rotate(rotation_y(turn), a[f][j] - a[f][kHumanParent[j]]);
      const double off = angle_deg(p, b[f][j] - b[f][kHumanParent[j]]);
      sum += off;
      ++count;
      if (off > out.max_deg) out.max_deg = off, out.joint = j;
    }
  }
  out.mean_deg = sum / count;
  return out;
}

// What docs/rigs.md promises. A rig may let go of a foot a frame before or after the canonical body
// does, and the lock then turns a thigh and a shin by up to 4 degrees in that frame. Arms and legs
// keep out of each body as wide as it is: up to 0.19 degrees in the mean of a walk.
constexpr double kMeanDeg = 0.2, kMaxDeg = 4.5;
// Where feet rest, knees bend as far as the rig's own legs need for its heels and toes to stay on
// the floor: rigs whose thighs and shins have another ratio than the canonical body's differ there.
// And hands keep contacts on arms as long as they are: up to 11.2 degrees at a hand.
constexpr double kRestingMeanDeg = 0.85, kRestingMaxDeg = 13;
// This one's arms hang on its neck and its legs on its spine. So it is read a little differently
// even without a style, 0.2 to 1.1 degrees in the mean, and its arms turn with the neck's share of
// one. The promise, rounded, and a share of the mean change of styles that change more.
constexpr const char* kArmsOnNeck = "3ds Max Biped";
constexpr double kArmsOnNeckMeanDeg = 1.2, kArmsOnNeckMaxDeg = 12;
constexpr double kArmsOnNeckMean = 0.085, kArmsOnNeckMax = 0.45;

void expect_same_style_on_all_rigs(const Clip& motion, const std::string& style, float strength,
                                   double usual_mean = kMeanDeg, double usual_max = kMaxDeg) {
  const std::vector<HumanPositions> want = styled(motion, style, strength);
  const double change = difference(want, styled(motion, style, 0)).mean_deg;
  for (const Maker& maker : makers()) {
    const Clip character = put_on(maker, motion).clip;
    const Difference plain = difference(styled(motion, style, 0), styled(character, style, 0));
    const Difference off = difference(want, styled(character, style, strength));
    std::printf("%-18s %-10s mean %.2f, most %.2f deg (%s); unstyled %.2f, %.2f (%s)\n", maker.name,
                style.c_str(), off.mean_deg, off.max_deg,
                std::string(human_joint_name(off.joint)).c_str(), plain.mean_deg, plain.max_deg,
                std::string(human_joint_name(plain.joint)).c_str());
    double mean = usual_mean, max = usual_max;
    if (maker.name == std::string(kArmsOnNeck)) {
      mean = std::max(kArmsOnNeckMeanDeg, plain.mean_deg + kArmsOnNeckMean * change);
      max = std::max(kArmsOnNeckMaxDeg, plain.max_deg + kArmsOnNeckMax * change);
    }
    EXPECT_LE(off.mean_deg, mean) << maker.name;
    EXPECT_LE(off.max_deg, max) << maker.name << " " << human_joint_name(off.joint);
  }
}

TEST(AnyRig, a_walk_gets_the_same_style_on_every_makers_rig) {
  for (const char* style : {"old", "proud", "angry"}) {
    expect_same_style_on_all_rigs(walk(), style, 1);
  }
}

TEST(AnyRig, real_motion_gets_the_same_style_on_every_makers_rig) {
  const char* data = std::getenv("PANACHE_DATA");
  if (!data) GTEST_SKIP() << "PANACHE_DATA is not set: no real motion to read";
  for (const char* name :
       {"cmu-more/127_03.bvh", "formats/cmu21/kick.bvh", "cmu-styles/137_27b.bvh"}) {
    const auto file = read_motion((fs::path(data) / name).string());
    ASSERT_TRUE(file.ok()) << file.error().message;
    std::printf("%s\n", name);
    expect_same_style_on_all_rigs(on_canonical_body((*file)->clip(), 150), "old", 1,
                                  kRestingMeanDeg, kRestingMaxDeg);
  }
}

// How far the style was let through, in the mean.
double mean_gate(const Clip& clip, const std::string& style) {
  const auto model = shipped_model();
  const StrengthTrack track = {*model->find_style(style), {{0, 1}}};
  RestyleOptions options;
  options.timing = false;
  const Result<Restyled> restyled = restyle(clip, *Rig::create(clip), model, {track}, options);
  EXPECT_TRUE(restyled.ok());
  double sum = 0;
  for (const float gate : restyled->gates) sum += static_cast<double>(gate);
  return sum / static_cast<double>(restyled->gates.size());
}

// The clip, of the canonical skeleton, on one of the same rotations and other lengths: each joint's
// offset is multiplied in x, y and z, and the hips go up and down with the legs.
Clip of_proportions(const Clip& clip, const std::vector<std::pair<std::vector<int>, Vec3>>& by) {
  Clip out = clip;
  for (const auto& [joints, factor] : by) {
    for (const int j : joints) {
      Vec3& offset = out.skeleton.joints[j].offset;
      offset = {offset.x * factor.x, offset.y * factor.y, offset.z * factor.z};
    }
  }
  const auto leg = [](const Clip& of) {
    return length(of.skeleton.joints[index(HumanJoint::left_lower_leg)].offset) +
           length(of.skeleton.joints[index(HumanJoint::left_foot)].offset);
  };
  const float taller = leg(out) / leg(clip);
  for (int f = 0; f < out.frames; ++f) {
    for (int j = 0; j < kHumanJoints; ++j) {
      Vec3& t = out.pose(f).translations[j];
      t = j == 0 ? t * taller : out.skeleton.joints[j].offset;
    }
  }
  return out;
}

TEST(AnyRig, the_gate_knows_a_motion_on_any_rig_and_of_any_proportions) {
  const std::vector<int> arms = {7, 8, 11, 12}, legs = {14, 15, 18, 19}, torso = {1, 2, 3},
                         collars = {5, 9}, shoulders = {6, 10}, hip_joints = {13, 17}, head = {4},
                         feet = {16, 20}, spine = {1}, chest = {2};
  const auto all = [](float by) { return Vec3{by, by, by}; };
  const std::vector<std::pair<const char*, std::vector<std::pair<std::vector<int>, Vec3>>>> bodies =
      {{"long arms", {{arms, all(1.3f)}}},
       {"short arms", {{arms, all(0.7f)}}},
       {"long legs", {{legs, all(1.25f)}}},
       {"short legs", {{legs, all(0.7f)}}},
       {"long torso", {{torso, all(1.3f)}}},
       {"wide shoulders", {{shoulders, {1.7f, 1, 1}}, {collars, {1.5f, 1, 1}}}},
       {"wide hips", {{hip_joints, {1.6f, 1, 1}}}},
       {"large head and feet", {{head, all(1.6f)}, {feet, all(1.4f)}}},
       {"low spine", {{spine, {1, 0.7f, 1}}, {chest, {1, 1.4f, 1}}}},
       {"child",
        {{arms, all(0.8f)},
         {legs, all(0.75f)},
         {head, all(1.5f)},
         {shoulders, all(0.8f)},
         {hip_joints, all(0.8f)}}}};
  std::vector<std::pair<std::string, Clip>> motions = {{"walk", on_canonical_body(walk(), 120)}};
  if (const char* data = std::getenv("PANACHE_DATA")) {
    for (const char* name : {"formats/cmu21/kick.bvh", "formats/other/Anthro_Mocap_Walk.bvh"}) {
      const auto file = read_motion((fs::path(data) / name).string());
      ASSERT_TRUE(file.ok()) << file.error().message;
      motions.emplace_back(name, on_canonical_body((*file)->clip(), 150));
    }
  }
  for (const auto& [name, motion] : motions) {
    const double own = mean_gate(motion, "old");
    double min = own, max = own;
    const auto note = [&](const std::string& of, const Clip& clip) {
      const double gate = mean_gate(clip, "old");
      std::printf("%-36s %-20s gate %.3f\n", name.c_str(), of.c_str(), gate);
      min = std::min(min, gate), max = std::max(max, gate);
    };
    for (const Maker& maker : makers()) note(maker.name, put_on(maker, motion).clip);
    for (const auto& [of, by] : bodies) note(of, of_proportions(motion, by));
    // What is hardly known depends on the body's proportions.
    EXPECT_LT(max - min, own > 0.95 ? 0.05 : 0.2) << name;
  }
}

TEST(AnyRig, units_axes_and_facing_make_no_difference) {
  const Clip motion = walk();
  const Maker& maker = makers().front();
  const std::vector<HumanPositions> want = styled(put_on(maker, motion).clip, "old", 1);
  double worst = 0;
  for (const double units : {1.0, 100.0, 39.37, 0.01, 17.73}) {
    for (const bool z_up : {false, true}) {
      for (const int quarter : {0, 1, 2, 3}) {
        const float turn = static_cast<float>(quarter) * 1.5707963f;
        const Clip clip = put_on(maker, motion, turn, units, z_up).clip;
        const Difference off = difference(want, styled(clip, "old", 1), turn);
        worst = std::max(worst, off.max_deg);
        EXPECT_LT(off.max_deg, 0.01) << units << (z_up ? " z up " : " y up ") << quarter;
      }
    }
  }
  std::printf("largest difference %.4f deg\n", worst);
}

TEST(AnyRig, strength_zero_is_the_input_bit_for_bit) {
  const auto model = shipped_model();
  for (const Maker& maker : makers()) {
    const Clip clip = put_on(maker, walk()).clip;
    const Result<Restyled> same = restyle(clip, *Rig::create(clip), model, {{0, {{0, 0}}}});
    ASSERT_TRUE(same.ok());
    EXPECT_EQ(same->clip.frames, clip.frames) << maker.name;
    for (size_t i = 0; i < clip.rotations.size(); ++i) {
      ASSERT_TRUE(same_bits(same->clip.rotations[i], clip.rotations[i])) << maker.name;
      ASSERT_TRUE(same_bits(same->clip.translations[i], clip.translations[i])) << maker.name;
    }
  }
}

// `clip` without the joints whose names hold one of `words`; their children hang on their parents.
Clip without(const Clip& clip, const std::vector<std::string>& words) {
  Clip out{{}, clip.frame_time, clip.frames, {}, {}};
  std::vector<int> new_index(clip.joints(), -1), kept_above(clip.joints(), -1);
  for (size_t j = 0; j < clip.joints(); ++j) {
    const Joint& joint = clip.skeleton.joints[j];
    const bool drop = std::any_of(words.begin(), words.end(), [&](const std::string& word) {
      return joint.name.find(word) != std::string::npos;
    });
    const int above = joint.parent < 0 ? -1 : kept_above[joint.parent];
    kept_above[j] = drop ? above : static_cast<int>(j);
    if (drop) continue;
    new_index[j] = static_cast<int>(out.joints());
    Joint copy = joint;
    copy.parent = above < 0 ? -1 : new_index[above];
    out.skeleton.joints.push_back(copy);
  }
  out.resize(clip.frames);
  std::vector<Quat> rotations(clip.joints());
  std::vector<Vec3> at(clip.joints());
  for (int f = -1; f < clip.frames; ++f) {
    for (size_t j = 0; j < clip.joints(); ++j) {
      const Joint& joint = clip.skeleton.joints[j];
      rotations[j] = f < 0 ? joint.rest : clip.pose(f).rotations[j];
      at[j] = f < 0 ? joint.offset : clip.pose(f).translations[j];
    }
    world_pose(clip.skeleton, {rotations, at}, {rotations, at});
    for (size_t j = 0; j < clip.joints(); ++j) {
      if (new_index[j] < 0) continue;
      const int parent = clip.skeleton.joints[j].parent;
      const int above = parent < 0 ? -1 : kept_above[parent];
      const Quat q = above < 0 ? rotations[j] : conjugate(rotations[above]) * rotations[j];
      const Vec3 t = above < 0 ? at[j] : rotate(conjugate(rotations[above]), at[j] - at[above]);
      Joint& joint = out.skeleton.joints[new_index[j]];
      if (f < 0) {
        joint.rest = normalized(q);
        joint.offset = t;
      } else {
        out.pose(f).rotations[new_index[j]] = normalized(q);
        out.pose(f).translations[new_index[j]] = t;
      }
    }
  }
  return out;
}

TEST(AnyRig, missing_joints_are_lived_with) {
  const Clip motion = walk();
  const std::vector<HumanPositions> want = styled(motion, "old", 1);
  const Maker& maker = makers().front();
  // Shares of what the style changes that a body cannot keep without these: a head of its own to
  // nod with, a spine to bend.
  const double change = difference(want, styled(motion, "old", 0)).mean_deg;
  const std::vector<std::pair<std::vector<std::string>, double>> cases = {
      {{"Toe"}, 0.0015},
      {{"Hand"}, 0.0015},
      {{"Shoulder"}, 0.075},
      {{"Neck"}, 0.135},
      {{"Head"}, 0.28},
      {{"Spine1", "Spine2"}, 0.125},
      {{"Toe", "Neck", "Head", "Shoulder", "Spine", "Hand"}, 0.51}};
  for (const auto& [words, max] : cases) {
    const Clip clip = without(put_on(maker, motion).clip, words);
    EXPECT_LE(difference(want, styled(clip, "old", 1)).mean_deg, max * change) << words[0];
  }
}

}  // namespace
}  // namespace panache
