#include <algorithm>
#include <cmath>
#include <utility>

#include "rig/canonical_skeleton.h"
#include "walker/walker.h"

namespace panache {
namespace {

// Standing time before the first step and after the last.
constexpr double kStandSeconds = 0.6;
// Maximum time to stop from any speed: the last seconds of a clip with a stop.
constexpr double kSecondsToStand = 2.2;

}  // namespace

Clip walk_clip(std::shared_ptr<const WalkerModel> model, const WalkClipOptions& options) {
  Clip clip;
  clip.skeleton = canonical_skeleton();
  clip.frame_time = 1 / options.fps;
  clip.resize(static_cast<int>(std::max(1.0, std::round(options.seconds * options.fps))));
  Walker walker(std::move(model));
  if (!options.start) {
    // Starts walking before the clip, so that it begins at full speed.
    std::array<Quat, kHumanJoints> rotations;
    std::array<Vec3, kHumanJoints> translations;
    for (int i = 0; i < 600; ++i) {
      walker.step(options.speed, options.turn, 1.0 / 60, {rotations, translations});
    }
  }
  const RootPose begin = walker.root();
  const Quat back = rotation_y(-begin.facing);
  const double stop_at = options.seconds - kSecondsToStand - options.speed / 2.5;
  for (int f = 0; f < clip.frames; ++f) {
    const double seconds = f * clip.frame_time;
    const bool goes =
        (!options.start || seconds >= kStandSeconds) && (!options.stop || seconds < stop_at);
    const Pose pose = clip.pose(f);
    walker.step(goes ? options.speed : 0, goes ? options.turn : 0, f ? clip.frame_time : 0, pose);
    pose.translations[0] = rotate(back, pose.translations[0] - begin.position);
    pose.rotations[0] = normalized(back * pose.rotations[0]);
  }
  return clip;
}

}  // namespace panache
