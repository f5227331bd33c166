#include "style/play/play_clip.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "clip/clip.h"
#include "pose/loop.h"
#include "pose/changed_joints.h"
#include "rig/humanoid.h"
#include "style/stepper.h"

namespace panache {
namespace {

// Steps a character through a clip, frame by frame.
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
  ClipHead head_;
  std::optional<NextPose> next_;  // The second pose.
  float flight_ = 0, gate_ = 1;
  std::vector<Quat> rotations_;
  std::vector<Vec3> translations_;
};

ClipStepper::ClipStepper(const Clip& clip, const Rig& rig, ChangeSource& source,
                         const StylizerOptions& options)
    : clip_(clip),
      source_(source),
      stepper_(rig, source.layout(), options),
      head_(clip, rig),
      rotations_(clip.joints()),
      translations_(clip.joints()) {
  const int second = std::min(rig.first_frame(), clip.frames - 1) + 1;
  if (second >= clip.frames || !(clip.frame_time > 0)) return;
  sample(clip, second, {rotations_, translations_});
  next_ = stepper_.see_next(pose(), clip.frame_time);
}

void ClipStepper::step(double frame, double advance, double seconds) {
  const Pose pose = {rotations_, translations_};
  flight_ = head_.show(frame, pose);
  const StepMoment moment = {advance * clip_.frame_time, clip_.frame_time, flight_, seconds,
                             next_ ? &*next_ : nullptr};
  gate_ = stepper_.step(pose, moment, source_, pose).gate;
}

FootContacts ClipStepper::contacts() const {
  const std::span<const float> planted = stepper_.contacts();
  return {planted[0] > 0.5f, planted[1] > 0.5f};
}

// A result repeats if no pose of a round differs by more than this from the previous round, mean
// over the joints. Metres.
constexpr float kRepeats = 0.0003f;
// The maximum time for a style to settle: the slowest filters have decayed by 98 % then.
constexpr double kSettleSeconds = 12;
constexpr int kFewestRounds = 3;

// The result of a step.
struct LoopStep {
  PaceSample pace;
  BodyChange change;
  FootContacts contacts{};
  float gate = 1;
  StageFacts stages;
  HumanPositions joints;  // With the change, seen from the root of the result, metres.
};
using Round = std::vector<LoopStep>;

bool repeats(const Round& round, const Round& before) {
  if (round.size() != before.size()) return false;
  for (size_t i = 0; i < round.size(); ++i) {
    if (!(pose_distance(round[i].joints, before[i].joints).mean <= kRepeats)) return false;
  }
  return true;
}

// The contacts of the input from frame `first` on.
std::vector<FootContacts> input_contacts(const Clip& clip, const Rig& rig, int first) {
  PosedRig reader(rig);
  std::vector<HumanPositions> world;
  for (int f = first; f < clip.frames; ++f) {
    BodyPose body;
    reader.read(clip.pose(f), body);
    world.push_back(body.positions);
  }
  return detect_contacts(world, 1 / clip.frame_time);
}

// Plays the rounds of a repeated loop.
class LoopPlayer {
 public:
  LoopPlayer(const Clip& looped, const Rig& rig, int first, int length, ChangeSource& source,
             const RestyleOptions& options)
      : looped_(looped),
        reader_(rig),
        first_(first),
        length_(length),
        timing_(options.timing),
        stepper_(looped, rig, source, options.stylizer) {}

  // Plays the first round, at the tempo of the styles.
  void play_free() {
    Round round;
    double phase = 0;
    while (phase < length_ - 0.01) {
      round.push_back(step(0, phase));
      const PaceSample& pace = round.back().pace;
      phase += clip_advance(phase, pace.rate, pace.flight);
    }
    finish(std::move(round));
  }

  // Plays the next one, in whole frames.
  void play_round(int number) {
    std::vector<PaceSample> pace;
    for (const LoopStep& step : round_) pace.push_back(step.pace);
    phases_ = loop_schedule(pace, length_, static_cast<int>(round_.size()));
    Round round;
    for (size_t i = 0; i + 1 < phases_.size(); ++i) round.push_back(step(number, phases_[i]));
    finish(std::move(round));
  }

  // The last round and the first step after it, which closes it.
  Round closed_round(int number) {
    Round round = round_;
    round.push_back(step(number + 1, 0));
    return round;
  }
  bool has_settled() const { return settled_; }
  // The phases of the last round's frames, and of its end.
  const std::vector<double>& phases() const { return phases_; }

