#include "style/restyle.h"

#include <algorithm>
#include <cmath>

#include "style/flight_lookout.h"

namespace panache {

float StrengthTrack::at(double seconds) const {
  const auto later = std::upper_bound(points.begin(), points.end(), seconds,
                                      [](double s, const Point& p) { return s < p.seconds; });
  if (later == points.begin()) return points.front().strength;
  if (later == points.end()) return points.back().strength;
  const Point& a = *(later - 1);
  const double t = (seconds - a.seconds) / (later->seconds - a.seconds);
  return a.strength + static_cast<float>(t) * (later->strength - a.strength);
}

Result<Restyled> restyle(const Clip& clip, const Rig& rig,
                         const std::shared_ptr<const Model>& model,
                         const std::vector<StrengthTrack>& tracks, const RestyleOptions& options,
                         const std::function<void(double)>& progress) {
  Result<Stylizer> stylizer = Stylizer::create(model, rig, options.stylizer);
  if (!stylizer) return stylizer.error();
  Restyled result;
  result.clip.skeleton = clip.skeleton;
  result.clip.frame_time = clip.frame_time;

  // A calibration pose in front is no motion: it stays what it is.
  const int first = std::min(rig.first_frame(), clip.frames - 1);
  for (int f = 0; f < first; ++f) {
    result.clip.append(clip.pose(f));
    result.source_frames.push_back(f);
    result.contacts.push_back({});
    result.gates.push_back(1);
  }

  std::vector<Quat> rotations(clip.joints());
  std::vector<Vec3> translations(clip.joints());
  const Pose pose{rotations, translations};
  std::vector<float> strengths(model->styles().size());
  FlightLookout lookout(clip, rig);
  if (first + 1 < clip.frames && clip.frame_time > 0) {
    sample(clip, first + 1, pose);
    stylizer->set_next(pose, clip.frame_time);
  }
  double frame = first, advance = 0;
  // The head may stop between the last two frames; the end of the input is never overrun.
  while (frame <= clip.frames - 1 + 1e-6) {
    std::fill(strengths.begin(), strengths.end(), 0.0f);
    for (const StrengthTrack& track : tracks) {
      strengths[track.style] += track.at(frame * clip.frame_time);
    }
    sample(clip, frame, pose);
    const float flight = lookout.flight(frame);
    stylizer->set_flight(flight);
    stylizer->step(pose, strengths, advance * clip.frame_time, clip.frame_time, pose);
    result.clip.append(pose);
    result.source_frames.push_back(frame);
    const std::span<const float> planted = stylizer->contacts();
    result.contacts.push_back({planted[0] > 0.5f, planted[1] > 0.5f});
    result.gates.push_back(stylizer->gate());
    advance = options.timing ? clip_advance(frame, stylizer->rate(), flight) : 1.0;
    frame += advance;
    if (progress && result.clip.frames % 64 == 0) progress(frame / clip.frames);
  }
  return result;
}

}  // namespace panache
