#pragma once
// A person's body as one skinned mesh, made to the measure of a rig.

#include <array>
#include <cstdint>
#include <vector>

#include "rig/body_surface.h"

namespace panache {

inline constexpr size_t kSkinJoints = 4;  // That move a vertex, at most.

struct BodyMesh {
  BindPose bind;                                          // The pose that the vertices stand in.
  std::vector<Vec3> positions;                            // [vertices] metres
  std::vector<Vec3> normals;                              // [vertices] unit
  std::vector<std::array<uint8_t, kSkinJoints>> joints;   // [vertices] human joints
  std::vector<std::array<uint8_t, kSkinJoints>> weights;  // [vertices] add up to 255
  std::vector<uint8_t> accents;     // [vertices] 255 where the second colour is
  std::vector<uint16_t> triangles;  // Three vertices each, counterclockwise from outside.
};

// Coarse: a third of the triangles, for where no graphics card draws them.
enum class BodyDetail { fine, coarse };

// `offsets` as bind_pose() takes them; `movers`: the joint that moves the part of each joint.
BodyMesh make_body_mesh(const HumanPositions& offsets, const std::array<int, kHumanJoints>& movers,
                        BodyDetail detail = BodyDetail::fine);

}  // namespace panache
