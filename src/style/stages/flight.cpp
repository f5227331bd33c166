#include "style/stages/flight.h"

#include <algorithm>

#include "base/elementary.h"
#include "base/vec.h"
#include "pose/contacts.h"

namespace panache {
namespace {

// The second derivative of the height is that of a parabola through this much before and after.
constexpr double kHalfFit = 0.06;  // Seconds.
// In captured jumps the centre falls at 8 to 11 m/s^2, as real limbs differ from our masses;
// crouching or walking downstairs reaches 5 briefly, but with a foot on the floor.
constexpr double kFalls = -6, kFallsOn = -4;       // m/s^2; to begin and to last.
constexpr float kOffFloor = 0.05f, kNear = 0.03f;  // Metres; likewise.
// The fit blurs both ends of a flight: it is detected about 0.04 s too short. Runs show 0.05 to
// 0.12 s, hops 0.15 s and more.
constexpr double kTooShort = 0.12, kWhole = 0.18;  // Seconds.
// A flight begins this long before its detection, and includes the impact of the landing.
constexpr double kBefore = 0.06, kAfter = 0.14;
constexpr double kEaseIn = 0.25, kEaseOut = 0.2;

// Shares of the body's mass near each joint (Winter, Biomechanics and Motor Control of Human
// Movement: trunk .50, head .08, arm .05, leg .16).
constexpr std::array<float, kHumanJoints> kMass = {.15f, .15f,  .20f,  0,
                                                   .08f,  // hips, spine, chest, neck, head
                                                   0,    .02f,  .02f,  .01f,  // left arm
                                                   0,    .02f,  .02f,  .01f,  // right arm
                                                   .06f, .065f, .035f, 0,     // left leg
                                                   .06f, .065f, .035f, 0};    // right leg

}  // namespace

void FlightWatch::push(double time, const HumanPositions& world) noexcept {
  if (count_ > 0 && time - samples_[count_ - 1].time < kMinGap) return;
  if (count_ == kSamples) {
    std::copy(samples_.begin() + 1, samples_.end(), samples_.begin());
    --count_;
    judged_ = std::max(0, judged_ - 1);
  }
  Sample& now = samples_[count_++];
  now = {time, 0, lowest_foot(world)};
  for (size_t j = 0; j < kHumanJoints; ++j) now.height += kMass[j] * world[j].y;
  // Samples with enough later samples for the fit.
  while (judged_ + 1 < count_ && samples_[judged_].time + kHalfFit <= time) judge(judged_++);
}

// Least squares: height = a + b x + c x^2 with x from the mean of the times. Nothing if there are
// too few samples.
FlightWatch::Ballistics FlightWatch::ballistics(int sample) const noexcept {
  const double middle = samples_[sample].time;
  int first = std::max(sample - 1, 0), last = std::min(sample + 1, count_ - 1);
  while (first > 0 && samples_[first - 1].time >= middle - kHalfFit) --first;
  while (last + 1 < count_ && samples_[last + 1].time <= middle + kHalfFit) ++last;
  const int n = last - first + 1;
  if (n < 3) return {};
  double mean = 0;
  for (int i = first; i <= last; ++i) mean += (samples_[i].time - middle) / n;
  double s2 = 0, s3 = 0, s4 = 0, y0 = 0, y1 = 0, y2 = 0;
  for (int i = first; i <= last; ++i) {
    const double x = samples_[i].time - middle - mean, y = static_cast<double>(samples_[i].height);
    s2 += x * x, s3 += x * x * x, s4 += x * x * x * x;
    y0 += y, y1 += x * y, y2 += x * x * y;
  }
  const double below = s4 - s2 * s2 / n - s3 * s3 / s2;
  if (!(below > 0)) return {};
  const double c = (y2 - s2 * y0 / n - s3 * y1 / s2) / below, b = (y1 - c * s3) / s2;
  return {b - 2 * c * mean, 2 * c};
}

void FlightWatch::judge(int sample) noexcept {
  const Sample& now = samples_[sample];
  const Ballistics body = ballistics(sample);
  const bool flies =
      now.feet > (open_ ? kNear : kOffFloor) && body.acceleration < (open_ ? kFallsOn : kFalls);
  if (flies && !open_) {
    // A flight that was too short to count is overwritten.
    const Flight& last = flights_[newest_];
    if (last.end - last.start > kTooShort) newest_ = (newest_ + 1) % flights_.size();
    // A body returns to its height after twice the time of its rise.
    flights_[newest_] = {now.time, now.time, 2 * body.velocity / kGravity};
  }
  open_ = flies;
  if (flies) flights_[newest_].end = now.time;
}

float FlightWatch::amount(double time) const noexcept {
  float max = 0;
  for (size_t f = 0; f < flights_.size(); ++f) {
    const Flight& flight = flights_[f];
    double lasts = flight.end - flight.start;
    // A flight in progress counts as soon as it is expected to be long enough, eased in as if it
    // were just that long.
    if (open_ && f == newest_) {
      lasts = std::max(lasts, std::min(flight.expected, lasts + kTooShort));
    }
    if (lasts <= kTooShort) continue;
    const double before = (flight.start - kBefore - time) / kEaseIn,
                 after = (time - flight.end - kAfter) / kEaseOut;
    const double near = 1 - std::max(before, after);
    const double whole = (lasts - kTooShort) / (kWhole - kTooShort);
    max = std::max(max,
                   smooth_step(static_cast<float>(near)) * smooth_step(static_cast<float>(whole)));
  }
  return max;
}

namespace {

constexpr float kReturnSeconds = 0.12f;  // Time constant, on the ground.
constexpr float kNothing = 1e-6f;        // Metres.

}  // namespace

void FreeFall::step(float flight, const StepTime& time, BodyChange& change) noexcept {
  const float wanted = change.translation.y;
  if (time.first) wanted_ = wanted, held_ = 0;
  held_ -= flight * (wanted - wanted_);
  approach(held_, 0, (1 - flight) * time.gain(kReturnSeconds), kNothing);
  wanted_ = wanted;
  change.translation.y += held_;
}

}  // namespace panache
