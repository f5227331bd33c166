#include "rig/body_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "base/vec.h"
#include "rig/posed_rig.h"

namespace panache {
namespace {

struct TriangleMesh {
  std::vector<Vec3> vertices;
  std::vector<uint16_t> triangles;  // Three vertices each, counterclockwise from outside.
};

constexpr int kBlock = 4;  // Cells along a side of a block.
constexpr float kMaxCells = 2e6f;
constexpr int kNone = -1;

class SurfaceNet {
 public:
  SurfaceNet(const std::function<float(Vec3)>& distance, Vec3 low, Vec3 high, float cell)
      : distance_(distance), low_(low), cell_(cell) {
    const Vec3 size = (high - low) / cell;
    for (const auto& [count, length] :
         {std::pair<int*, float>{&nx_, size.x}, {&ny_, size.y}, {&nz_, size.z}}) {
      *count = static_cast<int>(std::ceil(length / kBlock)) * kBlock + 1;
    }
    values_.resize(size_t(nx_) * ny_ * nz_);
    vertex_of_.assign(values_.size(), kNone);
    sample();
  }

  // False if there are more vertices than indices can address.
  bool build(TriangleMesh& out) {
    place_vertices(out);
    if (out.vertices.size() > 0xffff) return false;
    connect(out);
    return true;
  }

 private:
  size_t at(int x, int y, int z) const { return (size_t(z) * ny_ + y) * nx_ + x; }
  Vec3 grid_point(float x, float y, float z) const { return low_ + Vec3{x, y, z} * cell_; }

  // If the middle of a block is further from the surface than its corners, one value suffices.
  void sample() {
    constexpr float kHalf = 0.5f * kBlock;
    const float reach = kHalf * 1.7320508f * cell_ * 1.3f;
    for (int z = 0; z < nz_; z += kBlock) {
      for (int y = 0; y < ny_; y += kBlock) {
        for (int x = 0; x < nx_; x += kBlock) {
          const float middle = distance_(grid_point(x + kHalf, y + kHalf, z + kHalf));
          fill(x, y, z, middle, std::abs(middle) > reach);
        }
      }
    }
  }

  void fill(int x0, int y0, int z0, float middle, bool far) {
    for (int z = z0; z < std::min(z0 + kBlock, nz_); ++z) {
      for (int y = y0; y < std::min(y0 + kBlock, ny_); ++y) {
        for (int x = x0; x < std::min(x0 + kBlock, nx_); ++x) {
          values_[at(x, y, z)] = far ? middle : distance_(grid_point(x, y, z));
        }
      }
    }
  }

  void place_vertices(TriangleMesh& out) {
    for (int z = 0; z + 1 < nz_; ++z) {
      for (int y = 0; y + 1 < ny_; ++y) {
        for (int x = 0; x + 1 < nx_; ++x) place_vertex(x, y, z, out);
      }
    }
  }

  // The mean of the surface's intersections with the edges of the cell.
  void place_vertex(int x, int y, int z, TriangleMesh& out) {
    std::array<float, 8> corner;
    int inside = 0;
    for (int c = 0; c < 8; ++c) {
      corner[c] = values_[at(x + (c & 1), y + (c >> 1 & 1), z + (c >> 2))];
      inside += corner[c] < 0;
    }
    if (inside == 0 || inside == 8) return;
    Vec3 sum;
    int cuts = 0;
    for (int a = 0; a < 8; ++a) {
      for (const int bit : {1, 2, 4}) {
        if (a & bit) continue;
        const float from = corner[a], to = corner[a | bit];
        if ((from < 0) == (to < 0)) continue;
        const float t = from / (from - to);
        sum += Vec3{static_cast<float>(a & 1) + (bit == 1 ? t : 0),
                    static_cast<float>(a >> 1 & 1) + (bit == 2 ? t : 0),
                    static_cast<float>(a >> 2) + (bit == 4 ? t : 0)};
        ++cuts;
      }
    }
    vertex_of_[at(x, y, z)] = static_cast<int>(out.vertices.size());
    const Vec3 mean = sum / static_cast<float>(cuts);
    out.vertices.push_back(grid_point(x + mean.x, y + mean.y, z + mean.z));
  }

