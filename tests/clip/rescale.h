#pragma once
// The same character with other scales in its nodes, and where its nodes are by the matrices of
// glTF's specification.

#include <array>
#include <cstring>
#include <string>
#include <vector>

#include "make_gltf.h"

namespace panache::test {

inline size_t node_called(const GltfParts& parts, const std::string& name) {
  const Json& nodes = parts.json["nodes"];
  for (size_t n = 0; n < nodes.size(); ++n) {
    if (nodes[n]["name"] == name) return n;
  }
  return nodes.size();
}

inline std::vector<size_t> nodes_below(const GltfParts& parts, size_t node) {
  std::vector<size_t> below;
  for (const Json& child : parts.json["nodes"][node].value("children", Json::array())) {
    below.push_back(child.get<size_t>());
    const std::vector<size_t> more = nodes_below(parts, below.back());
    below.insert(below.end(), more.begin(), more.end());
  }
  return below;
}

// How a rotation by numbers (x y z w) looks in a mirror with these signs.
inline void mirror(const std::array<double, 3>& s, float* q) {
  const double all = s[0] * s[1] * s[2];
  for (size_t k = 0; k < 3; ++k) q[k] *= static_cast<float>(all * s[k]);
}

// Calls edit(numbers, elements) for the keys of every channel of `path` of the node; LINEAR floats.
template <class Edit>
void edit_keys(GltfParts& parts, size_t node, const std::string& path, const Edit& edit) {
  for (const Json& animation : parts.json["animations"]) {
    for (const Json& channel : animation["channels"]) {
      if (channel["target"]["node"] != node || channel["target"]["path"] != path) continue;
      const Json& sampler = animation["samplers"][channel["sampler"].get<size_t>()];
      const Json& accessor = parts.json["accessors"][sampler["output"].get<size_t>()];
      const Json& view = parts.json["bufferViews"][accessor["bufferView"].get<size_t>()];
      if (accessor["componentType"] != 5126) continue;
      const size_t count = accessor["count"], components = path == "rotation" ? 4 : 3;
      std::vector<float> numbers(count * components);
      char* const at = parts.bin.data() + view["byteOffset"].get<size_t>() +
                       accessor.value("byteOffset", size_t{0});
      std::memcpy(numbers.data(), at, numbers.size() * sizeof(float));
      for (size_t i = 0; i < count; ++i) edit(numbers.data() + i * components, i);
      std::memcpy(at, numbers.data(), numbers.size() * sizeof(float));
    }
  }
}

// Gives the node a scale of `size` and `signs`, and undoes in all below it what that does to their
// places: no node of the file moves. Meshes without a skin grow or are mirrored.
inline void rescale(GltfParts& parts, const std::string& name, const std::array<double, 3>& signs,
                    double size = 1) {
  const size_t node = node_called(parts, name);
  Json& scaled = parts.json["nodes"][node];
  const std::array<double, 3> old = scaled.value("scale", std::array<double, 3>{1, 1, 1});
  scaled["scale"] = {signs[0] * size * old[0], signs[1] * size * old[1], signs[2] * size * old[2]};
  for (const size_t below : nodes_below(parts, node)) {
    Json& json = parts.json["nodes"][below];
    std::array<float, 3> t = json.value("translation", std::array<float, 3>{});
    std::array<float, 4> q = json.value("rotation", std::array<float, 4>{0, 0, 0, 1});
    const auto move = [&](float* position, size_t) {
      for (size_t k = 0; k < 3; ++k)
        position[k] = static_cast<float>(position[k] * signs[k] / size);
    };
    move(t.data(), 0);
    mirror(signs, q.data());
    json["translation"] = t;
    json["rotation"] = q;
    edit_keys(parts, below, "translation", move);
    edit_keys(parts, below, "rotation", [&](float* keys, size_t) { mirror(signs, keys); });
  }
}

// Puts a node between a joint and all below it: the joint gets the scale, the new node its inverse.
inline void scale_and_undo(GltfParts& parts, const std::string& name,
                           const std::array<double, 3>& scale) {
  Json& nodes = parts.json["nodes"];
  const size_t node = node_called(parts, name);
  Json children = nodes[node].value("children", Json::array());
  nodes[node]["scale"] = scale;
  nodes[node]["children"] = Json::array({nodes.size()});
  nodes.push_back({{"name", name + " undone"},
                   {"scale", {1 / scale[0], 1 / scale[1], 1 / scale[2]}},
                   {"children", std::move(children)}});
}

// A transform as a matrix of three rows of four numbers.
using Affine = std::array<std::array<double, 4>, 3>;
inline Affine operator*(const Affine& a, const Affine& b) {
  Affine out{};
  for (size_t r = 0; r < 3; ++r) {
    for (size_t c = 0; c < 4; ++c) {
      for (size_t k = 0; k < 3; ++k) out[r][c] += a[r][k] * b[k][c];
      if (c == 3) out[r][c] += a[r][3];
    }
  }
  return out;
}

// Where the nodes are at key `frame` of an animation whose keys are its frames: translation times
// rotation times scale, or the matrix, along the tree.
class MatrixPositions {
 public:
  MatrixPositions(const GltfParts& parts, size_t animation) : parts_(parts) {
    const Json& json = parts.json["animations"][animation];
    for (const Json& channel : json["channels"]) {
      const Json& sampler = json["samplers"][channel["sampler"].get<size_t>()];
      if (channel["target"]["path"] == "weights") continue;
      keys_.push_back({channel["target"]["node"], channel["target"]["path"],
                       accessor_floats(parts, sampler["output"].get<size_t>())});
    }
    for (size_t n = 0; n < parts.json["nodes"].size(); ++n) {
      for (const Json& child : parts.json["nodes"][n].value("children", Json::array())) {
        parent_.resize(parts.json["nodes"].size(), -1);
        parent_[child.get<size_t>()] = static_cast<int>(n);
      }
    }
  }

