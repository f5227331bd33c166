#include "clip/fbx_encode.h"

#include <algorithm>
#include <cassert>
#include <cmath>

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
  std::vector<std::vector<Vec3d>> angles(joints), places(joints);
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
      const auto& [translation, rotation, scale] = poser.place(j).parts;
      const bool turns = !(now.rotations[j] == then.rotations[j]);
      const bool moves = !(now.translations[j] == then.translations[j]) ||
                         !(poser.above(j) == above[j]) ||
                         (turns && !(model.below_rotation(scale) == Vec3d{}));
      const Quatd own = poser.file_rotation(j, now.rotations[j]);
      const Vec3d near = i == 0 ? rotation : angles[j].back();
      angles[j].push_back(turns ? model.angles_of(own, near) : unwound(rotation, near));
      places[j].push_back(moves ? poser.file_translation(j, now.translations[j], own)
                                : translation);
      turned[j] = turned[j] || turns;
      moved[j] = moved[j] || moves;
    }
  }
  for (size_t j = 0; j < joints; ++j) {
    const auto model = static_cast<size_t>(document_.joint_models[j]);
    if (turned[j]) parts_[{model, kFbxRotation}] = std::move(angles[j]);
    if (moved[j]) parts_[{model, kFbxTranslation}] = std::move(places[j]);
  }
}

}  // namespace panache
