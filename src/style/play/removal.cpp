#include "style/play/removal.h"

#include <algorithm>
#include <cmath>

#include "base/elementary.h"
#include "style/model/model.h"

namespace panache {
namespace {

// The position of `value` in an ascending list: an index with a fraction.
double place_in(const std::vector<double>& list, double value) {
  const auto later = std::lower_bound(list.begin(), list.end(), value);
  if (later == list.begin()) return 0;
  if (later == list.end()) return static_cast<double>(list.size() - 1);
  const double before = *(later - 1);
  return static_cast<double>(later - list.begin() - 1) + (value - before) / (*later - before);
}

bool asks_for_a_style(const std::vector<StrengthTrack>& tracks) {
  return std::any_of(tracks.begin(), tracks.end(), [](const StrengthTrack& track) {
    return std::any_of(track.points.begin(), track.points.end(),
                       [](const StrengthTrack::Point& point) { return point.strength != 0; });
  });
}

// Combines the results of both passes into one relative to the input.
Restyled joined(const Restyled& neutral, Restyled styled) {
  for (size_t f = 0; f < styled.source_frames.size(); ++f) {
    const double at = styled.source_frames[f];
    const auto nearest = static_cast<size_t>(std::lround(at));
    styled.gates[f] =
        std::min(styled.gates[f], neutral.gates[std::min(nearest, neutral.gates.size() - 1)]);
    styled.source_frames[f] = between(neutral.source_frames, at);
  }
  return styled;
}

}  // namespace

bool is_remover(const Model& model) {
  const auto direction = model.metadata().find(kDirection);
  return direction != model.metadata().end() && direction->second == kRemove;
}

Result<int> find_removal(const Model& remover, std::string_view style) {
  if (!is_remover(remover)) {
    return Error{"the model puts styles on; expected one that takes them off"};
  }
  return remover.find_style_by_any_name(style.empty() ? kAnyStyle : style);
}

Result<Restyled> restyle_without(const Clip& clip, const Rig& rig, const Removal& removal,
                                 const std::shared_ptr<const Model>& model,
                                 const std::vector<StrengthTrack>& tracks,
                                 const RestyleOptions& options,
                                 const std::function<void(double)>& progress) {
  const StylizerOptions& styling = options.stylizer;
  const bool again =
      asks_for_a_style(tracks) || styling.person != PersonNumbers{} || styling.shape.energy != 1;
  const auto part = [&](double begin) {
    return [&progress, begin, again](double done) {
      if (progress) progress(again ? begin + done / 2 : done);
    };
  };
  RestyleOptions plain = options;
  // The style that is taken off may cause what the hands touch.
  plain.stylizer.shape = {.hand_contacts = 0};
  plain.stylizer.sides = {};
  plain.stylizer.person = {};
  Result<Restyled> neutral =
      restyle(clip, rig, removal.remover, {{removal.style, {{0, 1}}}}, plain, part(0));
  if (!neutral || !again) return neutral;
  std::vector<StrengthTrack> moved = tracks;
  for (StrengthTrack& track : moved) {
    for (StrengthTrack::Point& point : track.points) {
      point.seconds =
          place_in(neutral->source_frames, point.seconds / clip.frame_time) * clip.frame_time;
    }
  }
  Result<Restyled> styled = restyle(neutral->clip, rig, model, moved, options, part(0.5));
  if (!styled) return styled;
  return joined(*neutral, *std::move(styled));
}

Result<RemovalPass> RemovalPass::create(std::shared_ptr<const Model> remover, Rig rig,
                                        StylizerOptions options) {
  if (Result<int> any = find_removal(*remover, ""); !any) return any.error();
  options.shape = {.hand_contacts = 0};
  options.sides = {};
  options.person = {};
  Result<Stylizer> stylizer = Stylizer::create(std::move(remover), std::move(rig), options);
  if (!stylizer) return stylizer.error();
  return RemovalPass(*std::move(stylizer));
}

RemovalPass::RemovalPass(Stylizer stylizer)
    : stylizer_(std::move(stylizer)),
      strengths_(stylizer_.model().styles().size()),
      rotations_(stylizer_.rig().joint_count()),
      translations_(stylizer_.rig().joint_count()) {}

void RemovalPass::set_removed(int style) noexcept {
  if (style < -1 || style >= static_cast<int>(strengths_.size())) return;
  std::fill(strengths_.begin(), strengths_.end(), 0.0f);
  if (style >= 0) strengths_[static_cast<size_t>(style)] = 1;
}

ConstPose RemovalPass::step(ConstPose in, double input_seconds, double output_seconds) noexcept {
  stylizer_.step(in, strengths_, {input_seconds, output_seconds}, {rotations_, translations_});
  return {rotations_, translations_};
}

}  // namespace panache
