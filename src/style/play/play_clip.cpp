#include "style/play/play_clip.h"

#include <algorithm>

#include "style/play/clip_stepper.h"
#include "style/play/play_loop.h"

namespace panache {
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
