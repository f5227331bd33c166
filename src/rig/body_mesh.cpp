#include "rig/body_mesh.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "rig/surface_net.h"

namespace panache {
namespace {

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

}  // namespace panache
