#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "clip/decimal.h"
#include "clip/gltf_document.h"

namespace panache {
namespace {

Quat quat_of(const std::array<double, 4>& v) { return Quatd{v[0], v[1], v[2], v[3]}.as<float>(); }
Vec3 vec_of(const std::array<double, 3>& v) { return Vec3d{v[0], v[1], v[2]}.as<float>(); }

// VRM 0.x counts the joints of a thumb from the hand's first phalanx on, VRM 1.0 from the bone in
// the palm; all other names are the same.
std::string role_of_vrm0(const std::string& name) {
  for (const char* side : {"left", "right"}) {
    const std::string thumb = std::string(side) + "Thumb";
    if (name == thumb + "Proximal") return thumb + "Metacarpal";
    if (name == thumb + "Intermediate") return thumb + "Proximal";
  }
  return name;
}

class NodeReader {
 public:
  NodeReader(GltfDocument& document, GltfChecker& checker)
      : json_(document.container.json), nodes_(document.nodes), checker_(checker) {}

  bool read() {
    const GltfJson* list = nullptr;
    if (!checker_.list(json_, "", "nodes", list)) return false;
    if (list->size() > kGltfMaxNodes) {
      return checker_.fail("nodes", "expected at most " + std::to_string(kGltfMaxNodes) +
                                        ", found " + std::to_string(list->size()));
    }
    nodes_.resize(list->size());
    for (size_t i = 0; i < nodes_.size(); ++i) {
      if (!read_node((*list)[i], i)) return false;
    }
    return read_skins() && read_vrm1("VRMC_vrm") && read_vrm1("VRMC_vrm_animation") &&
           read_vrm0() && read_carriers();
  }

 private:
  bool read_node(const GltfJson& json, size_t which) {
    const std::string path = item_path("nodes", which);
    GltfNode& node = nodes_[which];
    if (!checker_.is_object(json, path) || !checker_.text(json, path, "name", node.name)) {
      return false;
    }
    if (node.name.size() > kGltfMaxNameBytes) {
      return checker_.fail(path, "expected a name of at most " + std::to_string(kGltfMaxNameBytes) +
                                     " bytes, found " + std::to_string(node.name.size()));
    }
    if (node.name.empty()) node.name = "node " + std::to_string(which);
    const auto extras = json.find("extras");
    node.end = extras != json.end() && extras->is_object() && extras->contains(kEndSite) &&
               !json.contains("children");
    return read_children(json, path, which) && read_place(json, path, node);
  }

  bool read_children(const GltfJson& json, const std::string& path, size_t which) {
    const GltfJson* list = nullptr;
    if (!checker_.list(json, path, "children", list)) return false;
    for (size_t i = 0; i < list->size(); ++i) {
      const std::string child_path = item_path(member_path(path, "children"), i);
      int child = -1;
      if (!checker_.index_value((*list)[i], child_path, nodes_.size(), child)) return false;
      GltfNode& node = nodes_[child];
      if (node.parent >= 0) {
        return checker_.fail(child_path, "expected a node without another parent, found node " +
                                             std::to_string(child) + ", a child of node " +
                                             std::to_string(node.parent));
      }
      node.parent = static_cast<int>(which);
      nodes_[which].children.push_back(child);
    }
    return true;
  }

  bool read_place(const GltfJson& json, const std::string& path, GltfNode& node) {
    std::array<double, 3> translation = {0, 0, 0}, scale = {1, 1, 1};
    std::array<double, 4> rotation = {0, 0, 0, 1};
    std::array<double, 16> matrix = {};
    node.matrix = json.contains("matrix");
    if (node.matrix) {
      if (!checker_.numbers(json, path, "matrix", matrix)) return false;
      place_by_matrix(matrix, node);
      return true;
    }
    if (!checker_.numbers(json, path, "translation", translation) ||
        !checker_.numbers(json, path, "rotation", rotation) ||
        !checker_.numbers(json, path, "scale", scale)) {
      return false;
    }
    node.translation = vec_of(translation);
    node.rotation = quat_of(rotation);
    node.scale = {scale[0], scale[1], scale[2]};
    node.own = split_scale(node.scale);
    return true;
  }

