// Kinds of files that are easy to read wrongly, as motions and as characters.

#include "odd_files.h"

#include <cmath>

#include "retarget/on_characters.h"
#include "retarget/reference_pose.h"

namespace panache {
namespace {

using namespace test;
using enum HumanJoint;

// A tenth of a millimetre; rounding stays below it.
constexpr float kSame = 1e-4f;

Clip rest_of(const Clip& clip) { return rest_clip(clip.skeleton); }

// The largest distance of the mapped joints of two clips, metres of a 0.8 m leg.
float apart(const Clip& a, const Clip& b, int first = 0) {
  const std::vector<BodyPose> one = bodies(a), other = bodies(b);
  const float floor = Rig::create(a)->floor() - Rig::create(b)->floor();
  EXPECT_EQ(one.size(), other.size());
  float max = 0;
  for (size_t f = static_cast<size_t>(first); f < std::min(one.size(), other.size()); ++f) {
    for (int j = 0; j < kHumanJoints; ++j) {
      max = std::max(max, length(one[f].joints[j] + Vec3{0, floor, 0} - other[f].joints[j]));
    }
  }
  return max;
}

// How far joints of the same name are from each other, in all frames.
void expect_together(const Clip& clip, const std::vector<std::pair<int, int>>& pairs) {
  for (const std::vector<Vec3>& at : world_positions(clip)) {
    for (const auto& [a, b] : pairs) {
      ASSERT_LT(length(at[a] - at[b]), kSame) << clip.skeleton.joints[b].name;
    }
  }
}

TEST(OddFiles, clothes_and_copied_joints_stay_on_the_body) {
  const Clip dressed = odd_clip("clothes-own-armature.glb");
  std::vector<std::pair<int, int>> pairs;
  for (const Joint& joint : plain_walk().skeleton.joints) {
    pairs.emplace_back(find_joint_named(dressed, joint.name),
                       find_joint_named(dressed, joint.name, 1));
  }
  const Clip worn = put(neutral_walk(1), rest_of(dressed));
  EXPECT_GT(length(worn.pose(29).translations[pairs[0].first] -
                   worn.pose(0).translations[pairs[0].first]),
            0.5f);
  expect_together(worn, pairs);

  const Clip copied = with_copied_leg(plain_walk());
  pairs.clear();
  for (const char* name : {"leftUpperLeg", "leftLowerLeg", "leftFoot"}) {
    pairs.emplace_back(find_joint_named(copied, name),
                       find_joint_named(copied, std::string(name) + "D"));
  }
  for (const Clip& character : {rest_of(copied), copied}) {
    expect_together(put(neutral_walk(1), character), pairs);
  }
}

TEST(OddFiles, a_mirrored_figure_walks_forwards) {
  const Clip exchanged = with_exchanged_names(
      plain_walk(),
      {"Shoulder", "UpperArm", "LowerArm", "Hand", "UpperLeg", "LowerLeg", "Foot", "Toes"});
  for (const Clip& motion : {odd_clip("mirrored-armature.glb"), exchanged}) {
    const std::vector<BodyPose> walk = bodies(put(motion, rest_of(plain_walk())));
    const Vec3 path = walk.back().joints[0] - walk.front().joints[0];
    const Vec3 front = {std::sin(walk.front().facing), 0, std::cos(walk.front().facing)};
    EXPECT_GT(dot(normalized(path), front), 0.9f);
  }
  // Geometry alone decides, so that the names make no difference.
  EXPECT_LT(
      apart(put(exchanged, rest_of(neutral_walk(1))), put(plain_walk(), rest_of(neutral_walk(1)))),
      kSame);
}

TEST(OddFiles, a_figure_that_grows_or_shrinks_has_its_size_at_rest) {
  Clip grows = odd_clip("spawns-from-nothing.glb");
  Clip shrinks = grows;
  for (int f = 0; f < grows.frames; ++f) {
    const ConstPose from = grows.pose(grows.frames - 1 - f);
    std::copy(from.rotations.begin(), from.rotations.end(), shrinks.pose(f).rotations.begin());
    std::copy(from.translations.begin(), from.translations.end(),
              shrinks.pose(f).translations.begin());
  }
  for (const Clip& clip : {grows, shrinks}) {
    const Rig rig = *Rig::create(clip);
    EXPECT_NEAR(rig.scale(), 1, 1e-3f);
    EXPECT_NEAR(rig.floor(), 0, 0.02f);
  }
  // From half a second on it has its size.
  const std::vector<BodyPose> got = bodies(put(grows, rest_of(neutral_walk(1)))),
                              want = bodies(grows);
  ASSERT_EQ(got.size(), want.size());
  for (size_t f = 31; f < got.size(); ++f) {
    for (int j = 0; j < kHumanJoints; ++j) {
      EXPECT_LT(length(got[f].joints[j] - want[f].joints[j]), 0.03f) << f << " " << j;
    }
  }
}

TEST(OddFiles, a_motion_above_its_floor_stays_there) {
  const Clip up = odd_clip("one-metre-up.bvh"), plain = plain_walk();
  Maker dwarf = makers().front();
  dwarf.legs = 0.6f;
  for (const Clip& character : {rest_of(plain), character_of(dwarf)}) {
    const auto high = world_positions(put(up, character)),
               low = world_positions(put(plain, character));
    const Rig rig = *Rig::create(character);
    const auto hips_of = [&](const auto& frames) { return frames[10][rig.joints()[0]]; };
    // In lengths of the leg, which is 0.8 canonical metres.
    EXPECT_NEAR(length(hips_of(high) - hips_of(low)) * rig.scale(), 1, 0.03);
  }
}

TEST(OddFiles, feet_that_hang_on_the_root_follow_their_shins) {
  const Clip feet = odd_clip("feet-on-the-root.bvh"), plain = plain_walk();
  EXPECT_LT(apart(put(feet, rest_of(plain)), plain), kSame);
  for (const Clip& character : {feet, rest_of(feet)}) {
    const Clip walk = put(neutral_walk(1), character);
    for (const std::vector<Vec3>& at : world_positions(walk)) {
      for (const char* side : {"left", "right"}) {
        const Vec3 shin = at[find_joint_named(walk, std::string(side) + "LowerLeg")];
        ASSERT_NEAR(length(at[find_joint_named(walk, std::string(side) + "Foot")] - shin), 0.4f,
                    kSame);
      }
    }
  }
}

TEST(OddFiles, legs_without_feet_end_at_their_shins) {
  const Clip footless = without(plain_walk(), {"leftFoot", "rightFoot"});
  const Clip walk = put(footless, rest_of(plain_walk()));
  const auto got = world_positions(walk), want = world_positions(plain_walk());
  // The knees; the feet are fixed to the shins, which the floor bends a little.
  const int knee = find_joint_named(walk, "leftLowerLeg");
  for (size_t f = 0; f < got.size(); ++f) EXPECT_LT(length(got[f][knee] - want[f][knee]), 0.06f);
}

TEST(OddFiles, from_vrm_to_vrm_the_front_stays_the_front) {
  const Clip backward = odd_clip("front-minus-z.vrm");
  const Rig rig = *Rig::create(backward);
  EXPECT_LT(bodies(backward).back().joints[0].z, -1);
  const Clip on_vrma = put(backward, t_pose_body(backward, rig));
  EXPECT_GT(bodies(on_vrma).back().joints[0].z, 1);
  Clip vrm_1 = plain_walk();
  for (Joint& joint : vrm_1.skeleton.joints) joint.role = joint.name;
  EXPECT_GT(bodies(put(backward, rest_of(vrm_1))).back().joints[0].z, 1);
  EXPECT_LT(bodies(put(vrm_1, rest_of(backward))).back().joints[0].z, -1);
}

TEST(OddFiles, a_skeleton_takes_its_own_motion_exactly) {
  for (const char* name : {"no-rest-pose.bvh", "feet-on-the-root.bvh", "slope-up.bvh",
                           "clothes-own-armature.glb", "mirrored-armature.glb"}) {
    const Clip clip = odd_clip(name);
    const Clip same = put(clip, clip);
    EXPECT_EQ(same.rotations, clip.rotations) << name;
    EXPECT_EQ(same.translations, clip.translations) << name;
  }
  // Also in other units and below a node that a converter adds.
  Clip centimetres = with_root(plain_walk());
  centimetres.skeleton.joints[0].name = "scene";
  for (Joint& joint : centimetres.skeleton.joints) joint.offset *= 100;
  for (Vec3& at : centimetres.translations) at *= 100;
  EXPECT_EQ(put(plain_walk(), rest_of(centimetres)).rotations, centimetres.rotations);
}

TEST(OddFiles, a_back_with_more_joints_than_are_mapped_stays_whole) {
  const Clip character = odd_clip("no-rest-pose.bvh");
  const Clip walk = put(neutral_walk(1), character);
  const int low = find_joint_named(walk, "lowerSpine");
  for (const std::vector<Vec3>& at : world_positions(walk)) {
    const Vec3 lower = at[low] - at[0], upper = at[low + 1] - at[low];
    ASSERT_GT(dot(normalized(lower), normalized(upper)), 0.9f);
  }
}

TEST(OddFiles, the_path_goes_to_a_root_joint) {
  const Clip character = rest_of(with_root(plain_walk()));
  const Clip on_root = put(neutral_walk(1), character);
  const Clip on_hips = put(neutral_walk(1), character, {.root = false});
  EXPECT_LT(apart(on_root, on_hips), kSame);
  const auto at = world_positions(on_root);
  EXPECT_GT(length(at.back()[0] - at.front()[0]), 0.5f);
  EXPECT_NEAR(at.back()[0].y, 0, kSame);
  EXPECT_EQ(world_positions(on_hips).back()[0], Vec3{});
  for (const std::vector<Vec3>& frame : at) {
    EXPECT_LT(std::hypot(frame[1].x - frame[0].x, frame[1].z - frame[0].z), 0.1f);
  }
}

}  // namespace
}  // namespace panache
