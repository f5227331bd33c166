#include "style/play/play_head.h"

#include <algorithm>
#include <cmath>

namespace panache {
namespace {

constexpr double kEase = 0.1;         // Seconds.
constexpr double kReturnSpeed = 0.1;  // Relative to the clock: a tenth is not noticeable.
constexpr double kReturnSeconds = 0.5;

double smooth(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

}  // namespace

double PlayHead::ease() const noexcept { return std::min(kEase, (max_lag_ + max_lead_) / 2); }

double PlayHead::room_ahead() const noexcept {
  return ease() > 0 ? smooth((max_lead_ - ahead_) / ease()) : 0;
}

double PlayHead::room_behind() const noexcept {
  return ease() > 0 ? smooth((ahead_ + max_lag_) / ease()) : 0;
}

double PlayHead::advance(double seconds, double rate, bool styled) noexcept {
  const double before = ahead_;
  if (!styled) {
    const double back = std::clamp(ahead_ / kReturnSeconds, -kReturnSpeed, kReturnSpeed);
    ahead_ -= back * seconds;
    if (std::abs(ahead_) < 1e-3) ahead_ = 0;
  } else if (rate > 1) {
    ahead_ += (rate - 1) * room_ahead() * seconds;
  } else {
    ahead_ += (rate - 1) * room_behind() * seconds;
  }
  // A long step may have gone too far.
  ahead_ = std::clamp(ahead_, -max_lag_, max_lead_);
  return std::max(0.0, seconds + ahead_ - before);
}

}  // namespace panache
