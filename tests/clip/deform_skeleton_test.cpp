// Deforming joints in pieces, as control rigs export them, made into one tree and brought back.

#include "clip/deform_tree.h"

#include <gtest/gtest.h>

#include "clip/clip.h"
#include "make_clip.h"
#include "rig/humanoid.h"

namespace panache {
namespace {

struct World {
  World(const Clip& clip, int frame) : rotations(clip.joints()), positions(clip.joints()) {
    world_pose(clip.skeleton, clip.pose(frame), {rotations, positions});
  }
  std::vector<Quat> rotations;
  std::vector<Vec3> positions;
};

// A walk whose joints hang on other parents than they follow: `parents` are in the order of the new
// joints, of which the first is a root that stands still and deforms nothing.
struct Flat {
  Clip clip;
  std::vector<int> of;  // [joints] of the walk: place in `clip`.
};

// Legs, shoulders and arms are children of the root, and so is the spine; the last joint is first
// in the file, so that parents come after children where only the tree knows them.
Flat flat_walk(bool with_skin = true) {
  const Clip walk = test::walking_clip(40);
  const auto hangs_on_root = [](int j) {
    using enum HumanJoint;
    for (const HumanJoint human : {left_shoulder, right_shoulder, left_upper_arm, right_upper_arm,
                                   left_upper_leg, right_upper_leg}) {
      if (j == index(human)) return true;
    }
    return j == 0;
  };
  Flat flat;
  flat.of.assign(walk.joints(), -1);
  Joint root;
  root.name = "root";
  root.can_rotate = root.can_translate = true;
  flat.clip.skeleton.joints.push_back(root);
  std::vector<int> order;  // Limbs before the torso.
  for (const bool torso : {false, true}) {
    for (int j = 0; j < static_cast<int>(walk.joints()); ++j) {
      int piece = j;
      while (!hangs_on_root(piece)) piece = walk.skeleton.joints[static_cast<size_t>(piece)].parent;
      if ((piece == 0) == torso) order.push_back(j);
    }
  }
  for (const int j : order) {
    Joint joint = walk.skeleton.joints[static_cast<size_t>(j)];
    flat.of[static_cast<size_t>(j)] = static_cast<int>(flat.clip.skeleton.joints.size());
    joint.parent = hangs_on_root(j) ? 0 : flat.of[static_cast<size_t>(joint.parent)];
    joint.can_translate = hangs_on_root(j);
    joint.skin = with_skin ? 0 : -1;
    joint.skin_weight = 10;
    flat.clip.skeleton.joints.push_back(joint);
  }
  const Clip rest = rest_clip(walk.skeleton);
  const auto fill = [&](const Clip& from, int frame, Pose to) {
    const World world(from, frame);
    to.rotations[0] = {};
    to.translations[0] = {};
    for (const int j : order) {
      const auto n = static_cast<size_t>(j), at = static_cast<size_t>(flat.of[n]);
      const bool root_child = hangs_on_root(j);
      to.rotations[at] = root_child ? world.rotations[n] : from.pose(frame).rotations[n];
      to.translations[at] = root_child ? world.positions[n] : from.pose(frame).translations[n];
    }
  };
  flat.clip.frame_time = walk.frame_time;
  flat.clip.resize(walk.frames);
  Clip flat_rest = rest_clip(flat.clip.skeleton);
  fill(rest, 0, flat_rest.pose(0));
  for (size_t j = 0; j < flat.clip.joints(); ++j) {
    flat.clip.skeleton.joints[j].rest = flat_rest.rotations[j];
    flat.clip.skeleton.joints[j].offset = flat_rest.translations[j];
  }
  for (int f = 0; f < walk.frames; ++f) fill(walk, f, flat.clip.pose(f));
  return flat;
}

// A file of one clip that keeps what it is to encode.
class OneClip final : public MotionFile {
 public:
  OneClip(Clip clip, Clip& encoded) : clip_(std::move(clip)), encoded_(encoded) {}
  std::vector<std::string> clip_names() const override { return {"walk"}; }
  const Clip& clip(int) const override { return clip_; }
  Clip rest() const override { return rest_clip(clip_.skeleton); }
  std::string encode(std::span<const ClipEdit> edits, EditMode) const override {
    encoded_ = *edits[0].changed;
    return "";
  }