  Vec3d position(size_t node, size_t frame) const {
    Affine at = local(node, frame);
    for (int up = parent_[node]; up >= 0; up = parent_[static_cast<size_t>(up)]) {
      at = local(static_cast<size_t>(up), frame) * at;
    }
    return {at[0][3], at[1][3], at[2][3]};
  }

 private:
  struct Keys {
    size_t node;
    std::string path;
    std::vector<float> numbers;
  };

  template <size_t N>
  std::array<double, N> value(size_t node, const std::string& path, size_t frame,
                              std::array<double, N> otherwise) const {
    std::array<double, N> out = parts_.json["nodes"][node].value(path, otherwise);
    for (const Keys& keys : keys_) {
      if (keys.node != node || keys.path != path) continue;
      const size_t key = std::min(frame, keys.numbers.size() / N - 1);
      for (size_t k = 0; k < N; ++k) out[k] = static_cast<double>(keys.numbers[key * N + k]);
    }
    return out;
  }

  Affine local(size_t node, size_t frame) const {
    Affine out{};
    if (parts_.json["nodes"][node].contains("matrix")) {
      const std::array<double, 16> m = parts_.json["nodes"][node]["matrix"];
      for (size_t r = 0; r < 3; ++r) {
        for (size_t c = 0; c < 4; ++c) out[r][c] = m[4 * c + r];
      }
      return out;
    }
    const auto t = value<3>(node, "translation", frame, {0, 0, 0});
    const auto q = value<4>(node, "rotation", frame, {0, 0, 0, 1});
    const auto s = value<3>(node, "scale", frame, {1, 1, 1});
    for (size_t c = 0; c < 3; ++c) {
      const Vec3d axis = {c == 0 ? s[c] : 0, c == 1 ? s[c] : 0, c == 2 ? s[c] : 0};
      const Vec3d turned = rotate(normalized(Quatd{q[0], q[1], q[2], q[3]}), axis);
      out[0][c] = turned.x, out[1][c] = turned.y, out[2][c] = turned.z;
    }
    for (size_t r = 0; r < 3; ++r) out[r][3] = t[r];
    return out;
  }

  const GltfParts& parts_;
  std::vector<Keys> keys_;
  std::vector<int> parent_;
};

}  // namespace panache::test