  // A quad around every edge that the surface cuts.
  void connect(TriangleMesh& out) {
    for (int z = 1; z + 1 < nz_; ++z) {
      for (int y = 1; y + 1 < ny_; ++y) {
        for (int x = 1; x + 1 < nx_; ++x) {
          const bool in = values_[at(x, y, z)] < 0;
          const auto quad = [&](size_t next, std::array<size_t, 4> cells) {
            if ((values_[next] < 0) != in) add_quad(cells, in, out);
          };
          quad(at(x + 1, y, z),
               {at(x, y - 1, z - 1), at(x, y, z - 1), at(x, y, z), at(x, y - 1, z)});
          quad(at(x, y + 1, z),
               {at(x - 1, y, z - 1), at(x - 1, y, z), at(x, y, z), at(x, y, z - 1)});
          quad(at(x, y, z + 1),
               {at(x - 1, y - 1, z), at(x, y - 1, z), at(x, y, z), at(x - 1, y, z)});
        }
      }
    }
  }

  void add_quad(const std::array<size_t, 4>& cells, bool outward, TriangleMesh& out) const {
    std::array<uint16_t, 4> v;
    for (size_t i = 0; i < 4; ++i) v[i] = static_cast<uint16_t>(vertex_of_[cells[i]]);
    if (!outward) std::swap(v[1], v[3]);
    // Along the shorter diagonal.
    const auto far = [&](size_t a, size_t b) {
      return length(out.vertices[v[a]] - out.vertices[v[b]]);
    };
    if (far(0, 2) <= far(1, 3)) {
      out.triangles.insert(out.triangles.end(), {v[0], v[1], v[2], v[0], v[2], v[3]});
    } else {
      out.triangles.insert(out.triangles.end(), {v[0], v[1], v[3], v[1], v[2], v[3]});
    }
  }

