#pragma once
// The new frames of one motion in the terms of an FBX file. Private to the folder.

#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "clip/fbx_document.h"
#include "clip/motion_file.h"

namespace panache {

class FbxBake {
 public:
  // Both outlive the object.
  FbxBake(const FbxDocument& document, const ClipEdit& edit);

  // The motion that the frames come from; null for a new one.
  const FbxStack* stack() const { return stack_; }
  std::span<const int64_t> times() const { return times_; }
  // Whether each frame comes from the same one of the file.
  bool keeps_time() const { return keeps_time_; }
  // The time in the file of the frame that a new one came from.
  int64_t source_time(size_t frame) const;
  // [frames] numbers by model and part, for the parts of joints that changed.
  const std::map<std::pair<size_t, size_t>, std::vector<Vec3d>>& parts() const { return parts_; }

 private:
  const Clip& clip() const { return stack_ ? stack_->clip : document_.rest; }
  const FbxModel& model_of(size_t joint) const;
  void bake();

  const FbxDocument& document_;
  const Clip& changed_;
  const FbxStack* stack_;
  std::vector<double> source_frames_;
  std::vector<int64_t> times_;
  bool keeps_time_ = false;
  std::map<std::pair<size_t, size_t>, std::vector<Vec3d>> parts_;
};

}  // namespace panache
