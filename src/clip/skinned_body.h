#pragma once
// A skinned mesh that a new GLB file shows its motion on.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/quat.h"

namespace panache {

struct SkinnedBody {
  // How a point of the mesh is seen from a joint of the clip: scale * rotate(rotation, point) +
  // translation, in the joint's own axes and the clip's units.
  struct Bind {
    size_t joint;
    float scale;
    Quat rotation;
    Vec3 translation;
  };
  std::vector<Bind> binds;  // At most 256, each of another joint.

  std::vector<Vec3> positions;                  // [vertices] metres
  std::vector<Vec3> normals;                    // [vertices] unit
  std::vector<std::array<uint8_t, 4>> joints;   // [vertices] places in `binds`
  std::vector<std::array<uint8_t, 4>> weights;  // [vertices] add up to 255
  std::vector<std::array<uint8_t, 4>> colours;  // [vertices] red, green, blue, alpha; linear
  std::vector<uint16_t> triangles;              // Three vertices each, counterclockwise.
};

}  // namespace panache
