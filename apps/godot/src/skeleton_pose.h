#pragma once
// Converts a Skeleton3D and its poses to the library's.

#include <panache/panache.h>

#include <memory>
#include <string>
#include <vector>

#include "engine.h"

namespace panache::godot {

// Names used in each frame, created once.
struct Names {
  Name get_skeleton{"get_skeleton"}, get_version{"get_version"}, get_bone_count{"get_bone_count"},
      get_bone_name{"get_bone_name"}, get_bone_parent{"get_bone_parent"},
      get_bone_rest{"get_bone_rest"}, get_bone_pose_rotation{"get_bone_pose_rotation"},
      get_bone_pose_position{"get_bone_pose_position"},
      set_bone_pose_rotation{"set_bone_pose_rotation"},
      set_bone_pose_position{"set_bone_pose_position"},
      get_global_transform{"get_global_transform"},
      get_modifier_callback_mode_process{"get_modifier_callback_mode_process"},
      get_process_delta_time{"get_process_delta_time"},
      get_physics_process_delta_time{"get_physics_process_delta_time"},
      notify_property_list_changed{"notify_property_list_changed"};
};

// The bones of a Skeleton3D, parents first, below a joint that stands for the node and carries the
// root motion. In the node's units; the floor is at the node's height.
class SkeletonPose {
 public:
  // Takes the bones that the node has now. On failure skeleton() is null, and error() says why.
  SkeletonPose(const Names& names, const Value& node);

  const panache_skeleton* skeleton() const { return skeleton_.get(); }
  const std::string& error() const { return error_; }

  // Reads the pose of the bones, and the node's position in the world.
  panache_input_pose read(const Names& names, const Value& node);
  // The output buffer of a step.
  panache_output_pose out() { return {out_rotations_.data(), out_translations_.data()}; }
  // Writes to the node what the step changed.
  void write(const Names& names, const Value& node) const;

 private:
  struct Destroy {
    void operator()(panache_skeleton* skeleton) const { panache_skeleton_destroy(skeleton); }
  };
  std::unique_ptr<panache_skeleton, Destroy> skeleton_;
  std::string error_;
  std::vector<int64_t> bones_;  // The bone of each joint after the first.
  std::vector<float> rotations_, translations_, out_rotations_, out_translations_;
};

}  // namespace panache::godot
