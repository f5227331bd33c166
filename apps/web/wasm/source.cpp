#include "source.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "rig/canonical_skeleton.h"

namespace panache::web {
namespace {

Clip rest_clip() {
  Clip clip;
  clip.skeleton = canonical_skeleton();
  clip.resize(1);
  for (size_t j = 0; j < clip.joints(); ++j) {
    clip.rotations[j] = clip.skeleton.joints[j].rest;
    clip.translations[j] = clip.skeleton.joints[j].offset;
  }
  return clip;
}

Clip short_walk(std::shared_ptr<const WalkerModel> model) {
  WalkClipOptions options;
  options.seconds = 2;
  return walk_clip(std::move(model), options);
}

// The canonical skeleton is a humanoid.
Rig known_rig(const Clip& clip) {
  Result<Rig> rig = Rig::create(clip);
  assert(rig.ok());
  return *std::move(rig);
}

}  // namespace

WalkerSource::WalkerSource(std::shared_ptr<const WalkerModel> model)
    : walker_(model), clip_(short_walk(model)), t_pose_(rest_clip()), rig_(known_rig(clip_)) {}

bool WalkerSource::advance(double seconds, Pose out) {
  walker_.step(speed_, turn_, seconds, out);
  return false;
}

Result<std::unique_ptr<ClipSource>> ClipSource::create(std::shared_ptr<const MotionFile> file,
                                                       int which) {
  Result<Rig> rig = Rig::create(file->clip(which));
  if (!rig) return rig.error();
  return std::unique_ptr<ClipSource>(new ClipSource(std::move(file), which, *std::move(rig)));
}

ClipSource::ClipSource(std::shared_ptr<const MotionFile> file, int which, Rig rig)
    : file_(std::move(file)),
      which_(which),
      rig_(std::move(rig)),
      lookout_(file_->clip(which_), rig_) {
  first_ = std::min(rig_.first_frame(), clip().frames - 1);
  last_ = clip().frames - 1 - first_;
}

void ClipSource::seek(double seconds) {
  head_ = std::isfinite(seconds) ? std::clamp(seconds, 0.0, duration()) : 0;
  cut_ = true;
}

bool ClipSource::advance(double seconds, Pose out) {
  bool cut = cut_;
  if (!cut_) head_ += seconds;
  cut_ = false;
  if (head_ > duration()) {
    cut = loop_;
    head_ = loop_ && duration() > 0 ? std::fmod(head_, duration()) : duration();
  }
  const double frame = first_ + head_ / clip().frame_time;
  sample(clip(), frame, out);
  if (cut) lookout_.restart(frame);
  flight_ = lookout_.flight(frame);
  return cut;
}

}  // namespace panache::web
