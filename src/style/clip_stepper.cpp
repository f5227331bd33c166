#include "style/clip_stepper.h"

#include <algorithm>

namespace panache {

Result<ClipStepper> ClipStepper::create(const Clip& clip, const Rig& rig,
                                        const std::shared_ptr<const Model>& model,
                                        const std::vector<StrengthTrack>& tracks,
                                        const StylizerOptions& options) {
  Result<Stylizer> stylizer = Stylizer::create(model, rig, options);
  if (!stylizer) return stylizer.error();
  return ClipStepper(clip, rig, *std::move(stylizer), tracks);
}

ClipStepper::ClipStepper(const Clip& clip, const Rig& rig, Stylizer stylizer,
                         const std::vector<StrengthTrack>& tracks)
    : clip_(clip),
      tracks_(tracks),
      stylizer_(std::move(stylizer)),
      lookout_(clip, rig),
      strengths_(stylizer_.model().styles().size()),
      rotations_(clip.joints()),
      translations_(clip.joints()) {
  const int second = std::min(rig.first_frame(), clip.frames - 1) + 1;
  if (second >= clip.frames || !(clip.frame_time > 0)) return;
  sample(clip, second, {rotations_, translations_});
  stylizer_.set_next(pose(), clip.frame_time);
}

void ClipStepper::step(double frame, double advance, double seconds) {
  std::fill(strengths_.begin(), strengths_.end(), 0.0f);
  for (const StrengthTrack& track : tracks_) strengths_[track.style] += track.at(seconds);
  const Pose pose = {rotations_, translations_};
  sample(clip_, frame, pose);
  flight_ = lookout_.flight(frame);
  stylizer_.step(pose, strengths_, {advance * clip_.frame_time, clip_.frame_time, flight_}, pose);
}

FootContacts ClipStepper::contacts() const {
  const std::span<const float> planted = stylizer_.contacts();
  return {planted[0] > 0.5f, planted[1] > 0.5f};
}

void ClipStepper::append_to(Restyled& result, double source_frame) const {
  result.clip.append(pose());
  result.source_frames.push_back(source_frame);
  result.contacts.push_back(contacts());
  result.gates.push_back(stylizer_.gate());
  result.stages.push_back(stylizer_.stage_facts());
}

void append_calibration(const Clip& clip, int first, Restyled& result) {
  for (int f = 0; f < first; ++f) {
    result.clip.append(clip.pose(f));
    result.source_frames.push_back(f);
    result.contacts.push_back({});
    result.gates.push_back(1);
    result.stages.push_back({});
  }
}

}  // namespace panache
