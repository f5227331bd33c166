#include "style/restyle.h"

#include <algorithm>
#include <cmath>

#include "pose/loop.h"
#include "style/networks/network_source.h"
#include "style/play/play_clip.h"

namespace panache {
namespace {

// A model's styles with strengths that change over a clip.
class TrackedStyles final : public ChangeSource {
 public:
  TrackedStyles(const std::shared_ptr<const Model>& model, const std::vector<StrengthTrack>& tracks,
                const StylizerOptions& options)
      : tracks_(tracks), strengths_(model->styles().size()), networks_(model, options) {}

  PoseLayout layout() const override { return networks_.layout(); }
  AskedChange ask(const Seen& seen) noexcept override {
    std::ranges::fill(strengths_, 0.0f);
    for (const StrengthTrack& track : tracks_) strengths_[track.style] += track.at(seen.time.clip);
    networks_.set_strengths(strengths_);
    return networks_.ask(seen);
  }

 private:
  const std::vector<StrengthTrack>& tracks_;
  std::vector<float> strengths_;  // [styles]
  NetworkSource networks_;
};

// Fails if a style's strength differs between both ends of the loop.
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

Restyled Restyled::begin(const Clip& clip, int first) {
  Restyled result;
  result.clip.skeleton = clip.skeleton;
  result.clip.frame_time = clip.frame_time;
  for (int f = 0; f < first; ++f) result.append(clip.pose(f), f, {}, 1, {});
  return result;
}

void Restyled::append(ConstPose pose, double source_frame, FootContacts planted, float gate,
                      StageFacts facts) {
  clip.append(pose);
  source_frames.push_back(source_frame);
  contacts.push_back(planted);
  gates.push_back(gate);
  stages.push_back(facts);
}

bool is_unchanged(const Clip& clip, const Restyled& result) {
  return result.clip.frames == clip.frames && result.clip.rotations == clip.rotations &&
         result.clip.translations == clip.translations;
}

Result<Restyled> restyle(const Clip& clip, const Rig& rig,
                         const std::shared_ptr<const Model>& model,
                         const std::vector<StrengthTrack>& tracks, const RestyleOptions& options,
                         const std::function<void(double)>& progress) {
  if (Result<void> good = check(options.stylizer, *model); !good) return good.error();
  bool loop = options.loop != LoopMode::off;
  if (loop) {
    const LoopSeam seam = measure_seam(clip, rig);
    const Result<void> even = check_strengths(seam, clip.frame_time, *model, tracks);
    if (options.loop == LoopMode::force) {
      if (auto closable = check_closable(seam, clip.frame_time); !closable) return closable.error();
      if (!even) return even.error();
    } else {
      loop = even.ok() && is_loop(seam, clip.frame_time);
    }
  }
  // No round of a loop would repeat gestures at random.
  StylizerOptions how = options.stylizer;
  if (loop) how.gesture_rate = 0;
  const auto make_source = [&] { return std::make_unique<TrackedStyles>(model, tracks, how); };
  return play_clip(clip, rig, make_source, loop, options, progress);
}

}  // namespace panache
