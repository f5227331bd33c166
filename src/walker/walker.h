#pragma once
// A person who walks, runs, turns and stands on the canonical skeleton, steered live.

#include <array>
#include <memory>

#include "base/quat.h"
#include "clip/clip.h"
#include "pose/features.h"
#include "walker/drive.h"
#include "walker/feet.h"
#include "walker/walker_model.h"

namespace panache {

// One character. Deterministic, and nearly independent of the length of steps.
class Walker {
 public:
  explicit Walker(std::shared_ptr<const WalkerModel> model);

  // Stands at the origin, facing +z.
  void reset() noexcept;
  // Advances by `seconds` (limited to 0.25) towards `speed` (0 to kMaxWalkerSpeed, m/s) and `turn`
  // (rad/s, to the left; up to max_walker_turn), both eased. Values out of range are clamped,
  // non-finite ones count as zero. `out`: the 21 joints of canonical_skeleton(), metres. Allocates
  // nothing, never fails.
  void step(float speed, float turn, double seconds, Pose out) noexcept;

  // Position and heading on the path, and the motion along it.
  RootPose root() const noexcept;
  Going going() const noexcept { return drive_.going(); }

 private:
  struct Instant {
    std::array<Quat, kHumanJoints> rotations;
    Vec3 hips;
  };
  void tick(float speed, float turn) noexcept;
  void pose_body() noexcept;
  void pose_legs(float dt) noexcept;

  std::shared_ptr<const WalkerModel> model_;
  std::array<Vec3, kHumanJoints> offsets_;  // Of the skeleton at rest.
  Drive drive_;
  Feet feet_;
  double seconds_ = 0;  // Since reset().
  int64_t ticks_ = 0;
  Vec3 up_;               // Of the leaning body.
  Instant before_, now_;  // At the last two ticks: the pose is interpolated between them.
};

// Parameters of walk_clip: a constant speed and turn, from the middle of a stride or, with `start`,
// from standing; with `stop`, back to standing.
struct WalkClipOptions {
  double seconds = 8;
  double fps = 60;
  float speed = 1.4f;  // m/s
  float turn = 0;      // rad/s, to the left.
  bool start = false, stop = false;
};
// A clip of canonical_skeleton(), starting at the origin and facing +z.
Clip walk_clip(std::shared_ptr<const WalkerModel> model, const WalkClipOptions& options);

}  // namespace panache
