// Kinds of files that are easy to read wrongly: which joints are mapped, and what a change moves.

#include "odd_files.h"

#include "rig/body_motions.h"
#include "rig/figures.h"
#include "rig/posed_rig.h"

namespace panache {
namespace {

using namespace test;
using enum HumanJoint;

constexpr float kSame = 1e-4f;  // Metres; rounding stays below it.

std::string joint_name_of(const Clip& clip, const Rig& rig, HumanJoint joint) {
  const int found = rig.joints()[index(joint)];
  return found < 0 ? "" : clip.skeleton.joints[static_cast<size_t>(found)].name;
}

// The clip as it is read and written with this change.
Clip rewritten(const Clip& clip, const Rig& rig, const BodyChange& change) {
  PosedRig posed(rig);
  Clip out = clip;
  for (int f = 0; f < clip.frames; ++f) {
    BodyPose body;
    posed.read(clip.pose(f), body);
    posed.write(clip.pose(f), body, change, out.pose(f));
  }
  return out;
}
Clip without_change(const Clip& clip, const Rig& rig) { return rewritten(clip, rig, {}); }
// With a change of every limb and a step aside.
Clip with_change(const Clip& clip, const Rig& rig) {
  BodyChange change;
  for (int j = 0; j < kHumanJoints; ++j) {
    change.rotations[j] = axis_angle(normalized(Vec3{1, 0.2f * j, 0.5f}), 0.05f * (j % 7));
  }
  change.turn = 0.3f;
  change.translation = {0.2f, -0.05f, 0.1f};
  return rewritten(clip, rig, change);
}

TEST(OddRig, what_goes_with_the_body_follows_every_change) {
  const Clip dressed = odd_clip("clothes-own-armature.glb");
  const Clip copied = with_copied_leg(plain_walk());
  const Clip clothes = with_change(dressed, *Rig::create(dressed));
  const Clip copies = with_change(copied, *Rig::create(copied));
  const auto worn = world_positions(clothes), bent = world_positions(copies);
  for (size_t f = 0; f < worn.size(); ++f) {
    for (const Joint& joint : plain_walk().skeleton.joints) {
      const int body = find_joint_named(clothes, joint.name),
                cloth = find_joint_named(clothes, joint.name, 1);
      ASSERT_LT(length(worn[f][body] - worn[f][cloth]), kSame) << joint.name;
    }
    for (const char* name : {"leftUpperLeg", "leftLowerLeg", "leftFoot"}) {
      const int leg = find_joint_named(copies, name),
                copy = find_joint_named(copies, std::string(name) + "D");
      ASSERT_LT(length(bent[f][leg] - bent[f][copy]), kSame) << name;
    }
  }
  EXPECT_EQ((*Rig::create(copied)).remarks(),
            std::vector<std::string>{"joints beside the body go with it: 'leftUpperLegD' follows "
                                     "leftUpperLeg, 'leftLowerLegD' follows leftLowerLeg, "
                                     "'leftFootD' follows leftFoot"});
}

TEST(OddRig, no_change_leaves_every_bit) {
  for (const char* name :
       {"clothes-own-armature.glb", "feet-on-the-root.bvh", "mirrored-armature.glb",
        "two-figures-two-clips.glb", "arms-only-clip.glb", "spawns-from-nothing.glb"}) {
    const Clip clip = odd_clip(name);
    const Clip same = without_change(clip, *Rig::create(clip));
    EXPECT_EQ(same.rotations, clip.rotations) << name;
    EXPECT_EQ(same.translations, clip.translations) << name;
  }
}

TEST(OddRig, each_clip_is_of_the_figure_that_it_moves) {
  const auto file = odd_file("two-figures-two-clips.glb");
  EXPECT_EQ(find_body_motions(*file).clips, (std::vector{0, 1}));
  const int second = find_joint_named(file->clip(0), "hips", 1);
  EXPECT_LT((*Rig::create(file->clip(0))).joints()[0], second);
  EXPECT_EQ((*Rig::create(file->clip(1))).joints()[0], second);
  RigOptions other;
  other.figure = "base (2)";
  EXPECT_EQ((*Rig::create(file->clip(0), other)).joints()[0], second);
  other.figure = "base (3)";
  EXPECT_EQ(Rig::create(file->clip(0), other).error().message,
            "there is no figure 'base (3)'; expected one of 'base', 'base (2)'");
  // A map with names that both have is of one of them.
  RigOptions map;
  map.joints[index(left_hand)] = "leftHand";
  EXPECT_EQ((*Rig::create(file->clip(1), map)).joints()[index(left_hand)],
            find_joint_named(file->clip(1), "leftHand", 1));
  // Clothes and the body below them are one figure.
  EXPECT_TRUE(find_figures(odd_clip("clothes-own-armature.glb")).empty());
}

TEST(OddRig, two_figures_of_one_motion_are_both_found) {
  // A second dancer a metre aside, in one BVH with two roots.
  const Clip one = plain_walk();
  Clip two;
  two.frame_time = one.frame_time;
  two.skeleton = one.skeleton;
  for (Joint joint : one.skeleton.joints) {
    joint.name = "B_" + joint.name;
    if (joint.parent >= 0) joint.parent += static_cast<int>(one.joints());
    two.skeleton.joints.push_back(joint);
  }
  two.resize(one.frames);
  for (int f = 0; f < one.frames; ++f) {
    for (size_t j = 0; j < two.joints(); ++j) {
      two.pose(f).rotations[j] = one.pose(f).rotations[j % one.joints()];
      two.pose(f).translations[j] = one.pose(f).translations[j % one.joints()];
    }
    two.pose(f).translations[one.joints()].x += 1;
  }
  const std::vector<Figure> figures = find_figures(two);
  ASSERT_EQ(figures.size(), 2u);
  EXPECT_EQ(figures[1].name, "B_hips");
  EXPECT_TRUE(figures[0].moves && figures[1].moves);
  RigOptions options;
  options.figure = "B_hips";
  EXPECT_EQ(joint_name_of(two, *Rig::create(two, options), left_hand), "B_leftHand");
}

TEST(OddRig, sides_are_those_of_the_body) {
  const Clip plain = plain_walk();
  const std::vector<std::string> arms = {"Shoulder", "UpperArm", "LowerArm", "Hand"};
  const std::vector<std::string> legs = {"UpperLeg", "LowerLeg", "Foot", "Toes"};
  std::vector<std::string> all = arms;
  all.insert(all.end(), legs.begin(), legs.end());
  for (const auto& parts : {arms, legs, all}) {
    const Clip clip = with_exchanged_names(plain, parts);
    const Rig rig = *Rig::create(clip);
    EXPECT_EQ(rig.joints(), (*Rig::create(plain)).joints());
    ASSERT_EQ(rig.remarks().size(), 1u);
    EXPECT_TRUE(rig.remarks()[0].starts_with("left and right of the ")) << rig.remarks()[0];
  }
  EXPECT_TRUE((*Rig::create(plain)).remarks().empty());
  const Clip mirrored = odd_clip("mirrored-armature.glb");
  EXPECT_EQ(joint_name_of(mirrored, *Rig::create(mirrored), left_hand), "rightHand");
}

TEST(OddRig, feet_on_the_root_are_mapped_and_missing_ones_estimated) {
  const Clip feet = odd_clip("feet-on-the-root.bvh");
  EXPECT_EQ(joint_name_of(feet, *Rig::create(feet), left_foot), "leftFoot");
  const Clip footless = without(plain_walk(), {"leftFoot", "rightFoot"});
  const Rig rig = *Rig::create(footless);
  EXPECT_EQ(rig.joints()[index(left_foot)], -1);
  EXPECT_EQ(rig.remarks().size(), 2u);
  EXPECT_NEAR(rig.scale(), 1, 1e-3f);
}

TEST(OddRig, an_upper_body_moves_where_it_is) {
  const Clip upper = without(plain_walk(), {"leftUpperLeg", "rightUpperLeg"});
  const Result<Rig> rig = Rig::create(upper);
  ASSERT_TRUE(rig.ok()) << rig.error().message;
  EXPECT_NEAR(rig->scale(), 1, 0.3f);
  EXPECT_FALSE(rig->can_move());
  const Clip out = with_change(upper, *rig);
  EXPECT_EQ(out.translations, upper.translations);
  EXPECT_NE(out.rotations, upper.rotations);

  const std::vector<std::string> right = {"rightUpperLeg"}, half = {"rightUpperLeg", "leftFoot"};
  for (const std::vector<std::string>& missing : {right, half}) {
    const Clip one_leg = without(plain_walk(), missing);
    const Result<Rig> other = Rig::create(one_leg);
    ASSERT_TRUE(other.ok()) << other.error().message;
    EXPECT_TRUE(other->can_move());
    EXPECT_NEAR(other->scale(), 1, 0.3f);
    EXPECT_EQ(without_change(one_leg, *other).rotations, one_leg.rotations);
  }
}

TEST(OddRig, a_layer_of_an_animation_gets_no_more_keys) {
  const Clip arms = odd_clip("arms-only-clip.glb");
  const Clip out = with_change(arms, *Rig::create(arms));
  for (size_t j = 0; j < arms.joints(); ++j) {
    const bool same = std::equal(&out.rotations[j], &out.rotations[j] + 1, &arms.rotations[j]) &&
                      out.translations[j] == arms.translations[j];
    EXPECT_TRUE(same || !arms.skeleton.joints[j].unkeyed) << arms.skeleton.joints[j].name;
  }
  EXPECT_NE(out.rotations, arms.rotations);
  // And one of the legs alone.
  Clip legs = plain_walk();
  for (Joint& joint : legs.skeleton.joints) {
    joint.unkeyed = joint.name.find("Leg") == std::string::npos && joint.name != "hips";
  }
  const Rig rig = *Rig::create(legs);
  EXPECT_EQ(rig.remarks().size(), 1u);
  EXPECT_TRUE(rig.can_move());
}

TEST(OddRig, a_change_of_the_path_goes_to_the_joint_that_has_it) {
  // Root motion of a game: the root goes along the ground, the hips stay above it.
  Clip clip = with_root(plain_walk());
  for (int f = 0; f < clip.frames; ++f) {
    const Pose pose = clip.pose(f);
    const Vec3 path = {pose.translations[1].x, 0, pose.translations[1].z};
    pose.translations[0] += path;
    pose.translations[1] = pose.translations[1] - path;
  }
  const Rig rig = *Rig::create(clip);
  EXPECT_EQ(rig.ground_joint(), 0);
  const Clip out = with_change(clip, rig);
  for (int f = 0; f < clip.frames; ++f) {
    const Vec3 moved = out.pose(f).translations[0] - clip.pose(f).translations[0];
    EXPECT_LT(length(moved - Vec3{0.2f, 0, 0.1f}), kSame);
  }
  EXPECT_EQ((*Rig::create(with_root(plain_walk()))).ground_joint(), -1);
}

// A spider: a body with eight legs of three joints, named by their number or not at all.
Clip spider(bool named) {
  Clip clip;
  const auto add = [&](const std::string& name, int parent, Vec3 offset) {
    Joint joint;
    joint.name = named ? name : "n" + std::to_string(clip.skeleton.joints.size());
    joint.parent = parent;
    joint.offset = offset;
    joint.can_rotate = joint.can_translate = true;
    clip.skeleton.joints.push_back(joint);
    return static_cast<int>(clip.skeleton.joints.size()) - 1;
  };
  const int body = add("Body", -1, {0, 0.5f, 0});
  add("Head", add("Thorax", body, {0, 0, 0.3f}), {0, 0, 0.2f});
  for (int leg = 0; leg < 4; ++leg) {
    for (const float side : {1.0f, -1.0f}) {
      const std::string end = "Leg" + std::to_string(leg + 1) + (side > 0 ? ".L" : ".R");
      const float ahead = 0.2f - 0.13f * static_cast<float>(leg);
      const int upper = add("Upper" + end, body, {0.1f * side, 0, ahead});
      const int lower = add("Lower" + end, upper, {0.5f * side, 0.3f, ahead});
      add("Foot" + end, lower, {0.4f * side, -0.7f, ahead});
    }
  }
  Clip rest = rest_clip(clip.skeleton);
  return rest;
}

TEST(OddRig, other_creatures_are_no_persons) {
  for (const bool named : {true, false}) EXPECT_FALSE(Rig::create(spider(named)).ok()) << named;
  // A bird: what would be arms are wings.
  Clip bird = plain_walk();
  for (Joint& joint : bird.skeleton.joints) {
    if (joint.name.find("UpperArm") != std::string::npos) joint.name += "Wing";
  }
  EXPECT_TRUE(Rig::create(bird).error().message.starts_with("no person: leftUpperArm would be '"));
  // A frog: on its hands at rest and in the motion.
  Clip frog = rest_clip(plain_walk().skeleton);
  for (size_t j = 0; j < frog.joints(); ++j) {
    const std::string& name = frog.skeleton.joints[j].name;
    const bool left = name.starts_with("left");
    if (name == "spine") frog.rotations[j] = axis_angle(Vec3{1, 0, 0}, 0.9f);
    if (name.ends_with("UpperLeg")) frog.rotations[j] = axis_angle(Vec3{1, 0, 0}, -1.9f);
    if (name.ends_with("LowerLeg")) frog.rotations[j] = axis_angle(Vec3{1, 0, 0}, 2.6f);
    if (name.ends_with("UpperArm")) {
      frog.rotations[j] =
          axis_angle(Vec3{1, 0, 0}, -0.9f) * axis_angle(Vec3{0, 0, 1}, left ? -1.5f : 1.5f);
    }
  }
  Clip at_rest = frog;
  for (size_t j = 0; j < frog.joints(); ++j) at_rest.skeleton.joints[j].rest = frog.rotations[j];
  EXPECT_FALSE(Rig::create(at_rest).ok());
  // A person who does the same is one.
  EXPECT_TRUE(Rig::create(frog).ok());
}

}  // namespace
}  // namespace panache
