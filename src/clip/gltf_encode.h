#pragma once
// MotionFile::encode for a glTF file, and the pieces of JSON that describe new data. Private to the
// folder.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "clip/affine.h"
#include "clip/gltf_document.h"
#include "clip/motion_file.h"

namespace panache {

std::string encode_gltf(const GltfDocument& document, std::span<const ClipEdit> edits,
                        EditMode mode);

// Appends new numbers to a file's binary data, and their accessors to its JSON. All numbers of one
// writer share a buffer view.
class GltfDataWriter {
 public:
  // Appends to `bytes`, which begin at `added_at` in the file; both outlive the writer.
  GltfDataWriter(GltfPosition added_at, GltfJson& json, std::string& bytes)
      : added_at_(added_at), json_(json), bytes_(bytes) {}

  // Adds an accessor of floats of `type` ("SCALAR", "VEC3", ...), with min and max if `bounds`;
  // returns its index in the file.
  size_t add(std::span<const float> numbers, std::string_view type, size_t components,
             bool bounds = false);
  // Adds the accessor of the times of frames, seconds.
  size_t add_times(double start, double frame_time, int frames);

 private:
  GltfPosition added_at_;
  GltfJson& json_;
  std::string& bytes_;
  int view_ = -1;     // Made with the first numbers.
  size_t first_ = 0;  // Where in `bytes` the view begins.
};

// The skin and the mesh that show the joints of a glTF file. Private to the folder.

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
