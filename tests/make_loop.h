#pragma once
// Walks of the walker that are cut after a cycle, for tests of loops.

#include <limits>

#include "pose/loop.h"
#include "walker/walker.h"

namespace panache::test {

// Frames `first` to `last` of a clip.
inline Clip cut(const Clip& clip, int first, int last) {
  Clip out{clip.skeleton, clip.frame_time, 0, {}, {}};
  for (int f = first; f <= last; ++f) out.append(clip.pose(f));
  return out;
}

// From frame `first` on to where the pose is nearest to that one again, 0.6 to 1.6 seconds later.
inline Clip cut_cycle(const Clip& clip, int first) {
  const auto frames = [&](double seconds) { return static_cast<int>(seconds / clip.frame_time); };
  Clip best;
  float min = std::numeric_limits<float>::infinity();
  for (int last = first + frames(0.6); last <= first + frames(1.6) && last < clip.frames; ++last) {
    Clip cycle = cut(clip, first, last);
    const float gap = measure_seam(cycle, *Rig::create(cycle)).gap;
    if (gap < min) min = gap, best = std::move(cycle);
  }
  return best;
}

inline Clip walk(double seconds, float speed, float turn = 0, double fps = 60) {
  WalkClipOptions options;
  options.seconds = seconds;
  options.fps = fps;
  options.speed = speed;
  options.turn = turn;
  return walk_clip(*WalkerModel::load(PANACHE_SOURCE_DIR "/models/walker.safetensors"), options);
}

// One cycle of such a walk, from this frame on; as steps take no whole number of frames, its last
// pose is within half a frame of its first.
constexpr int kCycleBegin = 7;
inline Clip walk_cycle(float speed = 1.3f, float turn = 0, double fps = 60) {
  return cut_cycle(walk(2.5, speed, turn, fps), kCycleBegin);
}

}  // namespace panache::test
