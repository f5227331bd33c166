#include "pose/loop.h"

#include <algorithm>

#include "clip/text_cursor.h"
#include "pose/observer.h"
#include "pose/pose_distance.h"

namespace panache {
namespace {

constexpr int kLooks = 64;  // Poses sampled for the extent.
// A shorter clip is part of a cycle.
constexpr double kShortest = 0.3;  // Seconds.
constexpr int kFewestFrames = 4;
// The poses of an authored loop differ only by rounding in the file. Metres.
constexpr float kAuthoredGap = 0.001f, kAuthoredWorst = 0.005f;
// Walks and runs of CMU that are cut after the cycle that ends nearest to where it began are 0.8 to
// 3.2 cm off in the mean of the joints and 2.5 to 9.5 at the worst one: a quarter of what any two
// poses of them are apart, and 10 to 55 ms of the motion there. Takes that begin and end at rest
// are as near, but pass the seam so slowly that they are 80 ms off or more. Of 1,375 whole takes
// six are loops: walks that happen to end as they began.
constexpr float kCutGap = 0.04f, kCutWorst = 0.15f, kCutShare = 0.25f, kCutSeconds = 0.06f;
// The largest gap that can be spread over a cycle: two poses of a walk are up to twice that far
// apart.
constexpr float kMaxGap = 0.1f;  // Metres.

bool is_long_enough(const LoopSeam& seam, double frame_time) {
  return seam.frames() >= kFewestFrames && seam.frames() * frame_time > kShortest - 1e-6;
}

}  // namespace

LoopSeam measure_seam(const Clip& clip, const Rig& rig) {
  LoopSeam seam;
  seam.last = clip.frames - 1;
  seam.first = std::min(rig.first_frame(), seam.last);
  PosedRig reader(rig);
  Observation begin, now;
  observe(reader, clip.pose(seam.first), 0, begin);
  float facing = begin.root.facing;
  const int step = std::max(1, seam.frames() / kLooks);
  for (int f = seam.first; f < seam.last; f += step) {
    observe(reader, clip.pose(f), facing, now);
    facing = now.root.facing;
    seam.extent = std::max(seam.extent, pose_distance(now.body_frame, begin.body_frame).mean);
  }
  observe(reader, clip.pose(seam.last), facing, now);
  const PoseDistance apart = pose_distance(now.body_frame, begin.body_frame);
  seam.gap = apart.mean, seam.worst = apart.largest;
  seam.extent = std::max(seam.extent, seam.gap);
  seam.begin = begin.root, seam.end = now.root;
  if (seam.frames() < 2) return seam;
  Observation second, before;
  observe(reader, clip.pose(seam.first + 1), begin.root.facing, second);
  observe(reader, clip.pose(seam.last - 1), facing, before);
  seam.first_step = pose_distance(begin.body_frame, second.body_frame).mean;
  seam.last_step = pose_distance(before.body_frame, now.body_frame).mean;
  for (size_t j = 0; j < now.body_frame.size(); ++j) {
    const Vec3 after = second.body_frame[j] - begin.body_frame[j];
    const Vec3 until = now.body_frame[j] - before.body_frame[j];
    seam.speed += length(after + until) / static_cast<float>(2 * clip.frame_time * kHumanJoints);
  }
  return seam;
}

bool is_loop(const LoopSeam& seam, double frame_time) noexcept {
  if (!is_long_enough(seam, frame_time)) return false;
  if (seam.gap <= kAuthoredGap && seam.worst <= kAuthoredWorst) return true;
  return seam.gap <= kCutGap && seam.worst <= kCutWorst && seam.gap <= kCutShare * seam.extent &&
         seam.gap <= kCutSeconds * seam.speed;
}

Result<void> check_closable(const LoopSeam& seam, double frame_time) {
  if (!is_long_enough(seam, frame_time)) {
    return Error{"the motion is not a loop: it lasts " +
                 with_decimals(seam.frames() * frame_time, 2) + " s; expected at least " +
                 with_decimals(kShortest, 1) + " s and " + std::to_string(kFewestFrames) +
                 " frames"};
  }
  if (!(seam.gap <= kMaxGap)) {
    return Error{"the motion is not a loop: its last pose is " +
                     with_decimals(100 * static_cast<double>(seam.gap), 1) +
                     " cm from its first in the mean of the joints; expected at most " +
                     with_decimals(100 * static_cast<double>(kMaxGap), 0) +
                     " cm, as where a clip is cut after a whole cycle",
                 ErrorKind::loop_open};
  }
  return {};
}

}  // namespace panache
