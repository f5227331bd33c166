#include "rig/rig_body.h"

#include <utility>

#include "rig/mannequin.h"

namespace panache {
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