  // Columns one after the other.
  static void place_by_matrix(const std::array<double, 16>& m, GltfNode& node) {
    const auto column = [&](size_t c) { return Vec3d{m[4 * c], m[4 * c + 1], m[4 * c + 2]}; };
    const SplitMatrix split = split_matrix({column(0), column(1), column(2)});
    node.translation = column(3).as<float>();
    node.rotation = split.rotation;
    node.own.stretch = split.stretch;
  }

  bool read_skins() {
    const GltfJson* skins = nullptr;
    if (!checker_.list(json_, "", "skins", skins)) return false;
    for (size_t s = 0; s < skins->size(); ++s) {
      const std::string path = item_path("skins", s);
      const GltfJson* joints = nullptr;
      if (!checker_.is_object((*skins)[s], path)) return false;
      if (!checker_.list((*skins)[s], path, "joints", joints)) return false;
      for (size_t i = 0; i < joints->size(); ++i) {
        const std::string joint_path = item_path(member_path(path, "joints"), i);
        int node = -1;
        if (!checker_.index_value((*joints)[i], joint_path, nodes_.size(), node)) return false;
        if (nodes_[node].end) continue;
        nodes_[node].skinned = true;
        nodes_[node].moves = true;
      }
    }
    return true;
  }

  // The object in extensions.NAME.humanoid.humanBones, or null.
  bool find_humanoid(const char* extension, std::string& path, const GltfJson*& humanoid) {
    const GltfJson *extensions = nullptr, *vrm = nullptr;
    humanoid = nullptr;
    if (!checker_.object(json_, "", "extensions", extensions)) return false;
    if (!extensions) return true;
    if (!checker_.object(*extensions, "extensions", extension, vrm)) return false;
    path = member_path("extensions", extension);
    if (!vrm) return true;
    if (!checker_.object(*vrm, path, "humanoid", humanoid)) return false;
    path += ".humanoid";
    return true;
  }

  bool set_role(const GltfJson& bone, const std::string& path, const std::string& role) {
    const auto member = bone.find("node");
    // VRM 0.x writes -1 for a joint that the body has not.
    if (member == bone.end() || (member->is_number_integer() && member->get<int64_t>() == -1)) {
      return true;
    }
    int node = -1;
    if (!checker_.index(bone, path, "node", nodes_.size(), node)) return false;
    nodes_[node].role = role.substr(0, kGltfMaxNameBytes);
    nodes_[node].moves = true;
    return true;
  }

  // VRM 1.0, and the animations for it, which name their own nodes in the same way.
  bool read_vrm1(const char* extension) {
    std::string path;
    const GltfJson *humanoid = nullptr, *bones = nullptr;
    if (!find_humanoid(extension, path, humanoid)) return false;
    if (!humanoid) return true;
    if (!checker_.object(*humanoid, path, "humanBones", bones)) return false;
    if (!bones) return true;
    path += ".humanBones";
    for (const auto& [role, bone] : bones->items()) {
      const std::string bone_path = member_path(path, role.substr(0, 40));
      if (!checker_.is_object(bone, bone_path) || !set_role(bone, bone_path, role)) return false;
    }
    return true;
  }

