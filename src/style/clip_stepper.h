#pragma once
// A stylizer that is led through a clip, frame by frame.

#include <vector>

#include "style/flight_lookout.h"
#include "style/restyle.h"

namespace panache {

// The clip outlives it.
class ClipStepper {
 public:
  static Result<ClipStepper> create(const Clip& clip, const Rig& rig,
                                    const std::shared_ptr<const Model>& model,
                                    const std::vector<StrengthTrack>& tracks,
                                    const StylizerOptions& options);

  // Styles the pose at `frame` (fractional, never before the last one), `advance` frames after the
  // last one; `seconds`: which strengths it gets, a time of the input.
  void step(double frame, double advance, double seconds);

  // Of the last step.
  ConstPose pose() const { return {rotations_, translations_}; }
  const Stylizer& stylizer() const { return stylizer_; }
  float flight() const { return flight_; }
  FootContacts contacts() const;
  // Adds it to the result.
  void append_to(Restyled& result, double source_frame) const;

 private:
  ClipStepper(const Clip& clip, const Rig& rig, Stylizer stylizer,
              const std::vector<StrengthTrack>& tracks);

  const Clip& clip_;
  std::vector<StrengthTrack> tracks_;
  Stylizer stylizer_;
  FlightLookout lookout_;
  float flight_ = 0;
  std::vector<float> strengths_;
  std::vector<Quat> rotations_;
  std::vector<Vec3> translations_;
};

// The frames of a calibration pose in front of the motion as they are: it is no motion.
void append_calibration(const Clip& clip, int first, Restyled& result);

}  // namespace panache