 private:
  Clip clip_;
  Clip& encoded_;
};

class DeformSkeleton : public testing::Test {
 protected:
  std::unique_ptr<MotionFile> join(Clip clip) {
    return join_deforming_joints(std::make_unique<OneClip>(std::move(clip), encoded_));
  }
  Clip encoded_;
};

int find(const Clip& clip, const std::string& name) {
  for (size_t j = 0; j < clip.joints(); ++j) {
    if (clip.skeleton.joints[j].name == name) return static_cast<int>(j);
  }
  return -1;
}

std::string parent_of(const Clip& clip, const std::string& name) {
  const int parent = clip.skeleton.joints[static_cast<size_t>(find(clip, name))].parent;
  return parent < 0 ? "" : clip.skeleton.joints[static_cast<size_t>(parent)].name;
}

TEST_F(DeformSkeleton, pieces_become_the_tree_that_they_follow) {
  const auto file = join(flat_walk().clip);
  const Clip& clip = file->clip();
  EXPECT_EQ(find(clip, "root"), -1);
  for (const auto& [joint, parent] : {std::pair{"hips", ""},
                                      {"leftUpperLeg", "hips"},
                                      {"rightUpperLeg", "hips"},
                                      {"leftShoulder", "chest"},
                                      {"rightShoulder", "chest"},
                                      {"leftUpperArm", "leftShoulder"},
                                      {"rightUpperArm", "rightShoulder"},
                                      {"leftFoot", "leftLowerLeg"}}) {
    EXPECT_EQ(parent_of(clip, joint), parent) << joint;
  }
  for (size_t j = 0; j < clip.joints(); ++j) {
    EXPECT_LT(clip.skeleton.joints[j].parent, static_cast<int>(j));
  }
}

TEST_F(DeformSkeleton, every_joint_is_where_it_was) {
  const Flat flat = flat_walk();
  const auto file = join(flat.clip);
  const Clip& clip = file->clip();
  ASSERT_EQ(clip.frames, flat.clip.frames);
  for (int f = 0; f < clip.frames; f += 7) {
    const World before(flat.clip, f), now(clip, f);
    for (size_t j = 0; j < clip.joints(); ++j) {
      const auto old = static_cast<size_t>(find(flat.clip, clip.skeleton.joints[j].name));
      // Some ten roundings on coordinates of up to 2 m.
      EXPECT_LT(length(now.positions[j] - before.positions[old]), 1e-5f);
    }
  }
}

TEST_F(DeformSkeleton, an_edit_comes_back_to_the_files_own_tree) {
  const Flat flat = flat_walk();
  const auto file = join(flat.clip);
  Clip edited = file->clip();
  const auto chest = static_cast<size_t>(find(edited, "chest"));
  std::vector<double> frames;
  for (int f = 0; f < edited.frames; ++f) {
    frames.push_back(f);
    if (f < 20) continue;
    const Pose pose = edited.pose(f);
    pose.rotations[chest] = pose.rotations[chest] * axis_angle(Vec3{1, 0, 0}, 0.5f);
  }
  file->encode(edited, frames);
  ASSERT_EQ(encoded_.joints(), flat.clip.joints());
  for (int f = 0; f < edited.frames; ++f) {
    const World wanted(edited, f), got(encoded_, f), before(flat.clip, f);
    for (size_t j = 0; j < edited.joints(); ++j) {
      const auto own = static_cast<size_t>(find(encoded_, edited.skeleton.joints[j].name));
      EXPECT_LT(length(got.positions[own] - wanted.positions[j]), 1e-5f);
      const bool arm = edited.skeleton.joints[j].name == "leftHand";
      if (f < 20 || !arm) continue;
      EXPECT_GT(length(got.positions[own] - before.positions[own]), 0.1f);
    }
  }
  // What was not touched has the bits of the file.
  for (int f = 0; f < 20; ++f) {
    for (size_t j = 0; j < encoded_.joints(); ++j) {
      EXPECT_TRUE(encoded_.pose(f).rotations[j] == flat.clip.pose(f).rotations[j]);
      EXPECT_TRUE(encoded_.pose(f).translations[j] == flat.clip.pose(f).translations[j]);
    }
  }
}

TEST_F(DeformSkeleton, a_tempo_of_its_own_takes_controls_along) {
  Flat flat = flat_walk();
  for (int f = 0; f < flat.clip.frames; ++f) flat.clip.pose(f).translations[0].y = 0.25f * float(f);
  const auto file = join(flat.clip);
  Clip edited = file->clip();
  edited.resize(10);
  std::vector<double> frames;
  for (int f = 0; f < 10; ++f) {
    frames.push_back(2 * f);
    const ConstPose from = file->clip().pose(2 * f);
    std::copy(from.rotations.begin(), from.rotations.end(), edited.pose(f).rotations.begin());
    std::copy(from.translations.begin(), from.translations.end(),
              edited.pose(f).translations.begin());
  }
  file->encode(edited, frames);
  ASSERT_EQ(encoded_.frames, 10);
  for (int f = 0; f < 10; ++f) EXPECT_EQ(encoded_.pose(f).translations[0].y, 0.5f * float(f));
}

TEST_F(DeformSkeleton, what_hangs_together_or_deforms_nothing_stays_as_it_is) {
  Clip walk = test::walking_clip(4);
  for (Joint& joint : walk.skeleton.joints) joint.skin = 0, joint.skin_weight = 10;
  EXPECT_EQ(join(walk)->clip().joints(), walk.joints());
  EXPECT_NE(dynamic_cast<OneClip*>(join(walk).get()), nullptr);
  EXPECT_NE(dynamic_cast<OneClip*>(join(flat_walk(false).clip).get()), nullptr);
  Clip told = flat_walk().clip;
  told.skeleton.joints[1].role = "leftUpperLeg";
  EXPECT_NE(dynamic_cast<OneClip*>(join(told).get()), nullptr);
  EXPECT_EQ(dynamic_cast<OneClip*>(join(flat_walk().clip).get()), nullptr);
}

TEST_F(DeformSkeleton, what_has_fewer_joints_than_a_person_is_a_prop) {
  Clip clip = flat_walk().clip;
  const auto keep = [&](size_t max) {
    size_t count = 0;
    for (Joint& joint : clip.skeleton.joints) {
      if (joint.skin >= 0 && ++count > max) joint.skin = -1;
    }
  };
  keep(11);
  EXPECT_EQ(join(clip)->clip().joints(), 11u);
  keep(10);
  EXPECT_EQ(join(clip)->clip().joints(), clip.joints());
}

TEST_F(DeformSkeleton, a_skeleton_without_a_mesh_beside_it_is_left_out) {
  // Rigify's metarig: a whole person that nothing follows.
  Flat flat = flat_walk();
  const Clip walk = test::walking_clip(flat.clip.frames);
  Clip both;
  both.frame_time = walk.frame_time;
  const auto own = static_cast<int>(walk.joints());
  both.skeleton = walk.skeleton;
  for (Joint joint : flat.clip.skeleton.joints) {
    joint.parent += joint.parent < 0 ? 0 : own;
    joint.name = "DEF-" + joint.name;
    both.skeleton.joints.push_back(joint);
  }
  both.resize(walk.frames);
  for (int f = 0; f < walk.frames; ++f) {
    const ConstPose a = walk.pose(f), b = flat.clip.pose(f);
    const Pose to = both.pose(f);
    std::copy(a.rotations.begin(), a.rotations.end(), to.rotations.begin());
    std::copy(b.rotations.begin(), b.rotations.end(), to.rotations.begin() + own);
    std::copy(a.translations.begin(), a.translations.end(), to.translations.begin());
    std::copy(b.translations.begin(), b.translations.end(), to.translations.begin() + own);
  }
  const auto file = join(both);
  EXPECT_EQ(file->clip().joints(), walk.joints());
  EXPECT_EQ(parent_of(file->clip(), "DEF-leftUpperArm"), "DEF-leftShoulder");
}

}  // namespace
}  // namespace panache