 private:
  LoopStep step(int round, double phase) {
    const double frame = first_ + static_cast<double>(round) * length_ + phase;
    stepper_.step(frame, started_ ? frame - frame_ : 0, (first_ + phase) * looped_.frame_time);
    started_ = true;
    frame_ = frame;
    LoopStep out{{phase, timing_ ? stepper_.rate() : 1.0, stepper_.flight()},
                 stepper_.change(),
                 stepper_.contacts(),
                 stepper_.gate(),
                 stepper_.stage_facts(),
                 {}};
    // The resulting body, relative to its root.
    BodyPose body;
    reader_.read(stepper_.pose(), body);
    const Quat to_heading = rotation_y(-body.facing);
    const Vec3 middle = mid_hip(body);
    for (int j = 0; j < kHumanJoints; ++j) {
      out.joints[j] = rotate(to_heading, body.joints[j] - Vec3{middle.x, 0, middle.z});
    }
    return out;
  }

  void finish(Round round) {
    settled_ = repeats(round, round_);
    round_ = std::move(round);
  }

  const Clip& looped_;
  PosedRig reader_;
  int first_, length_;
  bool timing_;
  ClipStepper stepper_;
  bool started_ = false, settled_ = false;
  double frame_ = 0;
  Round round_;
  std::vector<double> phases_;
};

// Adds the frames of `round` to the result, as if it were the first: `back` undoes the turns of the
// rounds before it. `closed`: the input, whose last pose is its first.
void append_round(const Clip& closed, const Rig& rig, int first, const LoopPlayer& player,
                  const Round& round, Quat back, Restyled& result) {
  const Vec3 start = rotate(back, round.front().change.translation);
  std::vector<Quat> rotations(closed.joints());
  std::vector<Vec3> translations(closed.joints());
  const Pose pose = {rotations, translations};
  PosedRig writer(rig);
  for (size_t i = 0; i < round.size(); ++i) {
    const double frame = first + player.phases()[i];
    sample(closed, frame, pose);
    BodyPose body;
    writer.read(pose, body);
    BodyChange change = round[i].change;
    change.translation = rotate(back, change.translation) - Vec3{start.x, 0, start.z};
    writer.write(pose, body, change, pose);
    result.append(pose, frame, round[i].contacts, round[i].gate, round[i].stages);
  }
}

}  // namespace

Restyled play_loop(const Clip& clip, const Rig& rig, ChangeSource& source,
                   const RestyleOptions& options, const std::function<void(double)>& progress) {
  const int first = std::min(rig.first_frame(), clip.frames - 1);
  Clip closed = clip;
  close_loop(rig, first, input_contacts(clip, rig, first), closed);
  const LoopSeam seam = measure_seam(closed, rig);
  const Travel travel(seam.begin, seam.end);
  const double seconds = seam.frames() * clip.frame_time;
  const int rounds = kFewestRounds + static_cast<int>(std::ceil(kSettleSeconds / seconds));
  const Clip looped = repeat_loop(closed, rig, first, travel, rounds + 1);
  LoopPlayer player(looped, rig, first, seam.frames(), source, options);
  player.play_free();
  int number = 0;
  do {
    player.play_round(++number);
    if (progress) progress(static_cast<double>(number) / rounds);
  } while (number + 1 < rounds && !player.has_settled());

  Restyled result = Restyled::begin(clip, first);
  append_round(closed, rig, first, player, player.closed_round(number),
               rotation_y(-travel.turned(number)), result);
  result.loop = {true, number + 1, player.has_settled(), measure_seam(clip, rig).gap,
                 measure_seam(result.clip, rig).gap};
  close_loop(rig, first, std::span(result.contacts).subspan(first), result.clip);
  return result;
}

namespace {

// From the first frame of the motion to the last.
Restyled play_once(const Clip& clip, const Rig& rig, ChangeSource& source,
                   const RestyleOptions& options, const std::function<void(double)>& progress) {
  ClipStepper stepper(clip, rig, source, options.stylizer);
  const int first = std::min(rig.first_frame(), clip.frames - 1);
  Restyled result = Restyled::begin(clip, first);
  double frame = first, advance = 0;
  // The head may stop between the last two frames; the end of the input is never overrun.
  while (frame <= clip.frames - 1 + 1e-6) {
    stepper.step(frame, advance, frame * clip.frame_time);
    result.append(stepper.pose(), frame, stepper.contacts(), stepper.gate(), stepper.stage_facts());
    advance = options.timing ? clip_advance(frame, stepper.rate(), stepper.flight()) : 1.0;
    frame += advance;
    if (progress && result.clip.frames % 64 == 0) progress(frame / clip.frames);
  }
  return result;
}

}  // namespace

Restyled play_clip(const Clip& clip, const Rig& rig, const MakeSource& make_source, bool loop,
                   const RestyleOptions& options, const std::function<void(double)>& progress) {
  const auto half = [&](double begin) {
    return [&progress, begin](double done) {
      if (progress) progress(begin + done / 2);
    };
  };
  Restyled once = play_once(clip, rig, *make_source(), options,
                            loop ? std::function<void(double)>(half(0)) : progress);
  if (!loop || is_unchanged(clip, once)) return once;
  return play_loop(clip, rig, *make_source(), options, half(0.5));
}

}  // namespace panache
