#pragma once
// MotionFile::encode for an FBX 7 file, and the objects of animation in new files. Private to the
// folder.

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "clip/fbx_document.h"
#include "clip/fbx_writer.h"
#include "clip/motion_file.h"

namespace panache {

// The file with the edits.
std::string encode_fbx(const FbxDocument& document, std::span<const ClipEdit> edits, EditMode mode);
// The file without its motions.
std::string encode_still_fbx(const FbxDocument& document);
// fbx_format.cpp: the same for a file of version 6, as a new one of version 7.
std::string encode_fbx6(const FbxDocument& document, std::span<const ClipEdit> edits,
                        EditMode mode);
// The file with all keys at times that are `factors` [stacks] times as late, relative to the first
// key of their motion, and with this rate as its own.
std::string retime_fbx(const FbxDocument& document, std::span<const double> factors, double fps);

// Keys at these times, [keys], with straight lines between them, or steps.
struct FbxKeys {
  std::span<const int64_t> times;
  std::span<const float> values;
  bool are_steps = false;
};
// Writes them to an AnimationCurve. `is_text`: for a text file, which has the bits of floats.
void set_fbx_keys(const FbxKeys& keys, bool is_text, FbxNewNode& curve);
FbxNewNode new_fbx_curve(int64_t id, const FbxKeys& keys, bool is_text);
// For a property of a model, with these values where there is no curve.
FbxNewNode new_fbx_curve_node(int64_t id, size_t part, Vec3d still);
// `P: NAME, TYPE, LABEL, "", NUMBER` of a time.
FbxNewNode fbx_time_property(const std::string& name, int64_t time);
FbxNewNode new_fbx_stack(int64_t id, const std::string& name, int64_t begin, int64_t end);
FbxNewNode new_fbx_layer(int64_t id);
FbxNewNode new_fbx_take(const std::string& name, int64_t begin, int64_t end);
FbxNewNode new_fbx_connection(int64_t child, int64_t parent, const std::string& property = "");

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
