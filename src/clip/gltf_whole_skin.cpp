#include <algorithm>
#include <map>

#include "clip/gltf_encode.h"

namespace panache {
namespace {

const GltfJson& node_json(const GltfDocument& document, size_t node) {
  return document.container.json["nodes"][node];
}

Affine local_matrix(const GltfDocument& document, size_t which) {
  const GltfNode& node = document.nodes[which];
  if (!node.matrix) {
    return affine(normalized(node.rotation.as<double>()), node.translation.as<double>(),
                  node.scale);
  }
  const GltfJson& m = node_json(document, which)["matrix"];
  const auto column = [&](size_t c) {
    return Vec3d{m[4 * c].get<double>(), m[4 * c + 1].get<double>(), m[4 * c + 2].get<double>()};
  };
  return {{column(0), column(1), column(2)}, column(3)};
}

Affine matrix_at(std::span<const float> m) {
  const auto column = [&](size_t c) {
    return Vec3{m[4 * c], m[4 * c + 1], m[4 * c + 2]}.as<double>();
  };
  return {{column(0), column(1), column(2)}, column(3)};
}

// The nodes that form a file's skeleton: those that an animation moves, those that a skin, a
// humanoid or a body needs, and all below them that carry nothing visible. A node that is only
// above them, such as a scene's root, becomes the armature, not a joint.
class SkeletonNodes {
 public:
  SkeletonNodes(const GltfDocument& document, const SkinnedBody* body)
      : document_(document), is_joint_(document.nodes.size()), root_(document.nodes.size()) {
    for (const GltfAnimation& animation : document.animations) {
      for (const GltfChannel& channel : animation.channels) {
        const bool moves = channel.path == GltfPath::rotation ||
                           channel.path == GltfPath::translation || channel.path == GltfPath::scale;
        if (channel.node >= 0 && moves) is_joint_[channel.node] = 1;
      }
    }
    for (size_t i = 0; i < document.nodes.size(); ++i) {
      if (document.nodes[i].skinned || !document.nodes[i].role.empty()) is_joint_[i] = 1;
    }
    if (body) {
      for (const SkinnedBody::Bind& bind : body->binds) {
        of_body_ = document.joint_nodes[bind.joint];
        is_joint_[of_body_] = 1;
      }
    }
    list_parents_first();
  }

  // Whether anything visible is attached to the skeleton.
  bool has_mesh() const {
    return std::ranges::any_of(nodes_, [&](size_t n) { return below_[n] && has(n, "mesh"); });
  }

  std::vector<FigureJoint> joints() const {
    std::vector<Affine> world(document_.nodes.size());
    std::vector<int> index(document_.nodes.size(), -1);
    const int tree = tree_of_skin();
    std::vector<FigureJoint> out;
    for (const size_t n : nodes_) {
      const GltfNode& node = document_.nodes[n];
      const Affine local = local_matrix(document_, n);
      world[n] = node.parent < 0 ? local : world[node.parent] * local;
      if (!is_part(n) || root_[n] != tree) continue;
      index[n] = static_cast<int>(out.size());
      FigureJoint joint{.node = n, .clip_joint = node.joint, .local = local, .world = world[n]};
      for (int up = node.parent; up >= 0 && joint.parent < 0;) {
        joint.parent = index[up];
        up = document_.nodes[up].parent;
      }
      out.push_back(joint);
    }
    add_clip_frames(out);
    return out;
  }

 private:
  bool has(size_t node, const char* what) const {
    return node_json(document_, node).contains(what);
  }
  bool is_part(size_t node) const {
    return below_[node] && !document_.nodes[node].carrier && !has(node, "mesh");
  }

  void list_parents_first() {
    below_ = is_joint_;
    for (size_t i = 0; i < document_.nodes.size(); ++i) {
      if (document_.nodes[i].parent < 0) nodes_.push_back(i);
    }
    for (size_t i = 0; i < nodes_.size(); ++i) {
      const size_t n = nodes_[i];
      const int parent = document_.nodes[n].parent;
      root_[n] = parent < 0 ? static_cast<int>(n) : root_[parent];
      if (parent >= 0 && below_[parent]) below_[n] = 1;
      for (const int child : document_.nodes[n].children) {
        nodes_.push_back(child);
      }
    }
  }

  // A skin covers one tree: that of the body, or the one with the most joints. Returns its root.
  int tree_of_skin() const {
    if (of_body_ >= 0) return root_[of_body_];
    std::map<int, size_t> sizes;
    for (const size_t n : nodes_) sizes[root_[n]] += is_part(n);
    return std::max_element(sizes.begin(), sizes.end(),
                            [](const auto& a, const auto& b) { return a.second < b.second; })
        ->first;
  }

