#pragma once
// How far a style goes beyond what is usual for it, moment by moment.

#include <array>
#include <span>
#include <vector>

#include "learn/pairing.h"
#include "learn/take.h"
#include "style/gesture.h"

namespace panache {

// What may move in a gesture.
enum GesturePart { kHead, kTorso, kHips, kLeftArm, kRightArm, kHeight, kLift, kGestureParts };

struct Excess {
  GesturePose pose;  // On top of the usual change; zero where nothing is paired.
  // Of each part: radians that it turns beyond what it hangs on, metres for height and lift.
  std::array<float, kGestureParts> size{};
};

// Of each frame of takes[styled]: how its change from the neutral motion that it is paired with
// differs from the median change of the take, smoothed over about 0.1 s.
std::vector<Excess> style_excess(const std::vector<Take>& takes, int styled,
                                 std::span<const Pairing> pairings);

// The middle one; 0 of none.
float median(std::vector<float> values);

}  // namespace panache
