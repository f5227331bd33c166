#pragma once
// The skin and the mesh that show the joints of a glTF file. Private to the folder.

#include <array>
#include <cstdint>
#include <initializer_list>
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
  int parent = -1;       // Place in the list, an earlier one.
  int clip_joint = -1;   // In the clips; -1 for an end, which no clip has.
  Affine local = {};     // The node's own matrix at rest.
  Affine world = {};     // With those of the nodes above it; metres.
  Affine stretch = {};   // From the node's own axes and units to those of the joint in the clips.
  bool wanders = false;  // It leaves its place, so that a stick to it stays behind.
};

// Adds a skin with all `joints`, a mesh on it, and a node in the scene that shows the mesh, to
// `json`; their data goes to the end of `bytes`, which begin at `place` of the file.
class GltfFigure {
 public:
  // `name`: what the node is called, before the kind of figure. All outlive this object.
  GltfFigure(GltfPlace place, GltfJson& json, std::string& bytes,
             std::span<const FigureJoint> joints, const std::string& name)
      : place_(place), json_(json), bytes_(bytes), joints_(joints), name_(name) {}

  // `body`: with binds on joints of the list. The other joints keep their place on their parents.
  void add_body(const SkinnedBody& body);
  // An octahedron from every joint to each of its children, where they rest.
  void add_sticks();

 private:
  GltfDataWriter writer() { return {place_, json_, bytes_}; }
  // A skin with `order` of the joints and their inverse bind matrices; its index.
  size_t add_skin(std::span<const size_t> order, std::span<const Affine> inverse_binds);
  void add_mesh(const std::string& what, std::initializer_list<double> colour, size_t skin,
                GltfJson primitive);
  void add_stick(size_t joint, Vec3d tip);
  void add_triangle(size_t joint, Vec3d a, Vec3d b, Vec3d c);
  size_t add_positions(const std::vector<float>& positions);
  size_t add_bytes(std::span<const std::array<uint8_t, 4>> vertices, bool normalized);
  size_t add_triangles(std::span<const uint16_t> corners);
  size_t add_vertex_data(const std::vector<float>& numbers, const char* type, size_t components);
  size_t add_joint_numbers();
  size_t add_accessor(size_t begin, int component, size_t count, const char* type, int target);

  GltfPlace place_;
  GltfJson& json_;
  std::string& bytes_;
  std::span<const FigureJoint> joints_;
  const std::string& name_;
  std::vector<float> positions_, normals_, weights_;  // [corners of triangles][3, 3, 4]
  std::vector<size_t> joint_numbers_;                 // [corners of triangles]
};

// The 16 numbers of a matrix at the end of `numbers`, columns one after the other.
void append_matrix(std::vector<float>& numbers, const Affine& matrix);

// Whether a stick to the joint would stay behind in `clip`: it moves further from its offset than
// half of that.
bool wanders(const Clip& clip, size_t joint);

// Whether the file has no skin, and no mesh hangs on what moves in it: programs show nothing of it
// and build no armature.
bool lacks_figure(const GltfDocument& document);
// Such a file with a skin over its whole skeleton, fingers, face and ends included, and a figure:
// `body`, whose binds are on joints of the document's clips, or sticks where that is null.
std::string with_figure(const GltfDocument& document, const SkinnedBody* body);
// A file with one skin, and in that also the joints of the skeleton that no vertex follows.
std::string with_whole_skin(const GltfDocument& document);

}  // namespace panache
