#include "style/live_stylizer.h"

#include <cassert>

#include "base/bytes.h"

namespace panache {

Result<void> LiveStylizer::check(const Model& model, const LiveOptions& options) {
  const struct {
    const char* name;
    double value, max;
    const char* expected;
  } ranges[] = {
      {"max_lag", options.max_lag, LiveOptions::kMaxLag, "0 to 4"},
      {"max_lead", options.max_lead, PredictorNetwork::kMaxSeconds, "0 to 0.25"},
  };
  for (const auto& [name, value, max, expected] : ranges) {
    if (!(value >= 0 && value <= max)) {
      return Error{std::string(name) + " of " + std::to_string(value) + " seconds; expected " +
                   expected + " seconds"};
    }
  }
  if (options.max_lead > 0 && !model.predictor()) {
    return Error{
        "max_lead needs a model that predicts input, which this one does not; train it again or "
        "set max_lead to 0"};
  }
  return {};
}

Result<LiveStylizer> LiveStylizer::create(std::shared_ptr<const Model> model, Rig rig,
                                          const LiveOptions& options) {
  if (Result<void> good = check(*model, options); !good) return good.error();
  Result<Stylizer> stylizer = Stylizer::create(model, std::move(rig), options.stylizer);
  if (!stylizer) return stylizer.error();
  LiveStylizer live(*std::move(stylizer), std::move(model), options);
  if (options.remover) {
    Result<RemovalPass> removal =
        RemovalPass::create(options.remover, live.stylizer_.rig(), options.stylizer);
    if (!removal) return removal.error();
    live.removal_.emplace(*std::move(removal));
  }
  return live;
}

LiveStylizer::LiveStylizer(Stylizer stylizer, std::shared_ptr<const Model> model,
                           const LiveOptions& options)
    : stylizer_(std::move(stylizer)) {
  if (options.max_lag > 0 || options.max_lead > 0) {
    playback_ = std::make_unique<Playback>(stylizer_.rig(), options.stylizer.max_speed,
                                           std::move(model), options);
  }
}

void LiveStylizer::reset() noexcept {
  stylizer_.reset();
  if (playback_) playback_->reset();
  if (removal_) removal_->reset();
}

void LiveStylizer::step(ConstPose in, std::span<const float> strengths, double seconds,
                        Pose out) noexcept {
  if (removal_) in = removal_->step(in, seconds, seconds);
  if (!playback_) return stylizer_.step(in, strengths, seconds, out);
  seconds = bounded_seconds(seconds);
  if (!playback_->take_in(in, seconds)) stylizer_.forget_motion();
  const auto [pose, moment] = playback_->show(seconds, stylizer_.rate(), stylizer_.amount() > 0);
  stylizer_.step(pose, strengths, moment, out);
}

size_t LiveStylizer::state_size() const noexcept {
  const size_t own =
      playback_ ? state_bytes([this](auto&& visit) { Playback::visit_state(*playback_, visit); })
                : size_t{0};
  return stylizer_.state_size() + removal_state_size() + own;
}

void LiveStylizer::save(std::span<std::byte> out) const noexcept {
  assert(out.size() == state_size());
  const size_t size = stylizer_.state_size(), first = removal_state_size();
  stylizer_.save(out.first(size));
  if (removal_) removal_->save(out.subspan(size, first));
  if (!playback_) return;
  write_state(out.subspan(size + first),
              [this](auto&& visit) { Playback::visit_state(*playback_, visit); });
}

bool LiveStylizer::restore(std::span<const std::byte> in) noexcept {
  if (in.size() != state_size()) return false;
  const size_t size = stylizer_.state_size(), first = removal_state_size();
  const auto removal = in.subspan(size, first), own = in.subspan(size + first);
  if (playback_ && !is_whole_state(own)) return false;
  if (removal_ && !is_whole_state(removal)) return false;
  if (!stylizer_.restore(in.first(size))) return false;
  if (removal_) removal_->restore(removal);
  if (playback_) {
    read_state(own, [this](auto&& visit) { Playback::visit_state(*playback_, visit); });
  }
  return true;
}

}  // namespace panache
