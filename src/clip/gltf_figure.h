#pragma once
// The skin and the mesh that show the joints of a glTF file. Private to the folder.

#include <array>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "base/quat.h"
#include "base/vec.h"
#include "clip/gltf_document.h"
#include "clip/gltf_encode.h"
#include "clip/skinned_body.h"

namespace panache {

// An affine map: the matrix of a node, or an inverse bind matrix.
struct Affine {
  std::array<Vec3d, 3> columns = {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}};
  Vec3d place = {};  // Where the origin goes.

  Vec3d turn(Vec3d v) const { return columns[0] * v.x + columns[1] * v.y + columns[2] * v.z; }
  Vec3d apply(Vec3d v) const { return turn(v) + place; }
  friend Affine operator*(const Affine& a, const Affine& b) {  // b first.
    return {{a.turn(b.columns[0]), a.turn(b.columns[1]), a.turn(b.columns[2])}, a.apply(b.place)};
  }
};

// Rotates, then translates.
inline Affine affine(Quatd rotation, Vec3d place, Vec3d scale = {1, 1, 1}) {
  return {{rotate(rotation, Vec3d{scale.x, 0, 0}), rotate(rotation, Vec3d{0, scale.y, 0}),
           rotate(rotation, Vec3d{0, 0, scale.z})},
          place};
}

// Returns the identity if `m` has no inverse.
inline Affine inverse(const Affine& m) {
  const auto& [x, y, z] = m.columns;
  const double determinant = dot(cross(x, y), z);
  if (!(std::abs(determinant) > 1e-30)) return {};
  const Vec3d rows[3] = {cross(y, z) / determinant, cross(z, x) / determinant,
                         cross(x, y) / determinant};
  Affine out;
  out.columns = {Vec3d{rows[0].x, rows[1].x, rows[2].x}, Vec3d{rows[0].y, rows[1].y, rows[2].y},
                 Vec3d{rows[0].z, rows[1].z, rows[2].z}};
  out.place = -out.turn(m.place);
  return out;
}

// A node that becomes a joint of the skin.
struct FigureJoint {
  size_t node;           // In the file.
  int parent = -1;       // Index in the list, smaller than the joint's own.
  int clip_joint = -1;   // In the clips; -1 for an end, which clips do not have.
  Affine local = {};     // The node's own matrix at rest.
  Affine world = {};     // With the nodes above; metres.
  Affine stretch = {};   // From the node's axes and units to those of the joint in the clips.
  bool wanders = false;  // It leaves its position, so that a stick to it would not follow.
};

// Adds a skin with all `joints`, a mesh on it, and a node in the scene that shows the mesh, to
// `json`; their data is appended to `bytes`, which begin at `place` in the file. The mesh is
// `body`, whose binds are on joints of the list; the other joints keep their positions on their
// parents. If it is null, the mesh is an octahedron from every joint to each of its children at
// rest. `name`: the node's name, before the kind of figure.
void add_figure(GltfPlace place, GltfJson& json, std::string& bytes,
                std::span<const FigureJoint> joints, const std::string& name,
                const SkinnedBody* body);

// Appends the 16 numbers of a matrix to `numbers`, column-major.
void append_matrix(std::vector<float>& numbers, const Affine& matrix);

// Whether a stick to the joint would not follow it in `clip`: it moves away from its offset by more
// than half of that.
bool wanders(const Clip& clip, size_t joint);

// Whether the file has no skin, and no mesh is attached to what moves: programs show nothing of it
// and build no armature.
bool lacks_figure(const GltfDocument& document);
// Such a file with a skin over its whole skeleton, including fingers, face and ends, and a figure:
// `body`, whose binds are on joints of the document's clips, or sticks if it is null.
std::string with_figure(const GltfDocument& document, const SkinnedBody* body);
// A file with one skin, which gets the joints of the skeleton that no vertex follows, too.
std::string with_whole_skin(const GltfDocument& document);

}  // namespace panache
