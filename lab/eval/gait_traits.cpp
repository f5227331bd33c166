#include "eval/gait_traits.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "eval/report_numbers.h"

namespace panache {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;
constexpr int kEased = static_cast<int>(0.4 * kTakeRate);  // Frames left out at the start.
constexpr int kMinFrames = static_cast<int>(kTakeRate);
constexpr double kLeg = 0.85;  // Metres.
// The range and spacing of stride frequencies (two steps), Hz.
constexpr double kSlowest = 0.3, kFastest = 2.5, kSpacing = 0.01;

double deviation(const std::vector<double>& values) {
  const double middle = finite_mean(values);
  double squares = 0;
  for (const double value : values) squares += (value - middle) * (value - middle);
  return std::sqrt(squares / static_cast<double>(values.size()));
}

// The strongest frequency of the feet's distance along the heading, Hz.
double stride_frequency(const Take& take) {
  using enum HumanJoint;
  std::vector<double> strides;
  for (int f = kEased; f < take.frames(); ++f) {
    strides.push_back(double{take.body[f][index(left_foot)].z - take.body[f][index(right_foot)].z});
  }
  const double middle = finite_mean(strides);
  double best = 0, strongest = -1;
  for (double hertz = kSlowest; hertz <= kFastest; hertz += kSpacing) {
    double cosine = 0, sine = 0;
    for (size_t i = 0; i < strides.size(); ++i) {
      const double angle = 2 * std::numbers::pi * hertz * static_cast<double>(i) / kTakeRate;
      cosine += (strides[i] - middle) * std::cos(angle);
      sine += (strides[i] - middle) * std::sin(angle);
    }
    const double power = cosine * cosine + sine * sine;
    if (power > strongest) strongest = power, best = hertz;
  }
  return best;
}

}  // namespace

Movement movement_of(const Take& take) {
  using enum HumanJoint;
  Movement out;
  out.fill(std::numeric_limits<double>::quiet_NaN());
  if (take.frames() < kMinFrames) return out;
  std::vector<double> thighs, wrists, heights, leans;
  std::array<std::vector<double>, 2> swings;
  for (int f = kEased; f < take.frames(); ++f) {
    const auto at = [&](HumanJoint joint) { return take.body[f][index(joint)]; };
    const auto side = [&](size_t s, HumanJoint hip, HumanJoint knee, HumanJoint shoulder,
                          HumanJoint elbow, HumanJoint wrist) {
      const Vec3 thigh = at(knee) - at(hip);
      thighs.push_back(kDegrees * std::atan2(thigh.z, -thigh.y));
      const double arm = length(at(elbow) - at(shoulder)) + length(at(wrist) - at(elbow));
      wrists.push_back((at(wrist).y - at(shoulder).y) / arm);
      swings[s].push_back(at(wrist).z - at(chest).z);
    };
    side(0, left_upper_leg, left_lower_leg, left_upper_arm, left_lower_arm, left_hand);
    side(1, right_upper_leg, right_lower_leg, right_upper_arm, right_lower_arm, right_hand);
    heights.push_back(at(hips).y);
    const Vec3 trunk = at(neck) - at(hips);
    leans.push_back(kDegrees * std::atan2(trunk.z, trunk.y));
  }
  const double cm = 100 * kLeg / kProportions.leg;
  out = {quantile(thighs, 0.9),
         quantile(wrists, 0.9),
         cm * (deviation(swings[0]) + deviation(swings[1])) / 2,
         cm * deviation(heights),
         quantile(leans, 0.5),
         2 * stride_frequency(take),
         quantile(heights, 0.5) / kProportions.leg};
  return out;
}

SideVector side_of(const Take& take) {
  if (take.frames() < kMinFrames) return {};
  // Whole strides: half a stride more and one foot is ahead on average.
  const int first = kEased;
  const double all = take.frames() - first, stride = kTakeRate / stride_frequency(take);
  const int count = static_cast<int>(all < stride ? all : std::floor(all / stride) * stride);
  const int end = first + count;
  HumanPositions middle{}, spread{};
  const auto position = [&](int f, int j) { return take.body[f][j] - take.body[f][0]; };
  for (int j = 0; j < kHumanJoints; ++j) {
    for (int f = first; f < end; ++f) {
      middle[j] += position(f, j) * (1.0f / static_cast<float>(count));
    }
    for (int f = first; f < end; ++f) {
      const Vec3 off = position(f, j) - middle[j];
      spread[j] +=
          Vec3{off.x * off.x, off.y * off.y, off.z * off.z} * (1.0f / static_cast<float>(count));
    }
    spread[j] = {std::sqrt(spread[j].x), std::sqrt(spread[j].y), std::sqrt(spread[j].z)};
  }
  SideVector out;
  const HumanPositions reflected = mirrored(middle);
  for (int j = 0; j < kHumanJoints; ++j) out.push_back((middle[j] - reflected[j]) * 0.5f);
  for (int j = 0; j < kHumanJoints; ++j) {
    out.push_back((spread[j] - spread[kHumanMirror[j]]) * 0.5f);
  }
  return out;
}

double side_size(const SideVector& side) {
  double sum = 0;
  for (size_t j = 0; j < side.size() / 2; ++j) sum += length(side[j]);
  return sum / kHumanJoints;
}

}  // namespace panache
