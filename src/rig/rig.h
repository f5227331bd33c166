#pragma once
// How one skeleton is a humanoid, and how poses travel between it and the canonical body.

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
#include "rig/humanoid.h"

namespace panache {

// One instant of the user's character brought to the canonical body.
struct BodyPose {
  // World, Y up, metres, canonical proportions, floor at 0.
  HumanPositions positions;
  // World rotations of the user's joints turned Y up, in their raw local axes: only their changes
  // mean anything. A missing joint carries its nearest mapped ancestor's.
  std::array<Quat, kHumanJoints> rotations;
  // World positions of the user's own joints, Y up, metres (own proportions, scaled), above the
  // same floor; mid-hip is that of `positions`. Missing hands and toes are where they would be; any
  // other missing joint carries its nearest mapped ancestor's.
  HumanPositions joints;
  // Heading about +y, radians; 0 faces +z. Not unwrapped.
  float facing = 0;
};

// What a style does to one instant.
struct BodyChange {
  // World rotations in the heading frame of the input (origin facing +z), applied on top of each
  // joint's world rotation; the identity leaves the joint alone.
  std::array<Quat, kHumanJoints> rotations;
  float turn = 0;    // Then the whole body turns by this about +y through its hips, radians.
  Vec3 translation;  // And moves by this, world, Y up, canonical metres.
};

// One line of how a skeleton was understood.
struct JointMatch {
  std::string human_joint;  // "leftLowerArm"
  std::string joint;        // The skeleton's name for it; empty where it has none.
  std::string reason;       // "next joint above leftHand", "missing", ...
  float confidence;         // 0 (a guess) to 1 (certain); 0 where the joint is missing.
};

// What a user says of a rig instead of having it found.
struct RigOptions {
  std::optional<float> metres_per_unit;
  std::optional<std::string> up_axis;  // "+Y", "-Z", ...
  // The name of the skeleton's joint for a human joint; empty says that the skeleton has none. All
  // others are found as ever.
  std::map<int, std::string> joints;
};

// What was understood of the skeleton is shared by all copies of a rig; each has its own memory of
// the last pose.
class Rig {
 public:
  // Finds the humanoid in the skeleton of `clip`, and units, up axis, floor, first usable frame and
  // toes from its poses. The sentence of a failure says which joints were not found and names those
  // that were seen. A clip needs at least one frame. What `options` say is believed; a joint that
  // they name and the skeleton has not, or more than once, is refused, as is an axis that is none.
  static Result<Rig> create(const Clip& clip, const RigOptions& options = {});

  // skeleton joint of each human joint, -1 where the skeleton has none.
  const std::array<int, kHumanJoints>& joints() const { return shared_->mapping.joint_of; }
  size_t joint_count() const { return shared_->human_of.size(); }  // Joints of the skeleton.
  // How each was found, for people ("by its name", "next joint above leftHand", "missing", ...).
  const std::array<std::string, kHumanJoints>& reasons() const { return shared_->mapping.reasons; }
  // All of the above in the order of the human joints, for showing.
  std::vector<JointMatch> matches() const;
  const std::string& up_axis() const { return shared_->calibration.up_axis; }  // "+Y", "-Z", ...
  float scale() const { return shared_->calibration.scale; }  // Metres per file unit.
  float floor() const { return shared_->calibration.floor; }  // Its height, Y up, metres.
  int first_frame() const {
    return shared_->calibration.first_frame;
  }  // 1: the first is for calibration.
  const std::vector<std::string>& notes() const { return shared_->notes; }

  // The user's pose on the canonical body. Allocates nothing, never fails. A heading that the pose
  // does not show is the last one; a pose that is not finite is read as the last one.
  void read(ConstPose pose, BodyPose& out) noexcept;

  // The user's pose with `change` on it. `in` and `body` are those of the last read(), whose
  // forward kinematics it reuses. Where the change is the identity, `out` is `in` bit for bit.
  // Joints that are not part of the humanoid, or that the file does not rotate, keep their local
  // rotation and follow their parent. The middle between the upper legs turns in place and moves by
  // the translation, if the hips or a joint above them can. Allocates nothing, never fails.
  void write(ConstPose in, const BodyPose& body, const BodyChange& change, Pose out) noexcept;

  // Turns a whole pose by `turn` (radians, about +y through `about`), then moves it by `move`, both
  // world, Y up, metres: by its root joints, whatever they are. With neither it stays bit for bit.
  void place(float turn, Vec3 about, Vec3 move, Pose pose) const noexcept;

  // Calls visit(member) for what a rig remembers from one read() to the next.
  template <class Self, class Visit>
  static void visit_state(Self& self, Visit&& visit) {
    visit(self.last_);
  }

 private:
  Rig() = default;
  void write_rotations(ConstPose in, Pose out) noexcept;
  void write_translation(ConstPose in, const BodyChange& change, Pose out) noexcept;

  struct Shared {
    Skeleton skeleton;
    Mapping mapping;
    Calibration calibration;
    std::vector<std::string> notes;
    std::vector<int>
        human_of;          // Human joint of each skeleton joint that write() may rotate, or -1.
    int moved_joint = -1;  // The skeleton joint that carries the translation, or -1.
  };

  std::shared_ptr<const Shared> shared_;
  BodyPose last_;  // The last finite one.

  std::vector<Quat> world_rotations_;      // [joints], of the last read(), file axes.
  std::vector<Vec3> world_translations_;   // [joints], likewise, file units.
  std::array<Quat, kHumanJoints> deltas_;  // What write() puts on each human joint, file axes.
  std::vector<Quat> effective_;            // [joints]: the delta that each joint has or inherits.
};

}  // namespace panache
