#pragma once
// What the tests of glTF files share.

#include <memory>
#include <string>
#include <vector>

#include "clip/clip.h"
#include "clip/gltf.h"
#include "fixtures.h"
#include "make_character.h"
#include "make_clip.h"

namespace panache {

// The file, which has to be readable.
inline std::unique_ptr<MotionFile> must_read(const std::string& bytes) {
  auto file = parse_gltf(bytes, "walk.glb");
  if (!file) {
    ADD_FAILURE() << file.error().message;
    return nullptr;
  }
  const size_t clips = std::max<size_t>((*file)->clip_names().size(), 1);
  for (size_t i = 0; i < clips; ++i) {
    EXPECT_EQ(broken_promise((*file)->clip(static_cast<int>(i))), "");
  }
  return std::move(*file);
}
inline std::unique_ptr<MotionFile> must_read(const test::GltfParts& parts) {
  return must_read(test::to_glb(parts));
}

// The message that says why the file is none.
inline std::string gltf_rejection(const std::string& bytes) {
  auto file = parse_gltf(bytes, "walk.glb");
  return file.ok() ? "(accepted)" : file.error().message;
}
inline std::string gltf_rejection(const test::GltfParts& parts) {
  return gltf_rejection(test::to_glb(parts));
}

inline size_t joint_named(const Clip& clip, const std::string& name) {
  for (size_t j = 0; j < clip.joints(); ++j) {
    if (clip.skeleton.joints[j].name == name) return j;
  }
  ADD_FAILURE() << "no joint " << name;
  return 0;
}

using test::world_positions;

// The file with one clip changed, whose frames come from `frames`; without those, each from itself.
inline std::string edited(const MotionFile& file, const Clip& changed,
                          const std::vector<double>& frames, EditMode mode, int clip = 0,
                          const std::string& name = "new") {
  const ClipEdit edit = {clip, &changed, frames, name};
  return file.encode({&edit, 1}, mode);
}
inline std::string edited(const MotionFile& file, const Clip& changed, EditMode mode,
                          int clip = 0) {
  return edited(file, changed, same_frames(changed.frames), mode, clip);
}

// Adds a channel of the first sampler that only the owner of an extension understands.
inline void add_extension_channel(test::GltfParts& parts) {
  const test::Json pointer = {{"pointer", "/materials/0/alpha"}};
  parts.json["animations"][0]["channels"].push_back(
      {{"sampler", 0},
       {"target", {{"path", "pointer"}, {"extensions", {{"KHR_animation_pointer", pointer}}}}}});
}

// Turns a joint in all frames by `angle` about its own z axis.
inline void turn(Clip& clip, size_t joint, float angle) {
  for (int f = 0; f < clip.frames; ++f) {
    Quat& q = clip.pose(f).rotations[joint];
    q = normalized(q.as<double>() * axis_angle(Vec3{0, 0, 1}, angle).as<double>()).as<float>();
  }
}

}  // namespace panache