  void add_clip_frames(std::vector<FigureJoint>& joints) const {
    const Skeleton& skeleton = document_.skeleton;
    std::vector<Quatd> turns(skeleton.joints.size());  // World, at rest.
    for (size_t j = 0; j < turns.size(); ++j) {
      const Joint& joint = skeleton.joints[j];
      const Quatd rest = joint.rest.as<double>();
      turns[j] = joint.parent < 0 ? rest : turns[joint.parent] * rest;
    }
    for (FigureJoint& joint : joints) {
      if (joint.clip_joint < 0) continue;
      const int j = joint.clip_joint;
      joint.stretch = affine(conjugate(normalized(turns[j])), {}) * joint.world;
      joint.stretch.origin = {};
      for (const GltfAnimation& animation : document_.animations) {
        joint.wanders = joint.wanders || wanders(animation.clip, j);
      }
    }
  }

  const GltfDocument& document_;
  std::vector<char> is_joint_, below_;  // [nodes] 1 for joints; 1 for nodes below one.
  std::vector<int> root_;               // [nodes] the node at the top of its tree.
  std::vector<size_t> nodes_;           // All nodes, parents before children.
  int of_body_ = -1;                    // A node that a body needs; -1 without a body.
};

// Adds missing lists, and a scene that shows all nodes if there is no scene.
void make_room(const GltfDocument& document, GltfJson& json) {
  for (const char* key : {"accessors", "bufferViews", "materials", "meshes", "skins", "scenes"}) {
    if (json.contains(key) && !json[key].is_array()) json.erase(key);
  }
  const auto scene = json.find("scene");
  const size_t shown =
      scene != json.end() && scene->is_number_unsigned() ? scene->get<size_t>() : 0;
  const bool has_scene = json.contains("scenes") && shown < json["scenes"].size() &&
                         json["scenes"][shown].is_object() &&
                         json["scenes"][shown].contains("nodes") &&
                         json["scenes"][shown]["nodes"].is_array();
  if (has_scene) {
    json["scene"] = shown;
    return;
  }
  GltfJson roots = GltfJson::array();
  for (size_t i = 0; i < document.nodes.size(); ++i) {
    if (document.nodes[i].parent < 0) roots.push_back(i);
  }
  json["scene"] = 0;
  json["scenes"] = GltfJson::array({{{"nodes", std::move(roots)}}});
}

}  // namespace

bool lacks_figure(const GltfDocument& document) {
  const auto skins = document.container.json.find("skins");
  if (skins != document.container.json.end() && !skins->empty()) return false;
  return !SkeletonNodes(document, nullptr).has_mesh();
}

std::string with_figure(const GltfDocument& document, const SkinnedBody* body) {
  GltfJson json = document.container.json;
  std::string added;
  const std::vector<FigureJoint> joints = SkeletonNodes(document, body).joints();
  make_room(document, json);
  const std::string& name = document.nodes[joints.front().node].name;
  add_figure(gltf_added_at(document.container), json, added, joints, name, body);
  return write_gltf_container(document.container, std::move(json), added);
}

std::string with_whole_skin(const GltfDocument& document) {
  GltfJson json = document.container.json;
  std::string added;
  GltfJson& skin = json["skins"][0];
  GltfChecker unheard("");
  const GltfPart root(document.container.json, unheard);
  const int accessor = root.item("skins", 0).index("inverseBindMatrices", root.size("accessors"));
  GltfValues matrices;
  if (accessor < 0 || !read_gltf_matrices(document.container, accessor, "", unheard, matrices) ||
      matrices.count != skin["joints"].size()) {
    return write_gltf_container(document.container, std::move(json), added);
  }
  const std::vector<FigureJoint> joints = SkeletonNodes(document, nullptr).joints();
  std::map<size_t, size_t> index_in_skin;  // Index in the skin, by node.
  for (size_t i = 0; i < matrices.count; ++i)
    index_in_skin.emplace(skin["joints"][i].get<size_t>(), i);
  std::vector<Affine> binds(joints.size());  // World transform in the mesh's unbent pose.
  for (size_t j = 0; j < joints.size(); ++j) {
    const auto found = index_in_skin.find(joints[j].node);
    const int parent = joints[j].parent;
    if (found != index_in_skin.end()) {
      const auto numbers = std::span(matrices.numbers).subspan(16 * found->second, 16);
      binds[j] = inverse(matrix_at(numbers));
    } else {
      binds[j] = parent < 0 ? joints[j].world : binds[parent] * joints[j].local;
    }
  }
  for (size_t j = 0; j < joints.size(); ++j) {
    if (index_in_skin.count(joints[j].node)) continue;
    skin["joints"].push_back(joints[j].node);
    append_matrix(matrices.numbers, inverse(binds[j]));
  }
  if (skin["joints"].size() > matrices.count) {
    GltfDataWriter data(gltf_added_at(document.container), json, added);
    const size_t index = data.add(matrices.numbers, "MAT4", 16);
    json["skins"][0]["inverseBindMatrices"] = index;
  }
  return write_gltf_container(document.container, std::move(json), added);
}

}  // namespace panache
