#include <algorithm>
#include <string>

#include "clip/gltf_document.h"

namespace panache {
namespace {

// Sums what the vertices of skinned meshes weigh on each joint. What cannot be read, such as a
// compressed mesh, says nothing: motion does not depend on it. Nor does what is too much to read.
class WeightReader {
 public:
  WeightReader(const GltfContainer& container, GltfDocument& document)
      : container_(container),
        document_(document),
        root_(container.json, unheard_),
        left_(gltf_max_values(container.size)) {}

  void read() {
    for (const GltfPart& node : root_.list("nodes")) {
      const int skin = node.index("skin", root_.size("skins"));
      const int mesh = node.index("mesh", root_.size("meshes"));
      if (skin < 0 || mesh < 0) continue;
      const GltfPart part = root_.item("meshes", mesh);
      const size_t primitives = part.size("primitives");
      for (size_t p = 0; p < primitives && left_ > 0; ++p) {
        const GltfPart attributes = part.item("primitives", p).object("attributes");
        for (int set = 0; set < kMaxSets && add_set(attributes, set, skin); ++set) {
        }
      }
    }
  }

 private:
  static constexpr int kMaxSets = 16;

  // One set of four joints per vertex; whether there was one.
  bool add_set(const GltfPart& attributes, int set, int skin) {
    if (left_ == 0) return false;
    --left_;
    const std::string number = std::to_string(set);
    GltfValues which, weights;
    const bool found = values(attributes, "JOINTS_" + number, which) &&
                       values(attributes, "WEIGHTS_" + number, weights);
    left_ -= std::min(left_, which.numbers.size() + weights.numbers.size());
    // The skins were read before, so these are nodes.
    const GltfPart joints = root_.item("skins", skin);
    const size_t count = joints.size("joints");
    if (!found || count == 0) return false;
    const GltfJson& nodes = joints.json()["joints"];
    for (size_t i = 0; i < std::min(which.numbers.size(), weights.numbers.size()); ++i) {
      const auto place = static_cast<size_t>(std::max(which.numbers[i], 0.0f));
      if (!(weights.numbers[i] > 0) || place >= count) continue;
      GltfNode& node = document_.nodes[nodes[place].get<size_t>()];
      if (node.skin < 0) node.skin = skin;
      if (node.skin == skin) node.skin_weight += weights.numbers[i];
    }
    return true;
  }

  bool values(const GltfPart& attributes, const std::string& name, GltfValues& out) const {
    const int accessor = attributes.index(name, root_.size("accessors"));
    GltfChecker unheard("");
    return accessor >= 0 && read_gltf_accessor(container_, accessor, "", unheard, out);
  }

  const GltfContainer& container_;
  GltfDocument& document_;
  GltfChecker unheard_{""};
  GltfPart root_;
  // Numbers and sets that may still be read: nodes and primitives may share a large mesh.
  size_t left_;
};

}  // namespace

void read_gltf_weights(const GltfContainer& container, GltfDocument& document) {
  WeightReader(container, document).read();
}

}  // namespace panache
