#pragma once
// A human body as one skinned mesh, in the proportions of a rig, and skinned to the joints of
// its skeleton for files.

#include <array>
#include <cstdint>
#include <vector>

#include "clip/motion_file.h"
#include "rig/body_surface.h"
#include "rig/rig.h"

namespace panache {

inline constexpr size_t kSkinJoints = 4;  // Per vertex, at most.

struct BodyMesh {
  BindPose bind;                                          // The pose of the vertices.
  std::vector<Vec3> positions;                            // [vertices] metres
  std::vector<Vec3> normals;                              // [vertices] unit
  std::vector<std::array<uint8_t, kSkinJoints>> joints;   // [vertices] human joints
  std::vector<std::array<uint8_t, kSkinJoints>> weights;  // [vertices] add up to 255
  std::vector<uint8_t> accents;                           // [vertices] 255 in the second colour
  std::vector<uint16_t> triangles;  // Three vertices each, counterclockwise from outside.
};

// Coarse: a third of the triangles, for drawing without a graphics card.
enum class BodyDetail { fine, coarse };

// `offsets`: see bind_pose(); `movers`: for each joint, the joint that moves its part of the body.
BodyMesh make_body_mesh(const HumanPositions& offsets, const std::array<int, kHumanJoints>& movers,
                        BodyDetail detail = BodyDetail::fine);

// The joint that moves each human joint's part of the body: itself, or the nearest ancestor that
// the rig has.
std::array<int, kHumanJoints> moving_joints(const Rig& rig);

// A body in the proportions of `rig`, scaled by Rig::unit(). `reference`: a pose without twists.
SkinnedBody make_rig_body(const Rig& rig, ConstPose reference);

}  // namespace panache
