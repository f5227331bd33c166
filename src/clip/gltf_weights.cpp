#include <algorithm>
#include <string>

#include "clip/gltf_document.h"

namespace panache {
namespace {

// Sums the weights of the vertices of skinned meshes for each joint. Data that cannot be read, such
// as a compressed mesh, or is too large, is ignored: motion does not depend on it. Members are
// looked up without a GltfPart, which would build a path for each of a million primitives.
class WeightReader {
 public:
  WeightReader(const GltfContainer& container, GltfDocument& document)
      : container_(container),
        document_(document),
        json_(container.json),
        left_(gltf_max_values(container.size)) {}

  void read() {
    for (const GltfJson& node : list(json_, "nodes")) {
      const int skin = index(node, "skin", "skins"), mesh = index(node, "mesh", "meshes");
      if (skin < 0 || mesh < 0) continue;
      const GltfJson& joints = list(list(json_, "skins")[static_cast<size_t>(skin)], "joints");
      const GltfJson& primitives =
          list(list(json_, "meshes")[static_cast<size_t>(mesh)], "primitives");
      for (const GltfJson& primitive : primitives) {
        if (left_ == 0) return;
        for (int set = 0; set < kMaxSets && add_set(primitive, set, skin, joints); ++set) {
        }
      }
    }
  }

 private:
  static constexpr int kMaxSets = 16;

  static const GltfJson& list(const GltfJson& object, const char* key) {
    static const GltfJson kNone = GltfJson::array();
    if (!object.is_object()) return kNone;
    const auto member = object.find(key);
    return member == object.end() || !member->is_array() ? kNone : *member;
  }
  // The member `key` of an object as an index in the file's list `of`; -1 if it is not one.
  int index(const GltfJson& object, const char* key, const char* of) const {
    if (!object.is_object()) return -1;
    const auto member = object.find(key);
    if (member == object.end() || !member->is_number_unsigned()) return -1;
    const auto place = member->get<uint64_t>();
    return place < list(json_, of).size() ? static_cast<int>(place) : -1;
  }

  // Adds one set of four joints per vertex; returns whether there was one.
  bool add_set(const GltfJson& primitive, int set, int skin, const GltfJson& joints) {
    if (left_ == 0) return false;
    --left_;
    if (!primitive.is_object()) return false;
    const auto attributes = primitive.find("attributes");
    if (attributes == primitive.end()) return false;
    const std::string number = std::to_string(set);
    GltfValues which, weights;
    const bool found = values(*attributes, "JOINTS_" + number, which) &&
                       values(*attributes, "WEIGHTS_" + number, weights);
    left_ -= std::min(left_, which.numbers.size() + weights.numbers.size());
    if (!found) return false;
    for (size_t i = 0; i < std::min(which.numbers.size(), weights.numbers.size()); ++i) {
      const auto place = static_cast<size_t>(std::max(which.numbers[i], 0.0f));
      if (!(weights.numbers[i] > 0) || place >= joints.size()) continue;
      // The skins were checked before, so these are nodes.
      GltfNode& node = document_.nodes[joints[place].get<size_t>()];
      if (node.skin < 0) node.skin = skin;
      if (node.skin == skin) node.skin_weight += weights.numbers[i];
    }
    return true;
  }

  bool values(const GltfJson& attributes, const std::string& name, GltfValues& out) const {
    const int accessor = index(attributes, name.c_str(), "accessors");
    GltfChecker unheard("");
    return accessor >= 0 && read_gltf_accessor(container_, accessor, "", unheard, out);
  }

  const GltfContainer& container_;
  GltfDocument& document_;
  const GltfJson& json_;
  // Numbers and sets that may still be read: nodes and primitives may share a large mesh.
  size_t left_;
};

}  // namespace

void read_gltf_weights(const GltfContainer& container, GltfDocument& document) {
  WeightReader(container, document).read();
}

}  // namespace panache
