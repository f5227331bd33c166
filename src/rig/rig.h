#pragma once
// How one skeleton is a humanoid.

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/quat.h"
#include "base/result.h"
#include "clip/clip.h"
#include "rig/body_pose.h"
#include "rig/calibration.h"
#include "rig/humanoid.h"
#include "rig/mapping.h"

namespace panache {

// One line of how a skeleton was understood.
struct JointMatch {
  std::string human_joint;  // "leftLowerArm"
  std::string joint;        // The skeleton's name for it; empty where it has none.
  std::string reason;       // "next joint above leftHand", "missing", ...
  float confidence;         // 0 (a guess) to 1 (certain); 0 where the joint is missing.
};

// A user's overrides for the detection of a rig.
struct RigOptions {
  std::optional<float> metres_per_unit;
  std::optional<std::string> up_axis;  // "+Y", "-Z", ...
  // The name of the skeleton's joint for a human joint; empty says that the skeleton has none. All
  // others are found as ever.
  std::map<int, std::string> joints;
  // The same by the joint's place in the skeleton, -1 says that it has none; for names that are not
  // unique. Goes before a name.
  KnownJoints joint_places;
};

// The result of analysing a skeleton. Immutable; copies share it. A PosedRig brings poses from
// the skeleton to the canonical body and back.
class Rig {
 public:
  // Finds the humanoid in the skeleton of `clip`, and units, up axis, floor, first usable frame and
  // toes from its poses. The message of a failure says which joints were not found and names those
  // that were seen. A clip needs at least one frame. `options` override the detection;
  // missing or ambiguous joints and invalid axes are rejected.
  static Result<Rig> create(const Clip& clip, const RigOptions& options = {});

  // skeleton joint of each human joint, -1 where the skeleton has none.
  const std::array<int, kHumanJoints>& joints() const { return shared_->mapping.joint_of; }
  size_t joint_count() const { return shared_->human_of.size(); }  // Joints of the skeleton.
  // How each was found, for people ("by its name", "next joint above leftHand", "missing", ...).
  const std::array<std::string, kHumanJoints>& reasons() const { return shared_->mapping.reasons; }
  // All of the above in the order of the human joints, for showing.
  std::vector<JointMatch> matches() const;
  const std::string& up_axis() const { return shared_->calibration.up_axis; }  // "+Y", "-Z", ...
  // Metres per file unit for legs as long as the canonical body's, unless it was given.
  float scale() const { return shared_->calibration.scale; }
  // Metres per file unit as the file most likely means them: a usual unit near scale(), so that a
  // short person stays short; scale() where none is near, or where it was given.
  float unit() const { return shared_->unit; }
  float floor() const { return shared_->calibration.floor; }  // Its height, Y up, metres.
  // 1: the first is for calibration.
  int first_frame() const { return shared_->calibration.first_frame; }
  // Whether the hips, or a joint above them, can be moved.
  bool can_move() const { return shared_->moved_joint >= 0; }
  const std::vector<std::string>& notes() const { return shared_->notes; }

  // Unit direction from the wrist to the fingertips in the hand's own axes (those of
  // BodyPose::hands); zero where the skeleton does not show it. `side`: 0 left, 1 right.
  Vec3 hand_direction(int side) const noexcept { return shared_->calibration.hands[side]; }

  // Turns a whole pose by `turn` (radians, about +y through `about`), then moves it by `move`, both
  // world, Y up, metres: by its root joints, whatever they are. With neither it stays bit for bit.
  void transform_root(float turn, Vec3 about, Vec3 move, Pose pose) const noexcept;

 private:
  friend class PosedRig;
  Rig() = default;

  struct Shared {
    Skeleton skeleton;
    Mapping mapping;
    Calibration calibration;
    float unit = 1;
    std::vector<std::string> notes;
    // Human joint of each skeleton joint that a change may rotate, or -1.
    std::vector<int> human_of;
    // The human joint whose change each skeleton joint has or inherits, or -1.
    std::vector<int> moved_by;
    int moved_joint = -1;  // The skeleton joint that carries the translation, or -1.
    BodyPose first_body;   // The first of the clip that is finite.
  };

  std::shared_ptr<const Shared> shared_;
};

}  // namespace panache
