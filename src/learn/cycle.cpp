#include "learn/cycle.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "pose/loop.h"
#include "pose/root_pose.h"

namespace panache {
namespace {

constexpr double kLongestCycle = 2;  // Seconds.
// Maximum distance between the last pose of a cycle and its first, in metres, or in the
// frame-to-frame steps there: a file may omit the frame that repeats the first.
constexpr double kSeam = 0.02, kSeamSteps = 1.6;
// Frames added to a cycle: two windows of a styled take at half its speed.
constexpr int kAddedFrames = 90;
// A pair with less than this cost is in phase. A continued cycle always fits a little better, so it
// must do so by this factor.
constexpr double kInPhase = 0.1, kBetter = 0.9;

template <class T>
void repeat(std::vector<T>& frames, size_t cycle, size_t count) {
  frames.resize(cycle);
  frames.reserve(count);
  for (size_t f = cycle; f < count; ++f) frames.push_back(T(frames[f - cycle]));
}

// `cycle`: from cycle_frames(). The take may end a frame before the cycle does, because of where
// its frames lie.
Take continued(Take take, int cycle) {
  cycle = std::min(cycle, take.frames());
  const RootPose begin = take.root.front();
  RootPose end = take.root.back();
  if (cycle < take.frames()) end = take.root[cycle];
  if (cycle == take.frames()) end = interpolate(take.root[cycle - 2], end, 2);
  const size_t one = cycle, count = 2 * one + kAddedFrames;
  repeat(take.body, one, count);
  repeat(take.rotations, one, count);
  repeat(take.contacts, one, count);
  repeat(take.root, one, count);
  const float turned = end.facing - begin.facing;
  for (size_t f = one; f < count; ++f) {
    const RootPose& before = take.root[f - one];
    take.root[f] = {end.position + rotate(rotation_y(turned), before.position - begin.position),
                    before.facing + turned};
  }
  write_numbers(PoseLayout::positions, take);
  return take;
}

}  // namespace

double mean_cost(const std::vector<Pairing>& pairings) {
  double sum = 0;
  for (const Pairing& pairing : pairings) sum += pairing.cost;
  return sum / pairings.size();
}

int cycle_frames(const Clip& clip, const Rig& rig) {
  const LoopSeam seam = measure_seam(clip, rig);
  if (seam.frames() < 3) return 0;
  const double gap = seam.gap, first_step = seam.first_step, last_step = seam.last_step;
  if (!(gap < std::max(kSeam, kSeamSteps * std::max(first_step, last_step)))) return 0;
  const int steps = seam.frames() + (gap < first_step / 2 ? 0 : 1);
  const double seconds = steps * clip.frame_time;
  return seconds > kLongestCycle ? 0 : static_cast<int>(std::lround(seconds * kTakeRate));
}

std::vector<Pairing> pair_in_phase(std::vector<Take>& takes, int styled, int neutral, int cycle) {
  std::vector<Pairing> found = pair_takes(takes, {styled}, {neutral});
  if (cycle == 0 || (!found.empty() && mean_cost(found) < kInPhase)) return found;
  Take one = continued(takes[neutral], cycle);
  std::swap(one, takes[neutral]);
  std::vector<Pairing> anywhere = pair_takes(takes, {styled}, {neutral});
  if (!anywhere.empty() && (found.empty() || mean_cost(anywhere) < kBetter * mean_cost(found))) {
    return anywhere;
  }
  takes[neutral] = std::move(one);
  return found;
}

}  // namespace panache
