#include "style/networks/network_source.h"

#include <algorithm>
#include <cmath>

namespace panache {
namespace {

constexpr float kGateSeconds = 0.15f;  // Time constant of the gate.

}  // namespace

NetworkSource::NetworkSource(std::shared_ptr<const Model> model, const StylizerOptions& options)
    : options_{options.gesture_rate, options.gesture_seed, options.ease_seconds},
      sides_(options.sides),
      shape_(options.shape),
      person_(options.person),
      strengths_(model->styles().size(), options.ease_seconds),
      networks_(std::move(model)),
      gestures_(options.gesture_seed) {
  sides_.resize(this->model().styles().size(), 1.0f);
}

void NetworkSource::set_person(std::span<const float> numbers) noexcept {
  if (!model().persons()) return;
  for (size_t a = 0; a < std::min(numbers.size(), model().persons()->axes()); ++a) {
    if (std::isfinite(numbers[a])) person_[a] = std::clamp(numbers[a], -kMaxPerson, kMaxPerson);
  }
}

// As for styles: from a quarter of a usual number on, a person is fully active.
float NetworkSource::amount() const noexcept {
  float largest = 0;
  for (const float number : networks_.person()) largest = std::max(largest, std::abs(number));
  return std::max(strengths_.amount(), std::min(1.0f, 4 * largest));
}

void NetworkSource::set_side(int style, float side) noexcept {
  if (style < 0 || static_cast<size_t>(style) >= sides_.size() || !std::isfinite(side)) return;
  if (!model().recipe().style_heads) return;
  sides_[static_cast<size_t>(style)] = std::clamp(side, -1.0f, 1.0f);
}

bool NetworkSource::trigger(int style, int gesture) noexcept {
  if (style < 0 || static_cast<size_t>(style) >= model().styles().size()) return false;
  if (gesture < 0 || static_cast<size_t>(gesture) >= model().gestures(style).size()) return false;
  gestures_.trigger(style, gesture);
  return true;
}

void NetworkSource::ease_strengths(const SourceInput& input) noexcept {
  if (input.time.first) gestures_.stop();
  strengths_.step(wanted_, sides_, shape_, input.time);
  networks_.set_strengths(strengths_.now(), strengths_.sides());
  if (model().persons()) {
    networks_.ease_person(person_, input.time.gain(options_.ease_seconds));
  }
  tell(input.clock, Stage::strengths);
}

size_t NetworkSource::begin(
    const SourceInput& input,
    std::span<StyleNetworks::Pass, StyleNetworks::kMaxPasses> passes) noexcept {
  ease_strengths(input);
  return networks_.passes(input.window, input.time.gain(kGateSeconds), passes);
}

AskedChange NetworkSource::finish(const SourceInput& input) noexcept {
  AskedChange asked;
  asked.delta = model().recipe().to_change(networks_.pose(), *input.body, input.root());
  asked.log_rate = networks_.log_rate();
  asked.contacts = networks_.contact();
  asked.gate = networks_.gate();
  asked.stance = networks_.stance();
  if (options_.gesture_rate > 0 || !gestures_.rests()) {
    gestures_.step(model(), strengths_.now(), strengths_.sides(), options_.gesture_rate,
                   input.ground, input.time);
  }
  asked.gesture = gestures_.now();
  asked.shape = &strengths_.shape();
  asked.amount = amount();
  return asked;
}

AskedChange NetworkSource::ask(const SourceInput& input) noexcept {
  ease_strengths(input);
  networks_.forward(input.window, input.time.gain(kGateSeconds));
  tell(input.clock, Stage::networks);
  return finish(input);
}

}  // namespace panache
