#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>

#include "clip/fbx_encode.h"

namespace panache {
namespace {

// The file's own angles, by whole turns from those of the frame before.
Vec3d unwound(Vec3d own, Vec3d near) {
  const auto one = [](double a, double b) { return a + 360 * std::round((b - a) / 360); };
  return {one(own.x, near.x), one(own.y, near.y), one(own.z, near.z)};
}

}  // namespace

FbxBake::FbxBake(const FbxDocument& document, const ClipEdit& edit)
    : document_(document),
      changed_(*edit.changed),
      // A change of the rest pose, if the file has no motion.
      stack_(edit.clip == kNewClip || document.stacks.empty()
                 ? nullptr
                 : &document.stacks[static_cast<size_t>(edit.clip)]),
      source_frames_(edit.source_frames.begin(), edit.source_frames.end()) {
  if (edit.clip == kNewClip) source_frames_.assign(static_cast<size_t>(changed_.frames), 0.0);
  assert(changed_.joints() == clip().joints() && changed_.frames > 0);
  assert(source_frames_.size() == static_cast<size_t>(changed_.frames));
  keeps_time_ = stack_ && changed_.frames == clip().frames;
  for (size_t i = 0; i < source_frames_.size(); ++i) {
    keeps_time_ = keeps_time_ && source_frames_[i] == static_cast<double>(i);
  }
  const double frame_time = stack_ ? clip().frame_time : changed_.frame_time;
  for (int i = 0; i < changed_.frames; ++i) {
    times_.push_back((stack_ ? stack_->begin : 0) + std::llround(i * frame_time * kFbxSecond));
  }
  bake();
}

int64_t FbxBake::source_time(size_t frame) const {
  if (!stack_) return 0;
  const double last = clip().frames - 1;
  return stack_->time_of(std::clamp(source_frames_[frame], 0.0, last));
}

const FbxModel& FbxBake::model_of(size_t joint) const {
  return document_.models[static_cast<size_t>(document_.joint_models[joint])];
}

void FbxBake::bake() {
  FbxPoser poser(document_, stack_);
  const size_t joints = clip().joints();
  Clip source;
  source.skeleton = clip().skeleton;
  source.resize(1);
  // Without a motion of the file, joints are as they were saved, which need not be at rest.
  poser.set_time(0);
  if (!stack_) poser.get_pose(source.pose(0));
  std::vector<Stretch> above(joints);
  std::vector<bool> turned(joints), moved(joints);
  std::vector<std::vector<Vec3d>> angles(joints), translations(joints);
  for (size_t i = 0; i < times_.size(); ++i) {
    const ConstPose now = changed_.pose(static_cast<int>(i));
    if (stack_) sample(clip(), source_frames_[i], source.pose(0));
    const ConstPose then = source.pose(0);
    poser.set_time(source_time(i));
    poser.set_rotations(then.rotations);
    for (size_t j = 0; j < joints; ++j) above[j] = poser.above(j);
    poser.set_rotations(now.rotations);
    for (size_t j = 0; j < joints; ++j) {
      const FbxModel& model = model_of(j);
      const auto& [translation, rotation, scale] = poser.channels(j).parts;
      const bool turns = !(now.rotations[j] == then.rotations[j]);
      const bool moves = !(now.translations[j] == then.translations[j]) ||
                         !(poser.above(j) == above[j]) ||
                         (turns && !(model.below_rotation(scale) == Vec3d{}));
      const Quatd own = poser.file_rotation(j, now.rotations[j]);
      const Vec3d near = i == 0 ? rotation : angles[j].back();
      angles[j].push_back(turns ? model.angles_of(own, near) : unwound(rotation, near));
      translations[j].push_back(moves ? poser.file_translation(j, now.translations[j], own)
                                      : translation);
      turned[j] = turned[j] || turns;
      moved[j] = moved[j] || moves;
    }
  }
  for (size_t j = 0; j < joints; ++j) {
    const auto model = static_cast<size_t>(document_.joint_models[j]);
    if (turned[j]) parts_[{model, kFbxRotation}] = std::move(angles[j]);
    if (moved[j]) parts_[{model, kFbxTranslation}] = std::move(translations[j]);
  }
}

// The objects of animation in FBX 7.
namespace {

using Value = FbxNewValue;

constexpr int32_t kLinearFlags = 24836, kStepFlags = 24834;  // As the FBX SDK writes them.
constexpr int32_t kPlainWeights = 255790911;                 // A third on both sides.

FbxNewNode named(const char* kind, int64_t id, const std::string& name) {
  FbxNewNode out{kind, {Value::whole(id), Value::string(name), Value::string("")}, {}, true};
  return out;
}

}  // namespace

void set_fbx_keys(const FbxKeys& keys, bool is_text, FbxNewNode& curve) {
  const int32_t flags[] = {keys.are_steps ? kStepFlags : kLinearFlags};
  const int32_t count[] = {static_cast<int32_t>(keys.times.size())};
  const int32_t data[] = {0, 0, kPlainWeights, 0};
  const float bits[] = {0, 0, std::bit_cast<float>(kPlainWeights), 0};
  curve.set("KeyTime", {Value::times(keys.times)});
  curve.set("KeyValueFloat", {Value::floats(keys.values)});
  curve.set("KeyAttrFlags", {Value::wholes(flags)});
  curve.set("KeyAttrDataFloat", {is_text ? Value::wholes(data) : Value::floats(bits)});
  curve.set("KeyAttrRefCount", {Value::wholes(count)});
}

FbxNewNode new_fbx_curve(int64_t id, const FbxKeys& keys, bool is_text) {
  FbxNewNode out = named("AnimationCurve", id, "AnimCurve::");
  out.add("Default", {Value::number(keys.values.empty() ? 0 : keys.values[0])});
  out.add("KeyVer", {Value::small(4008)});
  set_fbx_keys(keys, is_text, out);
  return out;
}

FbxNewNode new_fbx_curve_node(int64_t id, size_t part, Vec3d still) {
  FbxNewNode out = named("AnimationCurveNode", id, std::string("AnimCurveNode::") + "TRS"[part]);
  FbxNewNode& properties = out.add("Properties70");
  for (const auto& [name, number] :
       {std::pair("d|X", still.x), std::pair("d|Y", still.y), std::pair("d|Z", still.z)}) {
    properties.add("P", {Value::string(name), Value::string("Number"), Value::string(""),
                         Value::string("A"), Value::number(number)});
  }
  return out;
}

FbxNewNode fbx_time_property(const std::string& name, int64_t time) {
  return {"P",
          {Value::string(name), Value::string("KTime"), Value::string("Time"), Value::string(""),
           Value::whole(time)},
          {},
          false};
}

FbxNewNode new_fbx_stack(int64_t id, const std::string& name, int64_t begin, int64_t end) {
  FbxNewNode out = named("AnimationStack", id, "AnimStack::" + name);
  FbxNewNode& properties = out.add("Properties70");
  for (const auto& [of, time] :
       {std::pair("LocalStart", begin), std::pair("LocalStop", end),
        std::pair("ReferenceStart", begin), std::pair("ReferenceStop", end)}) {
    properties.add("P") = fbx_time_property(of, time);
  }
  return out;
}

FbxNewNode new_fbx_layer(int64_t id) { return named("AnimationLayer", id, "AnimLayer::BaseLayer"); }

FbxNewNode new_fbx_take(const std::string& name, int64_t begin, int64_t end) {
  FbxNewNode out{"Take", {Value::string(name)}, {}, true};
  out.add("FileName", {Value::string(name + ".tak")});
  out.add("LocalTime", {Value::whole(begin), Value::whole(end)});
  out.add("ReferenceTime", {Value::whole(begin), Value::whole(end)});
  return out;
}

FbxNewNode new_fbx_connection(int64_t child, int64_t parent, const std::string& property) {
  FbxNewNode out{
      "C",
      {Value::string(property.empty() ? "OO" : "OP"), Value::whole(child), Value::whole(parent)},
      {},
      false};
  if (!property.empty()) out.values.push_back(Value::string(property));
  return out;
}

}  // namespace panache
