#include "style/restyle.h"

#include <algorithm>
#include <cmath>

#include "pose/loop.h"
#include "rig/posed_rig.h"
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
  AskedChange ask(const SourceInput& seen) noexcept override {
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
  StylizerOptions styling = options.stylizer;
  if (loop) styling.gesture_rate = 0;
  const auto make_source = [&] { return std::make_unique<TrackedStyles>(model, tracks, styling); };
  return play_clip(clip, rig, make_source, loop, options, progress);
}

namespace {

constexpr float kSeated = 0.5f, kTouching = 0.5f;  // Of StageFacts.
constexpr float kStanding = 0.5f;  // m/s; the foot lock lets faster feet of the input go.

using Toes = std::array<Vec3, kFeet>;

Toes toes_of(PosedRig& reader, ConstPose pose) {
  BodyPose body;
  reader.read(pose, body);
  return {body.joints[index(kToes[0])], body.joints[index(kToes[1])]};
}

float over_ground(Vec3 a, Vec3 b) { return std::hypot(b.x - a.x, b.z - a.z); }

// Sets the facts about the feet from frame `first` on.
void measure_feet(const Clip& clip, const Rig& rig, const Restyled& result, int first,
                  RestyleFacts& facts) {
  PosedRig reader(rig);
  std::vector<Quat> rotations(clip.joints());
  std::vector<Vec3> translations(clip.joints());
  const Pose pose = {rotations, translations};
  Toes input{}, output{};
  int steps = 0, planted_frames = 0;
  for (int f = first; f < result.clip.frames; ++f) {
    const Toes input_before = input, output_before = output;
    sample(clip, result.source_frames[f], pose);
    input = toes_of(reader, pose);
    output = toes_of(reader, result.clip.pose(f));
    if (f == first) continue;
    const float seconds = static_cast<float>(result.clip.frame_time);
    bool planted = false;
    for (int foot = 0; foot < kFeet; ++foot) {
      if (!result.contacts[f - 1][foot] || !result.contacts[f][foot]) continue;
      const float moved = over_ground(input_before[foot], input[foot]) / seconds;
      if (moved > kStanding) continue;
      planted = true;
      ++steps;
      facts.input_slide += moved;
      facts.slide += over_ground(output_before[foot], output[foot]) / seconds;
    }
    planted_frames += planted;
  }
  if (steps == 0) return;
  facts.input_slide /= static_cast<float>(steps);
  facts.slide /= static_cast<float>(steps);
  facts.planted =
      static_cast<float>(planted_frames) / static_cast<float>(result.clip.frames - 1 - first);
}

}  // namespace

RestyleFacts restyle_facts(const Clip& clip, const Rig& rig, const Restyled& result) {
  RestyleFacts facts;
  facts.unchanged = is_unchanged(clip, result);
  facts.loop = result.loop;
  const int first = std::min(rig.first_frame(), clip.frames - 1);
  const float frames = static_cast<float>(result.clip.frames - first);
  facts.known = 0;
  for (int f = first; f < result.clip.frames; ++f) {
    facts.known += result.gates[f];
    facts.seated += result.stages[f].seated > kSeated;
    facts.touching += result.stages[f].touching > kTouching;
  }
  facts.known /= frames;
  facts.seated /= frames;
  facts.touching /= frames;
  measure_feet(clip, rig, result, first, facts);
  return facts;
}

}  // namespace panache
