#include "style/play/clip_stepper.h"

#include <algorithm>

namespace panache {

ClipStepper::ClipStepper(const Clip& clip, const Rig& rig, ChangeSource& source,
                         const StylizerOptions& options)
    : clip_(clip),
      source_(source),
      stepper_(rig, source.layout(), options),
      lookout_(clip, rig),
      rotations_(clip.joints()),
      translations_(clip.joints()) {
  const int second = std::min(rig.first_frame(), clip.frames - 1) + 1;
  if (second >= clip.frames || !(clip.frame_time > 0)) return;
  sample(clip, second, {rotations_, translations_});
  next_ = stepper_.see_next(pose(), clip.frame_time);
}

void ClipStepper::step(double frame, double advance, double seconds) {
  const Pose pose = {rotations_, translations_};
  sample(clip_, frame, pose);
  flight_ = lookout_.flight(frame);
  const StepMoment moment = {advance * clip_.frame_time, clip_.frame_time, flight_, seconds,
                             next_ ? &*next_ : nullptr};
  gate_ = stepper_.step(pose, moment, source_, pose).gate;
}

FootContacts ClipStepper::contacts() const {
  const std::span<const float> planted = stepper_.contacts();
  return {planted[0] > 0.5f, planted[1] > 0.5f};
}

}  // namespace panache
