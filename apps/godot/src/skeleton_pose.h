#pragma once
// A Skeleton3D as a skeleton of the library, and its poses.

#include <panache/panache.h>

#include <memory>
#include <string>
#include <vector>

#include "engine.h"

namespace panache::godot {

// Names that are used in each frame, made once.
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

// The bones of a Skeleton3D, parents first, below a joint that stands for the node itself and so
// carries the root motion. In the node's units; the floor is where the node stands.
class SkeletonPose {
 public:
  // As many bones as the node has now. On failure skeleton() is null, and error() says why.
  SkeletonPose(const Names& names, const Value& node);

  const panache_skeleton* skeleton() const { return skeleton_.get(); }
  const std::string& error() const { return error_; }

  // The pose of the bones, and where the node stands in the world.
  panache_input_pose read(const Names& names, const Value& node);
  // Where a step writes to.
  panache_output_pose out() { return {out_rotations_.data(), out_translations_.data()}; }
  // Sets what the step changed.
  void write(const Names& names, const Value& node) const;

 private:
  struct Destroy {
    void operator()(panache_skeleton* skeleton) const { panache_skeleton_destroy(skeleton); }
  };
  std::unique_ptr<panache_skeleton, Destroy> skeleton_;
  std::string error_;
  std::vector<int64_t> bones_;  // Of each joint after the first.
  std::vector<float> rotations_, translations_, out_rotations_, out_translations_;
};

}  // namespace panache::godot
