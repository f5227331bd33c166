#pragma once
// The scales of a glTF file's nodes while an animation plays, and their effect on its poses.
// Private to the folder.

#include <span>
#include <vector>

#include "clip/gltf_document.h"

namespace panache {

class GltfScales {
 public:
  // `tracks`: [channels of `animation`], of which those of scales are read; without an animation,
  // the scales are those of the rest pose. All of it outlives the object.
  explicit GltfScales(const GltfDocument& document) : document_(document) {}
  GltfScales(const GltfDocument& document, const GltfAnimation& animation,
             std::span<const GltfTrack> tracks);

  // Sets the time, seconds in the file, and the pose: [joints] rotations in the file's terms, which
  // are converted to the clip's; or those of the clip, which stay.
  void set_file_pose(double seconds, double tolerance, std::span<Quat> rotations);
  void set_clip_pose(double seconds, double tolerance, std::span<const Quat> rotations);

  // Once they are set: the half turn of the joint's own scale, and the effect of the nodes above
  // the joint on its position.
  Quat turn(size_t joint) const { return own_[joint].turn; }
  const Stretch& above(size_t joint) const { return above_[joint]; }

 private:
  struct Moving {
    int joint;
    const GltfTrack* track;
  };

  void set_time(double seconds, double tolerance);
  void set_above(size_t joint, std::span<const Quat> rotations);

  const GltfDocument& document_;
  std::vector<Moving> tracks_;  // For nodes above joints, if they differ from the node's own scale.
  std::vector<NodeScale> own_;  // [joints]
  std::vector<Stretch> above_;  // [joints]
};

// Fills the frames of an animation, for all joints; a joint that a channel or a scale moves becomes
// one that translates. tracks: [channels]. Returns the channel that moves a joint too far, or -1.
int fill_clip(const GltfDocument& document, GltfAnimation& animation,
              std::span<const GltfTrack> tracks, GltfScales& scales);

// Whether a clip may contain this position.
bool is_within_reach(Vec3 position);

}  // namespace panache
