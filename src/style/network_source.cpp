#include "style/network_source.h"

#include <algorithm>

namespace panache {
namespace {

constexpr float kGateSeconds = 0.15f;  // Time constant of the gate.

}  // namespace

NetworkSource::NetworkSource(std::shared_ptr<const Model> model, const StylizerOptions& options)
    : options_{options.gesture_rate, options.gesture_seed},
      shape_(options.shape),
      strengths_(model->styles().size(), options.ease_seconds),
      networks_(std::move(model)),
      gestures_(options.gesture_seed) {}

bool NetworkSource::trigger(int style, int gesture) noexcept {
  if (style < 0 || static_cast<size_t>(style) >= model().styles().size()) return false;
  if (gesture < 0 || static_cast<size_t>(gesture) >= model().gestures(style).size()) return false;
  gestures_.trigger(style, gesture);
  return true;
}

StyleNetworks::Pass NetworkSource::begin(const Seen& seen) noexcept {
  if (seen.time.first) gestures_.stop();
  strengths_.step(wanted_, shape_, seen.time);
  networks_.set_strengths(strengths_.now());
  tell(seen.clock, Stage::strengths);
  return {&networks_, seen.window, seen.time.gain(kGateSeconds)};
}

AskedChange NetworkSource::finish(const Seen& seen) noexcept {
  AskedChange asked;
  asked.delta = model().recipe().to_change(networks_.pose(), *seen.body, seen.root());
  asked.log_rate = networks_.log_rate();
  std::ranges::copy(networks_.contact(), asked.contacts.begin());
  asked.gate = networks_.gate();
  asked.stance = networks_.stance();
  if (options_.gesture_rate > 0 || !gestures_.rests()) {
    gestures_.step(model(), strengths_.now(), options_.gesture_rate, seen.ground, seen.time);
  }
  asked.gesture = gestures_.now();
  asked.shape = &strengths_.shape();
  asked.amount = strengths_.amount();
  return asked;
}

AskedChange NetworkSource::ask(const Seen& seen) noexcept {
  const StyleNetworks::Pass pass = begin(seen);
  networks_.forward(pass.window, pass.gate_share);
  tell(seen.clock, Stage::networks);
  return finish(seen);
}

}  // namespace panache
