#include "style/foresight.h"

#include <algorithm>
#include <cmath>

#include "base/quat.h"

namespace panache {
namespace {

// Until guesses were checked the network is trusted most. Metres.
constexpr std::array<float, 4> kFirstErrors = {0.02f, 0.04f, 0.06f, 0.06f};
// The share of a new error in the mean: four checks a second, so half is forgotten in a second.
constexpr float kNews = 0.16f;
// Time constant at which a new share of the say is taken up, so that nothing jumps.
constexpr float kShareSeconds = 0.2f;
// A check that comes later than this is none: frames were dropped.
constexpr double kLatest = 0.05;  // Seconds.

}  // namespace

Foresight::Foresight(std::shared_ptr<const Model> model)
    : model_(std::move(model)), history_(PoseLayout::positions) {
  reset();
}

void Foresight::reset() noexcept {
  time_ = 0;
  history_.clear();
  errors_.fill(kFirstErrors);
  shares_.fill(shares_of(kFirstErrors));
  checked_ = kChecks.size();
}

void Foresight::push(double time, const HumanPositions& body, const Ground& ground) noexcept {
  history_.push(time, body, ground);
  const float gain = 1 - exponential(static_cast<float>(time_ - time) / kShareSeconds);
  for (size_t c = 0; c < kChecks.size(); ++c) {
    const PerGuesser wanted = shares_of(errors_[c]);
    for (size_t g = 0; g < kGuessers; ++g) shares_[c][g] += gain * (wanted[g] - shares_[c][g]);
  }
  time_ = time;
  newest_ = {body, ground};
  while (checked_ < kChecks.size() && time >= guessed_at_ + kChecks[checked_]) {
    if (time < guessed_at_ + kChecks[checked_] + kLatest) check(checked_, body, ground);
    ++checked_;
  }
  if (checked_ < kChecks.size()) return;
  for (size_t c = 0; c < kChecks.size(); ++c) guesses_[c] = guess(kChecks[c]);
  guessed_at_ = time;
  checked_ = 0;
}

void Foresight::check(size_t at, const HumanPositions& body, const Ground& ground) noexcept {
  const HumanPositions truth = to_world(body, ground);
  for (size_t g = 0; g < kGuessers; ++g) {
    const HumanPositions guessed = to_world(guesses_[at][g].body, guesses_[at][g].ground);
    float sum = 0;
    for (size_t j = 0; j < truth.size(); ++j) sum += length(guessed[j] - truth[j]);
    const float error = sum / static_cast<float>(truth.size());
    if (std::isfinite(error)) errors_[at][g] += kNews * (error - errors_[at][g]);
  }
}

Foresight::Guesses Foresight::guess(double seconds) const noexcept {
  constexpr size_t kNumbers = Predictor::kNumbers;
  std::array<float, kWindowPoses * kNumbers> window;
  history_.window(window);
  const auto pose = [&](size_t k) {
    return std::span<const float, kNumbers>(&window[k * kNumbers], kNumbers);
  };
  const HumanPositions before = read_positions(pose(1)), earlier = read_positions(pose(2));
  const Ground ground = move_ground(newest_.ground, pose(0).last<kRootNumbers>(), seconds);
  ForeseenBody velocity{newest_.body, ground}, acceleration = velocity;
  const auto steps = static_cast<float>(seconds / kWindowSpacing);
  for (size_t j = 0; j < velocity.body.size(); ++j) {
    const Vec3 change = newest_.body[j] - before[j], last = before[j] - earlier[j];
    velocity.body[j] += change * steps;
    acceleration.body[j] = velocity.body[j] + (change - last) * (steps * (steps + 1) / 2);
  }
  return {model_->predictor()->foresee(window, newest_.ground, seconds), velocity, acceleration,
          newest_};
}

// By the fourth power: who is twice as far off has a sixteenth of the say.
Foresight::PerGuesser Foresight::shares_of(const PerGuesser& errors) noexcept {
  constexpr float kNothing = 1e-5f;  // Metres.
  const float least = *std::min_element(errors.begin(), errors.end()) + kNothing;
  PerGuesser shares;
  float total = 0;
  for (size_t g = 0; g < kGuessers; ++g) {
    const float ratio = least / (errors[g] + kNothing);
    total += shares[g] = ratio * ratio * ratio * ratio;
  }
  for (float& share : shares) share /= total;
  return shares;
}

ForeseenBody Foresight::foresee(double seconds) const noexcept {
  if (seconds <= 0) return newest_;
  const Guesses guesses = guess(seconds);
  // The share of the later check.
  const auto later =
      static_cast<float>(std::clamp((seconds - kChecks[0]) / (kChecks[1] - kChecks[0]), 0.0, 1.0));
  // Each is laid on what is known, by its part.
  ForeseenBody out = newest_;
  for (size_t g = 0; g < kGuessers; ++g) {
    const float share = (1 - later) * shares_[0][g] + later * shares_[1][g];
    for (size_t j = 0; j < out.body.size(); ++j) {
      out.body[j] += (guesses[g].body[j] - newest_.body[j]) * share;
    }
    out.ground.position += (guesses[g].ground.position - newest_.ground.position) * share;
    out.ground.facing += (guesses[g].ground.facing - newest_.ground.facing) * share;
  }
  return out;
}

}  // namespace panache
