#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "clip/gltf_document.h"
#include "clip/gltf_scales.h"
#include "clip/text_cursor.h"

namespace panache {
namespace {

Quat quat_of(const std::array<double, 4>& v) { return Quatd{v[0], v[1], v[2], v[3]}.as<float>(); }
Vec3 vec_of(const std::array<double, 3>& v) { return Vec3d{v[0], v[1], v[2]}.as<float>(); }

// VRM 0.x counts the joints of a thumb from the hand's first phalanx, VRM 1.0 from the bone in the
// palm; all other names are the same.
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
      : root_(document.container.json, checker), nodes_(document.nodes) {}

  bool read() {
    const std::vector<GltfPart> list = root_.list("nodes");
    if (list.size() > kGltfMaxNodes) {
      return root_.member("nodes").fail("expected at most " + std::to_string(kGltfMaxNodes) +
                                        ", found " + std::to_string(list.size()));
    }
    nodes_.resize(list.size());
    for (size_t i = 0; i < list.size(); ++i) read_node(list[i], i);
    read_skins();
    read_vrm1("VRMC_vrm");
    read_vrm1("VRMC_vrm_animation");
    read_vrm0();
    read_carriers();
    return root_.ok();
  }

 private:
  void read_node(const GltfPart& part, size_t which) {
    GltfNode& node = nodes_[which];
    node.name = part.text("name");
    if (node.name.size() > kGltfMaxNameBytes) {
      part.fail("expected a name of at most " + std::to_string(kGltfMaxNameBytes) +
                " bytes, found " + std::to_string(node.name.size()));
    }
    if (node.name.empty()) node.name = "node " + std::to_string(which);
    const GltfPart extras = part.member("extras");
    node.end = extras && extras.json().contains(kEndSite) && !part.member("children");
    for (const GltfPart& child : part.list("children")) add_child(child, which);
    read_transform(part, node);
  }

  void add_child(const GltfPart& part, size_t parent) {
    const int child = part.as_index(nodes_.size());
    if (child < 0) return;
    GltfNode& node = nodes_[child];
    if (node.parent >= 0) {
      part.fail("expected a node without another parent, found node " + std::to_string(child) +
                ", a child of node " + std::to_string(node.parent));
      return;
    }
    node.parent = static_cast<int>(parent);
    nodes_[parent].children.push_back(child);
  }

  static void read_transform(const GltfPart& part, GltfNode& node) {
    std::array<double, 3> translation = {0, 0, 0}, scale = {1, 1, 1};
    std::array<double, 4> rotation = {0, 0, 0, 1};
    std::array<double, 16> matrix = {};
    node.matrix = bool(part.member("matrix"));
    if (node.matrix) {
      part.numbers("matrix", matrix);
      place_by_matrix(matrix, node);
      return;
    }
    part.numbers("translation", translation);
    part.numbers("rotation", rotation);
    part.numbers("scale", scale);
    node.translation = vec_of(translation);
    node.rotation = quat_of(rotation);
    node.scale = {scale[0], scale[1], scale[2]};
    node.own = split_scale(node.scale);
  }

  // Column-major.
  static void place_by_matrix(const std::array<double, 16>& m, GltfNode& node) {
    const auto column = [&](size_t c) { return Vec3d{m[4 * c], m[4 * c + 1], m[4 * c + 2]}; };
    const SplitMatrix split = split_matrix({column(0), column(1), column(2)});
    node.translation = column(3).as<float>();
    node.rotation = split.rotation;
    node.own.stretch = split.stretch;
  }

  void read_skins() {
    for (const GltfPart& skin : root_.list("skins")) {
      for (const GltfPart& joint : skin.list("joints")) {
        const int node = joint.as_index(nodes_.size());
        if (node >= 0 && !nodes_[node].end) nodes_[node].skinned = nodes_[node].moves = true;
      }
    }
  }

  GltfPart extension(const char* name) const { return root_.object("extensions").object(name); }

