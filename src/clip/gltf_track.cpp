#include "clip/gltf_track.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/quat.h"

namespace panache {
namespace {

constexpr double kUsualRate = 30, kLowestRate = 24, kHighestRate = 120;  // Frames per second.
// Below this, keys are poses to move between, not frames. Film's 24 and 23.976 are above.
constexpr double kSparseRate = 20;
// Maximum distance of a key from its frame, in frames, apart from the rounding of times.
constexpr double kKeyTolerance = 1e-3;

Quatd quat_at(std::span<const float> v) { return Quat{v[0], v[1], v[2], v[3]}.as<double>(); }

void put(Quatd q, std::span<float> out) {
  const Quat f = q.as<float>();
  out[0] = f.x, out[1] = f.y, out[2] = f.z, out[3] = f.w;
}

// Along the shorter arc at constant speed, as glTF requires.
Quatd slerp(Quatd a, Quatd b, double t) {
  a = normalized(a);
  b = normalized(b);
  const double c = dot(a, b);
  // For a small angle, dividing by the sine is inaccurate, and a straight line is as good.
  if (std::abs(c) > 1 - 1e-9) return nlerp(a, b, t);
  const double angle = std::acos(std::abs(c));
  const double u = std::sin((1 - t) * angle), v = std::sin(t * angle) * (c < 0 ? -1 : 1);
  return normalized(
      Quatd{a.x * u + b.x * v, a.y * u + b.y * v, a.z * u + b.z * v, a.w * u + b.w * v});
}

// Whether every key is an integer number of `step`s after the first.
bool lies_on(const std::vector<float>& times, double step) {
  const double first = times.front();
  for (const double seconds : times) {
    const double steps = (seconds - first) / step;
    if (!(std::abs(steps - std::round(steps)) * step <= key_tolerance(seconds, step))) return false;
  }
  return true;
}

double median_spacing(const std::vector<float>& times) {
  std::vector<double> spacings;
  for (size_t i = 1; i < times.size(); ++i) {
    spacings.push_back(double(times[i]) - times[i - 1]);
  }
  const auto middle = spacings.begin() + spacings.size() / 2;
  std::nth_element(spacings.begin(), middle, spacings.end());
  return *middle;
}

// The times of keys that are at different instants: of several at one time, the first.
std::vector<float> without_repeats(const std::vector<float>& times) {
  std::vector<float> out;
  for (const float time : times) {
    // No motion has more frames a second.
    constexpr float kSameInstant = 2e-5f;
    const bool repeats = !out.empty() && time - out.back() < kSameInstant + out.back() * 0x1p-22f;
    if (!repeats) out.push_back(time);
  }
  return out;
}

// Seconds between frames that hit all of these keys; 0 if there is no such rate.
double key_step(const std::vector<float>& times) {
  const double mean = (double(times.back()) - times.front()) / (times.size() - 1);
  // If an integer rate fits, it was meant: times are rounded. The mean is the step of keys without
  // gaps, the median that of keys with a few missing.
  for (const double step : {mean, median_spacing(times)}) {
    const double rate = std::round(1 / step);
    if (rate >= 1 && lies_on(times, 1 / rate)) return 1 / rate;
    if (lies_on(times, step)) return step;
  }
  return 0;
}

double frame_time_of(const GltfTrack* deciding) {
  const std::vector<float> times =
      without_repeats(deciding ? deciding->times : std::vector<float>{});
  if (times.size() < 2) return 1 / kUsualRate;
  const double step = key_step(times);
  if (step == 0) {
    return 1 / std::clamp(1 / median_spacing(times), kLowestRate, kHighestRate);
  }
  return step * kSparseRate > 1 ? step / std::ceil(step * kLowestRate) : step;
}

}  // namespace

double key_tolerance(double seconds, double frame_time) {
  // A time is a float, and so may be the one that it is compared with.
  return kKeyTolerance * frame_time + std::abs(seconds) * 0x1p-23;
}

std::span<const float> GltfTrack::key(size_t which) const {
  const size_t parts = interpolation == Interpolation::cubic ? 3 : 1;
  return std::span(numbers).subspan((which * parts + (parts - 1) / 2) * components, components);
}

void GltfTrack::evaluate(double seconds, double tolerance, std::span<float> out) const {
  assert(!times.empty() && out.size() == components);
  const size_t after = std::upper_bound(times.begin(), times.end(), seconds) - times.begin();
  const auto copy = [&](size_t which) { std::ranges::copy(key(which), out.begin()); };
  if (after == 0) return copy(0);
  if (after == times.size()) return copy(after - 1);
  const double begin = times[after - 1], end = times[after];
  if (end - seconds <= tolerance && end - seconds < seconds - begin) return copy(after);
  if (seconds - begin <= tolerance || interpolation == Interpolation::step) return copy(after - 1);

  const double t = (seconds - begin) / (end - begin);
  const std::span<const float> a = key(after - 1), b = key(after);
  if (interpolation == Interpolation::linear) {
    if (std::ranges::equal(a, b)) return copy(after - 1);
    if (rotates) return put(slerp(quat_at(a), quat_at(b), t), out);
    for (size_t k = 0; k < components; ++k) {
      out[k] = static_cast<float>(std::lerp(double(a[k]), double(b[k]), t));
    }
    return;
  }
  // The cubic Hermite spline of glTF's specification, appendix C; tangents are per second.
  const double d = end - begin, t2 = t * t, t3 = t2 * t;
  const std::span<const float> leaving =
      std::span(numbers).subspan(((after - 1) * 3 + 2) * components, components);
  const std::span<const float> arriving =
      std::span(numbers).subspan(after * 3 * components, components);
  for (size_t k = 0; k < components; ++k) {
    out[k] = static_cast<float>((2 * t3 - 3 * t2 + 1) * a[k] + d * (t3 - 2 * t2 + t) * leaving[k] +
                                (3 * t2 - 2 * t3) * b[k] + d * (t3 - t2) * arriving[k]);
  }
  if (rotates) put(normalized(quat_at(out)), out);
}

bool GltfTrack::is_constant() const {
  for (size_t i = 1; i < times.size(); ++i) {
    if (!std::ranges::equal(key(0), key(i))) return false;
  }
  return true;
}

FrameGrid find_grid(const GltfTrack* deciding, double first, double last,
                    std::optional<double> frame_time) {
  FrameGrid grid;
  grid.start = first;
  grid.frame_time = frame_time ? *frame_time : frame_time_of(deciding);
  const double span = last - first - key_tolerance(last, grid.frame_time);
  grid.frames = 1 + std::max(0.0, std::ceil(span / grid.frame_time));
  return grid;
}

}  // namespace panache
