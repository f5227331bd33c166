#pragma once
// A mesh of even triangles around a signed distance (naive surface nets: a vertex per cell of a
// grid that the surface passes, Gibson 1998).

#include <cstdint>
#include <functional>
#include <vector>

#include "base/vec.h"

namespace panache {

struct TriangleMesh {
  std::vector<Vec3> vertices;
  std::vector<uint16_t> triangles;  // Three vertices each, counterclockwise from outside.
};

// The surface where `distance` is 0, between the corners `low` and `high`, by cells of `cell`. The
// cells grow until there are at most 2^16 vertices and a bounded number of cells. `distance` may be
// too small but hardly too large.
TriangleMesh surface_net(const std::function<float(Vec3)>& distance, Vec3 low, Vec3 high,
                         float cell);

}  // namespace panache