  void set_role(const GltfPart& bone, const std::string& role) {
    const GltfPart member = bone.member("node");
    // VRM 0.x writes -1 for a joint that the body lacks.
    if (member && member.json() == -1) return;
    const int node = bone.index("node", nodes_.size());
    if (node < 0) return;
    nodes_[node].role = role.substr(0, kGltfMaxNameBytes);
    nodes_[node].moves = true;
  }

  // VRM 1.0, and its animations, which name their own nodes in the same way.
  void read_vrm1(const char* name) {
    const GltfPart bones = extension(name).object("humanoid").object("humanBones");
    for (const auto& [role, bone] : bones.members()) set_role(bone, role);
  }

  void read_vrm0() {
    for (const GltfPart& bone : extension("VRM").object("humanoid").list("humanBones")) {
      set_role(bone, role_of_vrm0(bone.text("bone")));
    }
  }

  // The nodes of a VRM animation whose translations and rotations are weights of expressions and
  // the gaze: extensions.VRMC_vrm_animation.expressions.{preset,custom}.NAME.node and .lookAt.node.
  void read_carriers() {
    const GltfPart animation = extension("VRMC_vrm_animation");
    const GltfPart expressions = animation.object("expressions");
    read_carrier(animation.object("lookAt"));
    for (const char* kind : {"preset", "custom"}) {
      for (const auto& [name, expression] : expressions.object(kind).members()) {
        read_carrier(expression);
      }
    }
  }

  void read_carrier(const GltfPart& carrier) {
    const int node = carrier.index("node", nodes_.size());
    // A node that is also a joint stays a joint.
    if (node >= 0 && !nodes_[node].moves) nodes_[node].carrier = true;
  }

  GltfPart root_;
  std::vector<GltfNode>& nodes_;
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
      if (!add_joint(document_.joint_nodes[j])) return false;
    }
    document_.rest = rest_clip(document_.skeleton);
    return true;
  }

 private:
  // Stops at visited nodes, so also in a cycle of nodes, which order() finds.
  void mark_above(const GltfNode& node) {
    if (!node.moves) return;
    for (int up = node.parent; up >= 0 && !nodes_[up].moves;) {
      nodes_[up].moves = true;
      up = nodes_[up].parent;
    }
  }

  // Depth first, children in the file's order; without recursion, because the file determines the
  // depth. Nodes that no root leads to form cycles.
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
      // The parent of a moving node is also a joint, and an earlier one.
      const GltfNode& parent = nodes_[node.parent];
      const int p = joint.parent = parent.joint;
      if (!parent.own.stretch.can_undo()) {
        return checker_.fail(item_path("nodes", node.parent),
                             "expected a scale that leaves each of its axes some length, as other "
                             "joints are below it, found one that is flat");
      }
      above = above_[p].below(document_.skeleton.joints[p].rest, parent.own.stretch);
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
    const bool fits = std::ranges::all_of(above.lengths(), [](double length) {
      return length <= kLargestNumber && length >= 1 / kLargestNumber;
    });
    if (!fits || !is_within_reach(joint.offset)) {
      return checker_.fail(item_path("nodes", which),
                           "expected a position and a scale between -1e9 and 1e9, found them "
                           "larger by the scales of the nodes above");
    }
    document_.skeleton.joints.push_back(std::move(joint));
    above_.push_back(above);
    below_skin_.push_back(below_skin);
    return true;
  }

  GltfDocument& document_;
  std::vector<GltfNode>& nodes_;
  GltfChecker& checker_;
  std::vector<Stretch> above_;    // [joints] effect of the nodes above on its position, at rest.
  std::vector<char> below_skin_;  // [joints] 1 if a node above is in a skin.
};

}  // namespace

Quat clip_rotation(Quat in_file, Quat scale_turn) {
  const Quatd exact = in_file.as<double>();
  // A unit quaternion that was rounded to floats is kept: normalising would not improve it, and it
  // is written as it was. Its squared length is off by at most 4 times 2^-24; files whose writers
  // computed with floats are off by a little more.
  const Quat unit =
      std::abs(dot(exact, exact) - 1) < 5e-7 ? in_file : normalized(exact).as<float>();
  // A product with half a turn about an axis only permutes and negates the numbers.
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
