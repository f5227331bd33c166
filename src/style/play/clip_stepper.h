#pragma once
// Steps a character through a clip, frame by frame.

#include <optional>
#include <vector>

#include "clip/clip.h"
#include "style/play/flight_lookout.h"
#include "style/stepper.h"

namespace panache {

class ClipStepper {
 public:
  // Clip and source must outlive it.
  ClipStepper(const Clip& clip, const Rig& rig, ChangeSource& source,
              const StylizerOptions& options);

  // Steps to the pose at `frame` (fractional, never before the last one), `advance` frames after
  // the last one; `seconds`: the clip time given to the source.
  void step(double frame, double advance, double seconds);

  // Results of the last step.
  ConstPose pose() const { return {rotations_, translations_}; }
  const BodyChange& change() const { return stepper_.change(); }
  double rate() const { return stepper_.rate(); }
  float flight() const { return flight_; }
  float gate() const { return gate_; }
  FootContacts contacts() const;
  StageFacts stage_facts() const { return stepper_.stage_facts(); }

 private:
  const Clip& clip_;
  ChangeSource& source_;
  Stepper stepper_;
  FlightLookout lookout_;
  std::optional<NextPose> next_;  // The second pose.
  float flight_ = 0, gate_ = 1;
  std::vector<Quat> rotations_;
  std::vector<Vec3> translations_;
};

}  // namespace panache
