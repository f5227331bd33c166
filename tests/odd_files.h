#pragma once
// Files of tests/fixtures/odd: a walk of 1.1 s, each time in a file of a kind that makers write and
// that is easy to read wrongly.

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "clip/motion_file.h"
#include "make_clip.h"

namespace panache::test {

inline std::string odd_path(const std::string& name) {
  return PANACHE_SOURCE_DIR "/tests/fixtures/odd/" + name;
}
inline std::unique_ptr<MotionFile> odd_file(const std::string& name) {
  auto file = read_motion(odd_path(name));
  EXPECT_TRUE(file.ok()) << file.error().message;
  return file ? *std::move(file) : nullptr;
}
inline Clip odd_clip(const std::string& name) { return odd_file(name)->clip(0); }
// The same walk, written plainly; it lacks the node above the hips that the GLB files have.
inline Clip plain_walk() {
  Clip clip = odd_clip("one-metre-up.bvh");
  for (int f = 0; f < clip.frames; ++f) clip.pose(f).translations[0].y -= 1;
  return clip;
}

inline int find_joint_named(const Clip& clip, const std::string& name, int nth = 0) {
  for (size_t j = 0; j < clip.joints(); ++j) {
    if (clip.skeleton.joints[j].name == name && nth-- == 0) return static_cast<int>(j);
  }
  ADD_FAILURE() << "no joint " << name;
  return 0;
}

// Positions of all joints in the world, file units: [frames][joints].
inline std::vector<std::vector<Vec3>> world_positions(const Clip& clip) {
  std::vector<std::vector<Vec3>> out;
  for (int f = 0; f < clip.frames; ++f) {
    out.push_back(world_positions(clip, f));
  }
  return out;
}

// A joint after all others that copies another one, below `parent`.
inline int add_copy(Clip& clip, const std::string& name, int of, int parent) {
  const size_t old = clip.joints();
  Clip extended = clip;
  Joint joint = clip.skeleton.joints[of];
  joint.name = name;
  joint.parent = parent;
  extended.skeleton.joints.push_back(joint);
  extended.resize(clip.frames);
  for (int f = 0; f < clip.frames; ++f) {
    for (size_t j = 0; j <= old; ++j) {
      const size_t from = j < old ? j : static_cast<size_t>(of);
      extended.pose(f).rotations[j] = clip.pose(f).rotations[from];
      extended.pose(f).translations[j] = clip.pose(f).translations[from];
    }
  }
  clip = extended;
  return static_cast<int>(old);
}

// MikuMikuDance's: the mesh follows copies of the leg's joints, which hang on the hips.
inline Clip with_copied_leg(Clip clip) {
  int parent = find_joint_named(clip, "hips");
  for (const char* name : {"leftUpperLeg", "leftLowerLeg", "leftFoot"}) {
    parent = add_copy(clip, std::string(name) + "D", find_joint_named(clip, name), parent);
    clip.skeleton.joints[parent].skin = 0;
  }
  return clip;
}

// With a joint on the floor above the hips.
inline Clip with_root(const Clip& clip) {
  Clip out;
  out.frame_time = clip.frame_time;
  Joint root;
  root.name = "root";
  root.can_rotate = root.can_translate = true;
  out.skeleton.joints.push_back(root);
  for (Joint joint : clip.skeleton.joints) {
    ++joint.parent;
    out.skeleton.joints.push_back(joint);
  }
  out.resize(clip.frames);
  for (int f = 0; f < clip.frames; ++f) {
    out.pose(f).rotations[0] = {};
    out.pose(f).translations[0] = {};
    for (size_t j = 0; j < clip.joints(); ++j) {
      out.pose(f).rotations[j + 1] = clip.pose(f).rotations[j];
      out.pose(f).translations[j + 1] = clip.pose(f).translations[j];
    }
  }
  return out;
}

// Without the joints from the first of `names` on that hang below them, or are they.
inline Clip without(const Clip& clip, const std::vector<std::string>& names) {
  std::vector<int> kept, new_index(clip.joints(), -1);
  Clip out;
  out.frame_time = clip.frame_time;
  for (size_t j = 0; j < clip.joints(); ++j) {
    Joint joint = clip.skeleton.joints[j];
    const bool named = std::find(names.begin(), names.end(), joint.name) != names.end();
    if (named || (joint.parent >= 0 && new_index[joint.parent] < 0)) continue;
    new_index[j] = static_cast<int>(kept.size());
    kept.push_back(static_cast<int>(j));
    if (joint.parent >= 0) joint.parent = new_index[joint.parent];
    out.skeleton.joints.push_back(joint);
  }
  out.resize(clip.frames);
  for (int f = 0; f < clip.frames; ++f) {
    for (size_t j = 0; j < kept.size(); ++j) {
      out.pose(f).rotations[j] = clip.pose(f).rotations[kept[j]];
      out.pose(f).translations[j] = clip.pose(f).translations[kept[j]];
    }
  }
  return out;
}

// Left and right exchanged in the names of these joints.
inline Clip with_exchanged_names(Clip clip, const std::vector<std::string>& parts) {
  for (Joint& joint : clip.skeleton.joints) {
    const bool left = joint.name.starts_with("left"), right = joint.name.starts_with("right");
    if (!left && !right) continue;
    const std::string part = joint.name.substr(left ? 4 : 5);
    if (std::find(parts.begin(), parts.end(), part) == parts.end()) continue;
    joint.name = (left ? "right" : "left") + part;
  }
  return clip;
}

}  // namespace panache::test
