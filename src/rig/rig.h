#pragma once
// How one skeleton maps to a humanoid.

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/quat.h"
#include "base/result.h"
#include "clip/clip.h"
#include "rig/calibration.h"
#include "rig/followers.h"
#include "rig/humanoid.h"
#include "rig/mapping.h"

namespace panache {

// One row of a skeleton's mapping.
struct JointMatch {
  std::string human_joint;  // "leftLowerArm"
  std::string joint;        // Its name in the skeleton; empty if it is missing.
  std::string reason;       // "next joint above leftHand", "missing", ...
  float confidence;         // 0 (a guess) to 1 (certain); 0 if the joint is missing.
};

// A user's overrides for the detection of a rig.
struct RigOptions {
  std::optional<float> metres_per_unit;
  std::optional<std::string> up_axis;  // "+Y", "-Z", ...
  // The name of the skeleton's joint for a human joint; empty: the skeleton has none. All others
  // are detected.
  std::map<int, std::string> joints;
  // The same by joint index, -1: the skeleton has none; for names that are not unique. Takes
  // precedence over a name.
  KnownJoints joint_indices;
  // The figure, of several in the skeleton, by its name in find_figures(); empty: the one that has
  // the given joints, or that the clip moves.
  std::string figure;
};

// The result of analysing a skeleton. Immutable; copies share it. A PosedRig converts poses of the
// skeleton to the canonical body and back.
class Rig {
 public:
  // Finds the humanoid in the skeleton of `clip`, and unit, up axis, floor, first usable frame and
  // toes from its poses. An error message says which joints are missing and lists the skeleton's. A
  // clip needs at least one frame. `options` override the detection; missing or ambiguous joints
  // and invalid axes are rejected.
  static Result<Rig> create(const Clip& clip, const RigOptions& options = {});

  // skeleton joint of each human joint, -1 where the skeleton has none.
  const std::array<int, kHumanJoints>& joints() const { return shared_->file_joints; }
  size_t joint_count() const { return shared_->skeleton.joints.size(); }  // Joints of the skeleton.
  // How each was found, for display ("by its name", "next joint above leftHand", "missing", ...).
  const std::array<std::string, kHumanJoints>& reasons() const { return shared_->mapping.reasons; }
  // All of the above in the order of the human joints, for display.
  std::vector<JointMatch> matches() const;
  const std::string& up_axis() const { return shared_->calibration.up_axis; }  // "+Y", "-Z", ...
  // Metres per file unit for canonical legs, unless it was given.
  float scale() const { return shared_->calibration.scale; }
  // The file's most likely unit in metres: a common unit near scale(), which keeps short people
  // short; scale() if none is near, or if it was given.
  float unit() const { return shared_->unit; }
  float floor() const { return shared_->calibration.floor; }  // Its height, Y up, metres.
  // 1 if frame 0 is not part of the motion.
  int first_frame() const { return shared_->calibration.first_frame; }
  // Whether the hips, or a joint above them, can be moved.
  bool can_move() const { return shared_->moved_joint >= 0; }
  // The skeleton at rest, in one frame. Only feet that do not hang on their shins may be elsewhere
  // than in the file.
  Clip rest() const { return rest_clip(shared_->skeleton); }
  // The joint above the hips that carries the body's path over the ground in the clip; -1 if the
  // hips do.
  int ground_joint() const { return shared_->ground_joint; }
  const std::vector<std::string>& notes() const { return shared_->notes; }
  // Those of them that say what the file's names do not: a choice of figure, sides, joints that
  // follow the body or are missing.
  const std::vector<std::string>& remarks() const { return shared_->remarks; }

  // Unit direction from the wrist to the fingertips in the hand's axes (those of BodyPose::hands);
  // zero if it is unknown. `side`: 0 left, 1 right.
  Vec3 hand_direction(int side) const noexcept { return shared_->calibration.hands[side]; }

  // Turns a whole pose by `turn` (radians, about +y through `about`), then moves it by `move`, both
  // world, Y up, metres, by changing its root joints. If both are zero, it stays identical.
  void transform_root(float turn, Vec3 about, Vec3 move, Pose pose) const noexcept;

 private:
  friend class PosedRig;
  Rig() = default;

  struct Shared {
    Skeleton skeleton;         // The file's, see rest().
    std::vector<Joint> added;  // After those, fixed: they stand for missing ones (complete_body()).
    Mapping mapping;           // To both.
    std::array<int, kHumanJoints> file_joints;  // To the file's, -1 for others.
    Calibration calibration;
    float unit = 1;
    std::vector<std::string> notes, remarks;
    // Human joint of each joint, added ones included, that a change may rotate, or -1.
    std::vector<int> human_of;
    // The human joint whose change each joint gets or inherits, or -1.
    std::vector<int> moved_by;
    int moved_joint = -1;   // The skeleton joint that carries the translation, or -1.
    int ground_joint = -1;  // A joint above it that carries its part along the ground, or -1.
    // The joint whose position each one keeps, which is not above it, or -1; and all joints, each
    // after its parent and the one that it follows. Empty if none follows.
    std::vector<int> followed, order;
    // The file's joints whose place in the world is needed, parents first, and their parents.
    struct Placed {
      int joint, parent;
    };
    std::vector<Placed> placed;
    BodyPose first_body;  // The clip's first finite pose.

    bool leave_unkeyed_joints();
    void find_movers(const Clip& clip);
    void find_placed();
  };

  std::shared_ptr<const Shared> shared_;
};

}  // namespace panache
