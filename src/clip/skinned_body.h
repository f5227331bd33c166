#pragma once
// A skinned mesh that shows the motion of a new GLB file.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/quat.h"

namespace panache {

struct SkinnedBody {
  // The position of a point of the mesh relative to a joint of the clip: scale * rotate(rotation,
  // point) + translation, in the joint's axes and the clip's units.
  struct Bind {
    size_t joint;
    float scale;
    Quat rotation;
    Vec3 translation;
  };
  std::vector<Bind> binds;  // At most 256, each of another joint.

  std::vector<Vec3> positions;                  // [vertices] metres
  std::vector<Vec3> normals;                    // [vertices] unit
  std::vector<std::array<uint8_t, 4>> joints;   // [vertices] indices in `binds`
  std::vector<std::array<uint8_t, 4>> weights;  // [vertices] sum to 255
  std::vector<std::array<uint8_t, 4>> colours;  // [vertices] red, green, blue, alpha; linear
  std::vector<uint16_t> triangles;              // Three vertices each, counterclockwise.
};

}  // namespace panache
