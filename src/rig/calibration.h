#pragma once
// Properties of a rig that follow from a clip, not from its skeleton: which way is up, how long a
// metre is, where the floor is, where the toes point and from which frame on the motion can be
// used.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "clip/clip.h"
#include "rig/canonical_body.h"
#include "rig/mapping.h"

namespace panache {

// How the direction of one foot is known.
struct ToeSource {
  bool from_joint = false;  // From the foot to the toe joint; otherwise `local`.
  Vec3 local;               // A unit direction in the foot's own axes.
};

struct Calibration {
  int first_frame = 0;  // 1 where frame 0 is a calibration pose or does not belong to the motion.
  std::string up_axis;  // In the file: "+Y", "-Z", ...
  Quat y_up;            // Turns the file's axes Y up.
  float scale = 1;      // Metres per file unit, for canonical legs.
  float floor = 0;      // Height of the floor, Y up, in scaled metres.
  float facing = 0;     // Heading of the first usable frame that has one, radians.
  BodyShape shape;
  std::array<ToeSource, 2> toes;  // [left, right]
  // [left, right]: where the wrist is in the lower arm's own axes, file units, where there is no
  // hand.
  std::array<Vec3, 2> wrists;
  // [left, right]: unit direction of the fingers in the hand's own axes; zero where there is no
  // hand or nothing below it.
  std::array<Vec3, 2> hands;
  std::vector<std::string> notes;
};

// Fails if the given unit or axis is invalid.
Result<void> check_units(std::optional<float> metres_per_unit,
                         const std::optional<std::string>& up_axis);

// Looks at 2,000 frames of the clip at most. Unit and up axis are found unless they are given.
// Fails where the legs have no length, and where check_units does.
Result<Calibration> calibrate(const Clip& clip, const Mapping& mapping,
                              std::optional<float> metres_per_unit = {},
                              const std::optional<std::string>& up_axis = {});

// One instant of the mapped joints, Y up, in scaled metres above the floor.
struct MappedJoints {
  // A missing hand stands at the wrist and missing toes at the canonical length from the foot; any
  // other missing joint carries its nearest mapped ancestor's position.
  HumanPositions positions;
  std::array<Vec3, 2> toes;  // Unit directions from foot to toes, [left, right].
};
// world[joints]: the skeleton's joints in the file's axes and units.
MappedJoints mapped_joints(ConstPose world, const std::array<int, kHumanJoints>& joint_of,
                           const Calibration& calibration) noexcept;

}  // namespace panache
