#include "eval/systems/change_stepper.h"

#include <algorithm>
#include <cmath>

#include "style/rate.h"
#include "style/stages/balance.h"
#include "style/stylizer.h"

namespace panache {
namespace {

// Looks for flights ahead of the play head.
class Lookout {
 public:
  explicit Lookout(const TestInput& input)
      : clip_(input.clip), reader_(input.rig), next_(input.rig.first_frame()) {}

  float flight(double frame) {
    const double until = frame + kFlightAhead / clip_.frame_time;
    for (; next_ < clip_.frames && next_ <= until; ++next_) {
      BodyPose body;
      reader_.read(clip_.pose(next_), body);
      flights_.push(next_ * clip_.frame_time, body.positions);
    }
    return flights_.amount(frame * clip_.frame_time);
  }

 private:
  const Clip& clip_;
  PosedRig reader_;
  FlightWatch flights_;
  int next_;
};

void append(Clip& clip, ConstPose pose) {
  clip.rotations.insert(clip.rotations.end(), pose.rotations.begin(), pose.rotations.end());
  clip.translations.insert(clip.translations.end(), pose.translations.begin(),
                           pose.translations.end());
  ++clip.frames;
}

}  // namespace

ChangeStepper::ChangeStepper(Rig rig, ChangeSource& source, float amount)
    : source_(source),
      amount_(amount),
      observer_(std::move(rig)),
      window_(PoseLayout::positions),
      filter_(StylizerOptions().smoothing_seconds) {}

void ChangeStepper::forget() {
  started_ = false;
  source_.reset();
  window_.reset();
  filter_.reset();
  root_.reset();
  shaping_.reset();
  anatomy_.reset();
  floor_.reset();
  fall_.reset();
  foot_lock_.reset();
}

void ChangeStepper::step(ConstPose in, float frame, float flight, double input_seconds,
                         double output_seconds, Pose out) {
  flight_ = flight;
  if (!observer_.observe(in, input_seconds)) forget();
  const Observation& now = observer_.now();
  const StepTime time{input_seconds, static_cast<float>(output_seconds), !started_};
  started_ = true;
  window_.step(now, time);
  const StyleAnswer answer = source_.answer(window_.window(), frame, time.output);
  filter_.step(answer.change, answer.log_rate, time);
  root_.step(filter_.delta(), 1, observer_, window_, time);
  BodyChange change;
  shaping_.step(Shape{}, filter_.delta(), root_.offset(now.root), time, change);
  anatomy_.step(now.world, observer_.rig(), time, change);
  HumanPositions joints;
  changed_joints(now.world, change, joints);
  keep_balance(now.world, joints, change);
  floor_.step(now.world, joints, amount_, time, change);
  fall_.step(flight_, time, change);
  std::array<float, kFeet> contacts;
  for (size_t f = 0; f < kFeet; ++f) {
    contacts[f] = planted_near_floor(answer.contacts[f], now.world.positions[index(kToes[f])].y);
  }
  foot_lock_.step(now.world, joints, contacts, amount_, time.output, change);
  observer_.write(change, out);
}

double ChangeStepper::rate() const {
  return static_cast<double>(exponential(bounded_log_rate(filter_.log_rate()) * (1 - flight_)));
}

ChangedClip change_clip(const TestInput& input, ChangeSource& source, float amount, bool timing) {
  const Clip& clip = input.clip;
  ChangedClip result;
  result.clip.skeleton = clip.skeleton;
  result.clip.frame_time = clip.frame_time;
  // A calibration pose in front is no motion.
  const int first = std::min(input.rig.first_frame(), clip.frames - 1);
  for (int f = 0; f < first; ++f) {
    append(result.clip, clip.pose(f));
    result.source_frames.push_back(f);
  }
  std::vector<Quat> rotations(clip.joints());
  std::vector<Vec3> translations(clip.joints());
  const Pose pose{rotations, translations};
  ChangeStepper stepper(input.rig, source, amount);
  Lookout lookout(input);
  double frame = first, advance = 0;
  while (frame <= clip.frames - 1 + 1e-6) {
    sample(clip, frame, pose);
    stepper.step(pose, static_cast<float>(input.take_frame(frame)), lookout.flight(frame),
                 advance * clip.frame_time, clip.frame_time, pose);
    append(result.clip, pose);
    result.source_frames.push_back(frame);
    advance = timing ? stepper.rate() : 1.0;
    frame += advance;
  }
  return result;
}

}  // namespace panache
