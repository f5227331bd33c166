#pragma once
// Meshes a signed distance with regular triangles (naive surface nets: one vertex per grid cell
// that the surface crosses, Gibson 1998).

#include <cstdint>
#include <functional>
#include <vector>

#include "base/vec.h"

namespace panache {

struct TriangleMesh {
  std::vector<Vec3> vertices;
  std::vector<uint16_t> triangles;  // Three vertices each, counterclockwise from outside.
};

// The surface where `distance` is 0 in the box from `low` to `high`, with cells of size `cell`.
// Cells grow until there are at most 2^16 vertices and a bounded number of cells. `distance` may
// underestimate, but hardly overestimate.
TriangleMesh surface_net(const std::function<float(Vec3)>& distance, Vec3 low, Vec3 high,
                         float cell);

}  // namespace panache
