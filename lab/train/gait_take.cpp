#include "train/gait_take.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/quat.h"
#include "learn/fit_style.h"
#include "rig/canonical_body.h"

namespace panache {
namespace {

constexpr int kMinFrames = 12;

// The four cubic B-splines that are not zero at `x`, in knots; the first has index floor(x).
std::array<double, 4> splines(double x) {
  const double t = x - std::floor(x), r = 1 - t;
  return {r * r * r / 6, (3 * t * t * t - 6 * t * t + 4) / 6,
          (-3 * t * t * t + 3 * t * t + 3 * t + 1) / 6, t * t * t / 6};
}

// The part of `values` that does not repeat with the gait: a spline with one knot per cycle, fitted
// together with harmonics of the phase that absorb the periodic part.
std::vector<double> smooth(const std::vector<double>& values, const std::vector<double>& phase,
                           double cycle_frames) {
  constexpr int kRepeating = 6;  // Cosine and sine of three harmonics.
  const int frames = static_cast<int>(values.size());
  const int knots = 4 + static_cast<int>((frames - 1) / cycle_frames);
  Ridge fit(knots + kRepeating, 1);
  const auto row_of = [&](int f) {
    std::vector<double> row(static_cast<size_t>(knots) + kRepeating, 0.0);
    const double x = f / cycle_frames;
    const std::array<double, 4> near = splines(x);
    for (int k = 0; k < 4; ++k) row[static_cast<size_t>(x) + k] = near[k];
    for (int k = 0; k < kRepeating; k += 2) {
      const int times = k / 2 + 1;  // Per cycle.
      row[knots + k] = std::cos(times * phase[f]);
      row[knots + k + 1] = std::sin(times * phase[f]);
    }
    return row;
  };
  for (int f = 0; f < frames; ++f) fit.add(row_of(f), std::array{values[f]});
  // A small bending penalty gives a take of a single cycle a straight path.
  for (int k = 1; k + 1 < knots; ++k) {
    std::vector<double> bend(static_cast<size_t>(knots) + kRepeating, 0.0);
    bend[k - 1] = bend[k + 1] = 1;
    bend[k] = -2;
    fit.add(bend, std::array{0.0}, 1.0);
  }
  const std::vector<double> weights =
      fit.solve(std::vector<double>(static_cast<size_t>(knots) + kRepeating, 1e-6));
  std::vector<double> out(frames);
  for (int f = 0; f < frames; ++f) {
    const std::array<double, 4> near = splines(f / cycle_frames);
    for (int k = 0; k < 4; ++k) {
      out[f] += near[k] * weights[static_cast<size_t>(f / cycle_frames) + k];
    }
  }
  return out;
}

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

double slope_at(const std::vector<double>& values, int f) {
  const int last = static_cast<int>(values.size()) - 1;
  const int a = std::max(f - 1, 0), b = std::min(f + 1, last);
  return (values[b] - values[a]) / (b - a);
}

// The unwrapped angle of the point (distance of the ankles, its rate of change). It goes round once
// per cycle, but not evenly.
std::vector<double> rough_phase(const Take& take) {
  const int frames = take.frames();
  std::vector<double> ahead(frames), rate(frames), phase(frames);
  for (int f = 0; f < frames; ++f) {
    ahead[f] = static_cast<double>(take.body[f][index(kAnkles[0])].z) -
               static_cast<double>(take.body[f][index(kAnkles[1])].z);
  }
  const double middle = mean(ahead);
  double spread = 0, spread_rate = 0;
  for (int f = 0; f < frames; ++f) {
    ahead[f] -= middle;
    rate[f] = slope_at(ahead, f);
  }
  for (int f = 0; f < frames; ++f) {
    rate[f] = slope_at(ahead, f);
    spread += ahead[f] * ahead[f];
    spread_rate += rate[f] * rate[f];
  }
  const double to_circle = std::sqrt(spread / std::max(spread_rate, 1e-12));
  for (int f = 0; f < frames; ++f) {
    phase[f] = std::atan2(-rate[f] * to_circle, ahead[f]);
    if (f) phase[f] -= kGaitCycle * std::round((phase[f] - phase[f - 1]) / kGaitCycle);
  }
  return phase;
}

}  // namespace

Channels gait_channels(const Take& take, int frame, Vec3 origin, float facing) {
  const RootPose& root = take.root[frame];
  const Quat to_path = rotation_y(-facing);
  std::array<Quat, kHumanJoints> world;
  canonical_frames(take.body[frame], 0, world);
  Channels out;
  const Vec3 hips = rotate(to_path, root.position - origin);
  out[0] = hips.x;
  out[1] = take.body[frame][0].y;
  out[2] = hips.z;
  for (size_t i = 0; i < kDriven.size(); ++i) {
    const int j = index(kDriven[i]);
    const Quat local = j ? conjugate(world[kHumanParent[j]]) * world[j]
                         : rotation_y(root.facing - facing) * world[0];
    const Vec3 r = log_rotation(local);
    out[3 * i + 3] = r.x;
    out[3 * i + 4] = r.y;
    out[3 * i + 5] = r.z;
  }
  return out;
}

std::vector<GaitFrame> gait_frames(const Take& take) {
  const int frames = take.frames();
  if (frames < kMinFrames) return {};
  const std::vector<double> rough = rough_phase(take);
  const double cycles = (rough.back() - rough.front()) / kGaitCycle;
  if (!(cycles > 0.8)) return {};
  const double cycle_frames = (frames - 1) / cycles;
  // Once more, with harmonics of the evened phase.
  std::vector<double> phase = smooth(rough, rough, cycle_frames);
  phase = smooth(rough, phase, cycle_frames);

  std::vector<double> x(frames), z(frames), facing(frames);
  for (int f = 0; f < frames; ++f) {
    x[f] = static_cast<double>(take.root[f].position.x);
    z[f] = static_cast<double>(take.root[f].position.z);
    facing[f] = static_cast<double>(take.root[f].facing);
  }
  x = smooth(x, phase, cycle_frames);
  z = smooth(z, phase, cycle_frames);
  facing = smooth(facing, phase, cycle_frames);
  std::vector<double> ahead(frames), left(frames);
  for (int f = 0; f < frames; ++f) {
    const double vx = slope_at(x, f) * kTakeRate, vz = slope_at(z, f) * kTakeRate;
    ahead[f] = vx * std::sin(facing[f]) + vz * std::cos(facing[f]);
    left[f] = vx * std::cos(facing[f]) - vz * std::sin(facing[f]);
  }
  std::vector<GaitFrame> out(frames);
  for (int f = 0; f < frames; ++f) {
    out[f].phase = phase[f];
    out[f].cadence = slope_at(phase, f) * kTakeRate / kGaitCycle;
    out[f].going = {static_cast<float>(ahead[f]),
                    static_cast<float>(slope_at(facing, f) * kTakeRate),
                    static_cast<float>(slope_at(ahead, f) * kTakeRate)};
    out[f].sideways = left[f];
    const Vec3 origin = {static_cast<float>(x[f]), 0, static_cast<float>(z[f])};
    out[f].channels = gait_channels(take, f, origin, static_cast<float>(facing[f]));
  }
  return out;
}

}  // namespace panache