  // The nodes of a VRM animation whose places and rotations are weights of expressions and the
  // gaze: extensions.VRMC_vrm_animation.expressions.{preset,custom}.NAME.node and .lookAt.node.
  bool read_carriers() {
    std::string path = "extensions.VRMC_vrm_animation";
    const GltfJson *extensions = nullptr, *animation = nullptr, *expressions = nullptr;
    if (!checker_.object(json_, "", "extensions", extensions)) return false;
    if (!extensions) return true;
    if (!checker_.object(*extensions, "extensions", "VRMC_vrm_animation", animation)) return false;
    if (!animation) return true;
    if (!checker_.object(*animation, path, "expressions", expressions)) return false;
    if (!read_carrier(*animation, path, "lookAt")) return false;
    if (!expressions) return true;
    path += ".expressions";
    for (const char* kind : {"preset", "custom"}) {
      const GltfJson* list = nullptr;
      if (!checker_.object(*expressions, path, kind, list)) return false;
      if (!list) continue;
      for (const auto& [name, expression] : list->items()) {
        if (!read_carrier(*list, member_path(path, kind), name.c_str())) return false;
      }
    }
    return true;
  }

  bool read_carrier(const GltfJson& object, const std::string& path, const char* key) {
    const GltfJson* carrier = nullptr;
    int node = -1;
    if (!checker_.object(object, path, key, carrier)) return false;
    if (!carrier) return true;
    const std::string carrier_path = member_path(path, std::string(key).substr(0, 40));
    if (!checker_.index(*carrier, carrier_path, "node", nodes_.size(), node)) return false;
    // What is a joint as well stays one.
    if (node >= 0 && !nodes_[node].moves) {
      nodes_[node].carrier = true;
    }
    return true;
  }

  bool read_vrm0() {
    std::string path;
    const GltfJson *humanoid = nullptr, *bones = nullptr;
    if (!find_humanoid("VRM", path, humanoid)) return false;
    if (!humanoid) return true;
    if (!checker_.list(*humanoid, path, "humanBones", bones)) return false;
    path += ".humanBones";
    for (size_t i = 0; i < bones->size(); ++i) {
      const std::string bone_path = item_path(path, i);
      std::string role;
      if (!checker_.is_object((*bones)[i], bone_path) ||
          !checker_.text((*bones)[i], bone_path, "bone", role) ||
          !set_role((*bones)[i], bone_path, role_of_vrm0(role))) {
        return false;
      }
    }
    return true;
  }

  const GltfJson& json_;
  std::vector<GltfNode>& nodes_;
  GltfChecker& checker_;
};

class SkeletonBuilder {
 public:
  SkeletonBuilder(GltfDocument& document, GltfChecker& checker)
      : document_(document), nodes_(document.nodes), checker_(checker) {}

  bool build() {
    for (GltfNode& node : nodes_) mark_above(node);
    if (!order()) return false;
    if (document_.joint_nodes.empty()) {
      return checker_.fail("", "expected a skin or an animated node, found neither");
    }
    for (size_t j = 0; j < document_.joint_nodes.size(); ++j) {
      if (!add_joint(static_cast<size_t>(document_.joint_nodes[j]))) return false;
    }
    build_rest();
    return true;
  }

 private:
  // Stops where it has been: also in a circle of nodes, which order() finds.
  void mark_above(const GltfNode& node) {
    if (!node.moves) return;
    for (int up = node.parent; up >= 0 && !nodes_[up].moves;) {
      nodes_[up].moves = true;
      up = nodes_[up].parent;
    }
  }

  // Depth first, children in the file's order; without recursion, the depth is the file's to
  // choose. Nodes that no root leads to form circles.
  bool order() {
    struct Visit {
      int node;
      int depth;
    };
    std::vector<Visit> waiting;
    for (size_t i = nodes_.size(); i-- > 0;) {
      if (nodes_[i].parent < 0) waiting.push_back({static_cast<int>(i), 1});
    }
    size_t visited = 0;
    while (!waiting.empty()) {
      const Visit visit = waiting.back();
      waiting.pop_back();
      ++visited;
      GltfNode& node = nodes_[visit.node];
      if (visit.depth > kGltfMaxDepth) {
        return checker_.fail("nodes", "expected at most " + std::to_string(kGltfMaxDepth) +
                                          " one below the other, found more");
      }
      if (node.moves) {
        node.joint = static_cast<int>(document_.joint_nodes.size());
        document_.joint_nodes.push_back(visit.node);
      }
      for (size_t c = node.children.size(); c-- > 0;) {
        waiting.push_back({node.children[c], visit.depth + 1});
      }
    }
    return visited == nodes_.size() ||
           checker_.fail("nodes", "expected a tree, found nodes that are below themselves");
  }