  const std::function<float(Vec3)>& distance_;
  Vec3 low_;
  float cell_;
  int nx_ = 0, ny_ = 0, nz_ = 0;  // Grid points.
  std::vector<float> values_;     // [nz][ny][nx]
  std::vector<int> vertex_of_;    // Vertex of the cell above each grid point, or kNone.
};

// The surface where `distance` is 0 in the box from `low` to `high`, with cells of size `cell`.
// Cells grow until there are at most 2^16 vertices and a bounded number of cells. `distance` may
// underestimate, but hardly overestimate.
TriangleMesh surface_net(const std::function<float(Vec3)>& distance, Vec3 low, Vec3 high,
                         float cell) {
  const Vec3 size = high - low;
  const float cells = size.x * size.y * size.z / (cell * cell * cell);
  if (cells > kMaxCells) cell *= std::cbrt(cells / kMaxCells);
  TriangleMesh out;
  while (!SurfaceNet(distance, low, high, cell).build(out)) {
    out = {};
    cell *= 1.5f;
  }
  return out;
}

constexpr float kCell = 0.0165f;  // Metres: resolves fingers, with about 7000 vertices.
constexpr float kCoarseCell = 0.028f;
constexpr float kSharpness = 0.014f;  // Metres over which a joint's weight falls to 1/e.
constexpr int kWeightSteps = 5;       // Smoothing steps; each reaches one cell further.
constexpr int kCoarseWeightSteps = 3;

using Shares = std::array<float, kHumanJoints>;

// Weights of the joints by the distance of their parts.
Shares shares_at(const BodySurface& surface, Vec3 point,
                 const std::array<int, kHumanJoints>& movers) {
  Shares distances;
  surface.joint_distances(point, distances);
  const float nearest = *std::min_element(distances.begin(), distances.end());
  Shares out{};
  float sum = 0;
  for (size_t j = 0; j < kHumanJoints; ++j) {
    const float share = std::exp((nearest - distances[j]) / kSharpness);
    out[movers[j]] += share;
    sum += share;
  }
  for (float& share : out) share /= sum;
  return out;
}

// Smooths weights along the surface, not through the air, so that parts across a gap stay separate.
void smooth(const TriangleMesh& mesh, int steps, std::vector<Shares>& shares) {
  std::vector<Shares> sums(shares.size());
  std::vector<float> counts(shares.size());
  for (int step = 0; step < steps; ++step) {
    sums = shares;
    std::fill(counts.begin(), counts.end(), 1.0f);
    for (size_t t = 0; t < mesh.triangles.size(); t += 3) {
      for (size_t k = 0; k < 3; ++k) {
        const size_t a = mesh.triangles[t + k], b = mesh.triangles[t + (k + 1) % 3];
        for (size_t j = 0; j < kHumanJoints; ++j) sums[a][j] += shares[b][j];
        ++counts[a];
      }
    }
    for (size_t v = 0; v < shares.size(); ++v) {
      for (size_t j = 0; j < kHumanJoints; ++j) shares[v][j] = sums[v][j] / counts[v];
    }
  }
}

// Adds the largest weights as bytes that add up to 255.
void add_weights(const Shares& shares, BodyMesh& out) {
  std::array<int, kHumanJoints> order;
  for (int j = 0; j < kHumanJoints; ++j) order[j] = j;
  const auto share = [&](int j) { return shares[j]; };
  std::partial_sort(order.begin(), order.begin() + kSkinJoints, order.end(),
                    [&](int a, int b) { return share(a) > share(b); });
  float sum = 0;
  for (size_t i = 0; i < kSkinJoints; ++i) sum += share(order[i]);
  std::array<uint8_t, kSkinJoints> joints{}, weights{};
  int rest = 255;
  for (size_t i = kSkinJoints; i-- > 1;) {
    const int weight = static_cast<int>(std::lround(255 * share(order[i]) / sum));
    // glTF requires index 0 for joints with zero weight.
    joints[i] = static_cast<uint8_t>(weight > 0 ? order[i] : 0);
    weights[i] = static_cast<uint8_t>(weight);
    rest -= weight;
  }
  joints[0] = static_cast<uint8_t>(order[0]);
  weights[0] = static_cast<uint8_t>(rest);
  out.joints.push_back(joints);
  out.weights.push_back(weights);
}

}  // namespace

BodyMesh make_body_mesh(const HumanPositions& offsets, const std::array<int, kHumanJoints>& movers,
                        BodyDetail detail) {
  const bool fine = detail == BodyDetail::fine;
  const BodySurface surface(offsets);
  TriangleMesh mesh = surface_net([&](Vec3 p) { return surface.distance(p); }, surface.low(),
                                  surface.high(), fine ? kCell : kCoarseCell);
  BodyMesh out;
  out.bind = surface.bind();
  std::vector<Shares> shares;
  for (Vec3& vertex : mesh.vertices) {
    // Surface nets only approximate the surface.
    surface.approach(vertex);
    out.normals.push_back(surface.approach(vertex));
    out.accents.push_back(static_cast<uint8_t>(std::lround(255 * surface.accent(vertex))));
    shares.push_back(shares_at(surface, vertex, movers));
  }
  smooth(mesh, fine ? kWeightSteps : kCoarseWeightSteps, shares);
  for (const Shares& share : shares) add_weights(share, out);
  out.positions = std::move(mesh.vertices);
  out.triangles = std::move(mesh.triangles);
  return out;
}

namespace {

// Linear light: a warm white, and an orange.
constexpr std::array<float, 3> kBody = {219, 201, 172}, kAccent = {176, 31, 6};

std::array<uint8_t, 4> colour_of(uint8_t accent) {
  std::array<uint8_t, 4> out;
  for (size_t c = 0; c < 3; ++c) {
    const float share = static_cast<float>(accent) / 255;
    out[c] = static_cast<uint8_t>(kBody[c] + (kAccent[c] - kBody[c]) * share);
  }
  out[3] = 255;
  return out;
}

}  // namespace

std::array<int, kHumanJoints> moving_joints(const Rig& rig) {
  std::array<int, kHumanJoints> out;
  for (int j = 0; j < kHumanJoints; ++j) {
    const int parent = kHumanParent[j];
    out[j] = parent < 0 || rig.joints()[j] >= 0 ? j : out[parent];
  }
  return out;
}

SkinnedBody make_rig_body(const Rig& rig, ConstPose reference) {
  const Mannequin mannequin(rig, reference);
  BodyMesh mesh = make_body_mesh(mannequin.offsets(), moving_joints(rig));
  SkinnedBody out;
  // The mesh has the canonical body's legs.
  const float scale = rig.unit() / rig.scale();
  std::array<uint8_t, kHumanJoints> bind_of{};
  for (size_t j = 0; j < kHumanJoints; ++j) {
    if (rig.joints()[j] < 0) continue;
    bind_of[j] = static_cast<uint8_t>(out.binds.size());
    const Quat turn = mannequin.to_part()[j] * conjugate(mesh.bind.rotations[j]);
    const float units = 1 / rig.unit();
    out.binds.push_back({static_cast<size_t>(rig.joints()[j]), units, turn,
                         -rotate(turn, mesh.bind.positions[j] * (scale * units))});
  }
  for (Vec3& position : mesh.positions) position *= scale;
  for (auto& joints : mesh.joints) {
    for (uint8_t& joint : joints) joint = bind_of[joint];
  }
  for (const uint8_t accent : mesh.accents) out.colours.push_back(colour_of(accent));
  out.positions = std::move(mesh.positions);
  out.normals = std::move(mesh.normals);
  out.joints = std::move(mesh.joints);
  out.weights = std::move(mesh.weights);
  out.triangles = std::move(mesh.triangles);
  return out;
}

}  // namespace panache
