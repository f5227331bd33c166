#include "eval/systems/change_stepper.h"

#include <algorithm>

#include "style/flight_lookout.h"
#include "style/stylizer.h"

namespace panache {
namespace {

constexpr Shape kShape;  // Neutral.

}  // namespace

ChangeStepper::ChangeStepper(Rig rig, ChangeSource& source, float amount)
    : source_(source),
      amount_(amount),
      observer_(std::move(rig)),
      window_(PoseLayout::positions),
      stages_(StylizerOptions().smoothing_seconds) {}

void ChangeStepper::forget() {
  started_ = false;
  source_.reset();
  window_.reset();
  stages_.reset();
}

void ChangeStepper::step(ConstPose in, float frame, float flight, double input_seconds,
                         double output_seconds, Pose out) {
  flight_ = flight;
  if (!observer_.observe(in, input_seconds)) forget();
  const StepTime time{input_seconds, static_cast<float>(output_seconds), !started_};
  started_ = true;
  std::array<float, InputWindow::kMaxNumbers> room;
  const std::span<const float> seen = window_.step(observer_.now(), time, room);
  const AskedChange asked = source_.answer(seen, frame, time.output);
  stages_.step(asked, {kShape, amount_, flight_}, observer_, window_, time, nullptr);
  observer_.write(stages_.change(), out);
}

double ChangeStepper::rate() const { return stages_.rate(kShape.timing, flight_); }

ChangedClip change_clip(const TestInput& input, ChangeSource& source, float amount, bool timing) {
  const Clip& clip = input.clip;
  ChangedClip result;
  result.clip.skeleton = clip.skeleton;
  result.clip.frame_time = clip.frame_time;
  // A calibration pose in front is no motion.
  const int first = std::min(input.rig.first_frame(), clip.frames - 1);
  for (int f = 0; f < first; ++f) {
    result.clip.append(clip.pose(f));
    result.source_frames.push_back(f);
  }
  std::vector<Quat> rotations(clip.joints());
  std::vector<Vec3> translations(clip.joints());
  const Pose pose{rotations, translations};
  ChangeStepper stepper(input.rig, source, amount);
  FlightLookout lookout(clip, input.rig);
  double frame = first, advance = 0;
  while (frame <= clip.frames - 1 + 1e-6) {
    sample(clip, frame, pose);
    const float flight = lookout.flight(frame);
    stepper.step(pose, static_cast<float>(input.take_frame(frame)), flight,
                 advance * clip.frame_time, clip.frame_time, pose);
    result.clip.append(pose);
    result.source_frames.push_back(frame);
    advance = timing ? clip_advance(frame, stepper.rate(), flight) : 1.0;
    frame += advance;
  }
  return result;
}

}  // namespace panache