  bool add_joint(size_t which) {
    const GltfNode& node = nodes_[which];
    Joint joint;
    joint.name = node.name;
    joint.role = node.role;
    joint.skin = node.skin;
    joint.skin_weight = node.skin_weight;
    joint.can_rotate = !node.matrix;
    Stretch above;
    bool below_skin = false;
    if (node.parent >= 0) {
      // The parent of what moves is a joint too, and an earlier one.
      const GltfNode& parent = nodes_[node.parent];
      const size_t p = static_cast<size_t>(parent.joint);
      joint.parent = parent.joint;
      if (!parent.own.stretch.can_undo()) return reject_flat(static_cast<size_t>(node.parent));
      above = document_.above[p].below(document_.skeleton.joints[p].rest, parent.own.stretch);
      document_.bends = document_.bends || !document_.above[p].is_even();
      below_skin = below_skin_[p] || parent.skinned;
    }
    joint.can_translate = !node.matrix && (joint.parent < 0 || (node.skinned && !below_skin));
    joint.rest = clip_rotation(node.rotation, node.own.turn);
    joint.offset = above.apply(node.translation);
    const Stretch below = above.below(joint.rest, node.own.stretch);
    for (const int child : node.children) {
      const GltfNode& end = nodes_[child];
      if (end.end && !end.moves) joint.ends.push_back(below.apply(end.translation));
    }
    const double reach = static_cast<double>(
        std::max({std::abs(joint.offset.x), std::abs(joint.offset.y), std::abs(joint.offset.z)}));
    const auto lengths = above.lengths();
    const auto [least, most] = std::minmax_element(lengths.begin(), lengths.end());
    if (!(*most <= kLargestNumber) || !(*least >= 1 / kLargestNumber) ||
        !(reach <= kLargestNumber)) {
      return checker_.fail(item_path("nodes", which),
                           "expected a position and a scale between -1e9 and 1e9, found them "
                           "larger by the scales of the nodes above");
    }
    document_.skeleton.joints.push_back(std::move(joint));
    document_.above.push_back(above);
    below_skin_.push_back(below_skin);
    return true;
  }
  bool reject_flat(size_t which) {
    return checker_.fail(item_path("nodes", which),
                         "expected a scale that leaves each of its axes some length, as other "
                         "joints are below it, found one that is flat");
  }

  void build_rest() { document_.rest = rest_clip(document_.skeleton); }

  GltfDocument& document_;
  std::vector<GltfNode>& nodes_;
  GltfChecker& checker_;
  std::vector<char> below_skin_;  // [joints] 1 where a node above is in a skin.
};

}  // namespace

Quat clip_rotation(Quat in_file, Quat scale_turn) {
  const Quatd exact = in_file.as<double>();
  // A unit quaternion that was rounded to floats is left alone: it is as good as ours would be, and
  // comes back as it was. Its length squared is off by 4 times 2^-24 at most; files whose writers
  // computed with floats are off by some more.
  const Quat unit =
      std::abs(dot(exact, exact) - 1) < 5e-7 ? in_file : normalized(exact).as<float>();
  // A product with half a turn about an axis only changes places and signs of the numbers.
  return scale_turn == Quat{} ? unit : unit * scale_turn;
}

Quat file_rotation(Quat in_clip, Quat scale_turn) {
  return scale_turn == Quat{} ? in_clip : in_clip * conjugate(scale_turn);
}

bool read_gltf_nodes(GltfDocument& document, GltfChecker& checker) {
  return NodeReader(document, checker).read();
}

bool build_gltf_skeleton(GltfDocument& document, GltfChecker& checker) {
  return SkeletonBuilder(document, checker).build();
}

}  // namespace panache
