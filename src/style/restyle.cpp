#include "style/restyle.h"

#include <algorithm>
#include <cmath>

#include "pose/loop.h"
#include "style/clip_stepper.h"
#include "style/restyle_loop.h"

namespace panache {
namespace {

Result<Restyled> restyle_open(const Clip& clip, const Rig& rig,
                              const std::shared_ptr<const Model>& model,
                              const std::vector<StrengthTrack>& tracks,
                              const RestyleOptions& options,
                              const std::function<void(double)>& progress) {
  Result<ClipStepper> stepper = ClipStepper::create(clip, rig, model, tracks, options.stylizer);
  if (!stepper) return stepper.error();
  Restyled result;
  result.clip.skeleton = clip.skeleton;
  result.clip.frame_time = clip.frame_time;
  const int first = std::min(rig.first_frame(), clip.frames - 1);
  append_calibration(clip, first, result);
  double frame = first, advance = 0;
  // The head may stop between the last two frames; the end of the input is never overrun.
  while (frame <= clip.frames - 1 + 1e-6) {
    stepper->step(frame, advance, frame * clip.frame_time);
    stepper->append_to(result, frame);
    const double rate = stepper->stylizer().rate();
    advance = options.timing ? clip_advance(frame, rate, stepper->flight()) : 1.0;
    frame += advance;
    if (progress && result.clip.frames % 64 == 0) progress(frame / clip.frames);
  }
  return result;
}

// Fails where a style is not as strong at the end of the loop as at its beginning.
Result<void> check_strengths(const LoopSeam& seam, double frame_time, const Model& model,
                             const std::vector<StrengthTrack>& tracks) {
  constexpr float kSame = 1e-4f;
  std::vector<float> begin(model.styles().size()), end = begin;
  for (const StrengthTrack& track : tracks) {
    begin[track.style] += track.at(seam.first * frame_time);
    end[track.style] += track.at(seam.last * frame_time);
  }
  for (size_t s = 0; s < begin.size(); ++s) {
    if (std::abs(begin[s] - end[s]) <= kSame) continue;
    return Error{"the motion cannot be a loop: style '" + model.styles()[s].name +
                     "' has another strength at its last frame than at its first",
                 ErrorKind::loop_strengths};
  }
  return {};
}

}  // namespace

float StrengthTrack::at(double seconds) const {
  const auto later = std::upper_bound(points.begin(), points.end(), seconds,
                                      [](double s, const Point& p) { return s < p.seconds; });
  if (later == points.begin()) return points.front().strength;
  if (later == points.end()) return points.back().strength;
  const Point& a = *(later - 1);
  const double t = (seconds - a.seconds) / (later->seconds - a.seconds);
  return a.strength + static_cast<float>(t) * (later->strength - a.strength);
}

bool is_unchanged(const Clip& clip, const Restyled& result) {
  return result.clip.frames == clip.frames && result.clip.rotations == clip.rotations &&
         result.clip.translations == clip.translations;
}

Result<Restyled> restyle(const Clip& clip, const Rig& rig,
                         const std::shared_ptr<const Model>& model,
                         const std::vector<StrengthTrack>& tracks, const RestyleOptions& options,
                         const std::function<void(double)>& progress) {
  LoopSeam seam;
  const bool gestures = options.stylizer.gesture_rate > 0;
  if (gestures && options.loop == LoopMode::force) {
    return Error{
        "the motion cannot be a loop with gestures at random, which no round repeats; "
        "leave out one of the two"};
  }
  bool loop = options.loop != LoopMode::off && !gestures;
  if (loop) {
    seam = measure_seam(clip, rig);
    const Result<void> even = check_strengths(seam, clip.frame_time, *model, tracks);
    if (options.loop == LoopMode::force) {
      if (auto closable = check_closable(seam, clip.frame_time); !closable) return closable.error();
      if (!even) return even.error();
    } else {
      loop = even.ok() && is_loop(seam, clip.frame_time);
    }
  }
  if (!loop) return restyle_open(clip, rig, model, tracks, options, progress);
  const auto half = [&](double begin) {
    return [&progress, begin](double done) {
      if (progress) progress(begin + done / 2);
    };
  };
  Result<Restyled> open = restyle_open(clip, rig, model, tracks, options, half(0));
  // A motion that is left as it is keeps its bits.
  if (!open || is_unchanged(clip, *open)) return open;
  return restyle_loop(clip, rig, model, tracks, options, half(0.5));
}

}  // namespace panache
