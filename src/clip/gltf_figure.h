#pragma once
// The skin and the mesh that show the joints of a glTF file. Private to the folder.

#include <span>
#include <string>
#include <vector>

#include "clip/affine.h"
#include "clip/gltf_document.h"
#include "clip/gltf_encode.h"
#include "clip/skinned_body.h"

namespace panache {

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
// `json`; their data is appended to `bytes`, which begin at `added_at` in the file. The mesh is
// `body`, whose binds are on joints of the list; the other joints keep their positions on their
// parents. If it is null, the mesh is an octahedron from every joint to each of its children at
// rest. `name`: the node's name, before the kind of figure.
void add_figure(GltfPosition added_at, GltfJson& json, std::string& bytes,
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
