#include "source.h"

#include <algorithm>
#include <cmath>

#include "rig/canonical_body.h"

namespace panache::web {

Source::Source(std::shared_ptr<const WalkerModel> model)
    : walker_(model),
      clip_(std::make_shared<Clip>(walk_clip(model, {.seconds = 2}))),
      rig_(*Rig::create(*clip_)),  // Cannot fail: the canonical skeleton is a humanoid.
      reference_(rest_clip(canonical_skeleton())) {}

Result<Source> Source::create(std::shared_ptr<const MotionFile> file, int which) {
  Result<Rig> rig = Rig::create(file->clip(which));
  if (!rig) return rig.error();
  return Source(std::move(file), which, *std::move(rig));
}

Source::Source(std::shared_ptr<const MotionFile> file, int which, Rig rig)
    : file_(std::move(file)),
      which_(which),
      clip_(file_, &file_->clip(which)),
      rig_(std::move(rig)),
      first_(std::min(rig_.first_frame(), clip().frames - 1)),
      last_(clip().frames - 1 - first_) {
  clip_head_.emplace(clip(), rig_);
  reference_.skeleton = clip().skeleton;
  reference_.append(clip().pose(first_));
}

void Source::seek(double seconds) {
  head_ = std::isfinite(seconds) ? std::clamp(seconds, 0.0, duration()) : 0;
  cut_ = true;
}

bool Source::advance(double seconds, Pose out) {
  if (walker_) {
    walker_->step(speed_, turn_, seconds, out);
    return false;
  }
  bool cut = cut_;
  if (!cut_) head_ += seconds;
  cut_ = false;
  if (head_ > duration()) {
    cut = loop_;
    head_ = loop_ && duration() > 0 ? std::fmod(head_, duration()) : duration();
  }
  const double frame = first_ + head_ / clip().frame_time;
  if (cut) clip_head_->restart(frame);
  flight_ = clip_head_->show(frame, out);
  return cut;
}

}  // namespace panache::web
