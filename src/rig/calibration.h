#pragma once
// Properties of a rig that follow from a clip, not from its skeleton: up axis, unit, floor height,
// direction of the toes and first usable frame.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "clip/clip.h"
#include "rig/canonical_body.h"
#include "rig/mapping.h"

namespace panache {

// The source of the direction of one foot.
struct ToeSource {
  bool from_joint = false;  // From foot to toe joint; otherwise `local` is used.
  Vec3 local;               // A unit direction in the foot's own axes.
};

struct Calibration {
  int first_frame = 0;  // 1 if frame 0 is a calibration pose or not part of the motion.
  std::string up_axis;  // In the file: "+Y", "-Z", ...
  Quat y_up;            // Rotation from the file's axes to Y up.
  float scale = 1;      // Metres per file unit, for canonical legs.
  float floor = 0;      // Height of the floor, Y up, in scaled metres.
  float facing = 0;     // Heading of the first usable frame with one, radians.
  BodyShape shape;
  std::array<ToeSource, 2> toes;  // [left, right]
  // [left, right]: position of the wrist in the lower arm's space, file units, if there is no hand.
  std::array<Vec3, 2> wrists;
  // [left, right]: unit direction of the fingers in the hand's space; zero if there is no hand or
  // nothing below it.
  std::array<Vec3, 2> hands;
  std::vector<std::string> notes;
};

// Fails if the given unit or axis is invalid.
Result<void> check_units(std::optional<float> metres_per_unit,
                         const std::optional<std::string>& up_axis);

// Reads at most 2,000 frames of the clip. Infers unit and up axis unless they are given. Fails if
// the legs have no length, or if check_units() fails.
Result<Calibration> calibrate(const Clip& clip, const Mapping& mapping,
                              std::optional<float> metres_per_unit = {},
                              const std::optional<std::string>& up_axis = {});

// The mapped joints at one instant, Y up, in scaled metres above the floor.
struct MappedJoints {
  // A missing hand is at the wrist, missing toes are at the canonical distance from the foot; any
  // other missing joint has the position of its nearest mapped ancestor.
  HumanPositions positions;
  std::array<Vec3, 2> toes;  // Unit directions from foot to toes, [left, right].
};
// world[joints]: the skeleton's joints in the file's axes and units.
MappedJoints mapped_joints(ConstPose world, const std::array<int, kHumanJoints>& joint_of,
                           const Calibration& calibration) noexcept;

// 0, or 1 if frame 0 is a calibration pose, with a note added to `notes`.
int find_first_frame(const Clip& clip, std::vector<std::string>& notes);

}  // namespace panache
