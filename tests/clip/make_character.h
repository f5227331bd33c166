#pragma once
// A skinned character of our own making as a glTF file: a body of boxes with fingers and twist
// joints, a sword in its hand, a morph target, two animations, and things that nobody but their
// owner understands.

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "make_gltf.h"

namespace panache::test {

struct CharacterOptions {
  enum class Vrm { none, vrm0, vrm1 };
  Vrm vrm = Vrm::none;  // Which humanoid extension names the joints.
  // Joints in centimetres and Z up, under a node that scales and turns them, as many exporters
  // write them.
  bool centimetres = false;
};

// Makes the file; character() below is how tests call it. Right-handed, metres, Y up, facing +z,
// +x to the character's left, arms out. Every joint's own y axis points to the next joint.
class CharacterMaker {
 public:
  explicit CharacterMaker(const CharacterOptions& options) : options_(options) {
    list_joints();
    place_joints();
    add_nodes();
    add_body();
    add_sword();
    add_walk();
    add_wave();
    add_extensions();
  }
  GltfParts take() { return std::move(parts_); }

 private:
  struct Bone {
    std::string name, role;  // The role is VRM 1.0's; empty for a twist joint.
    int parent;
    Vec3d position;  // World, metres.
    Vec3d tip;       // Where its box ends.
    double width;
    Quatd turn = {};  // World, at rest.
  };
  static constexpr int kVertexData = 34962, kIndexData = 34963;
  static constexpr double kQuarter = 1.5707963267948966;

  int add(const std::string& name, const std::string& role, int parent, Vec3d position, Vec3d tip,
          double width) {
    bones_.push_back({name, role, parent, position, tip, width});
    return static_cast<int>(bones_.size()) - 1;
  }

  void list_joints() {
    const int hips = add("Hips", "hips", -1, {0, 0.95, 0}, {0, 1.05, 0}, 0.24);
    const int spine = add("Spine", "spine", hips, {0, 1.05, 0}, {0, 1.2, 0}, 0.2);
    const int chest = add("Chest", "chest", spine, {0, 1.2, 0}, {0, 1.44, 0}, 0.26);
    const int neck = add("Neck", "neck", chest, {0, 1.45, 0}, {0, 1.53, 0}, 0.09);
    add("Head", "head", neck, {0, 1.53, 0}, {0, 1.76, 0}, 0.18);
    for (const double x : {1.0, -1.0}) list_limbs(x, hips, chest);
  }

  // Those of the left side where x = 1, of the right where x = -1.
  void list_limbs(double x, int hips, int chest) {
    const std::string name = x > 0 ? "Left" : "Right", role = x > 0 ? "left" : "right";
    const auto arm = [&](double along, double z) { return Vec3d{x * along, 1.4, z}; };
    const int shoulder =
        add(name + "Shoulder", role + "Shoulder", chest, arm(0.04, 0), arm(0.16, 0), 0.1);
    const int upper =
        add(name + "Arm", role + "UpperArm", shoulder, arm(0.16, 0), arm(0.42, 0), 0.085);
    const int lower =
        add(name + "ForeArm", role + "LowerArm", upper, arm(0.42, 0), arm(0.54, 0), 0.07);
    add(name + "ForeArmTwist", "", lower, arm(0.54, 0), arm(0.66, 0), 0.062);
    const int hand = add(name + "Hand", role + "Hand", lower, arm(0.66, 0), arm(0.74, 0), 0.075);
    const char* const fingers[] = {"Thumb", "Index", "Middle", "Ring", "Little"};
    for (int f = 0; f < 5; ++f) list_finger(name, role, fingers[f], hand, x, f);

    const auto leg = [&](double y, double z) { return Vec3d{x * 0.09, y, z}; };
    const int thigh = add(name + "UpLeg", role + "UpperLeg", hips, leg(0.91, 0), leg(0.5, 0), 0.13);
    const int shin = add(name + "Leg", role + "LowerLeg", thigh, leg(0.5, 0), leg(0.09, 0), 0.1);
    const int foot = add(name + "Foot", role + "Foot", shin, leg(0.09, 0), leg(0.03, 0.13), 0.08);
    add(name + "ToeBase", role + "Toes", foot, leg(0.03, 0.13), leg(0.03, 0.2), 0.06);
  }

  void list_finger(const std::string& name, const std::string& role, const std::string& finger,
                   int hand, double x, int which) {
    const bool thumb = which == 0;
    const char* const phalanges[] = {thumb ? "Metacarpal" : "Proximal",
                                     thumb ? "Proximal" : "Intermediate", "Distal"};
    int parent = hand;
    for (int i = 0; i < 3; ++i) {
      const double along = (thumb ? 0.68 : 0.75) + 0.028 * i;
      const double z = thumb ? 0.045 + 0.015 * i : 0.034 - 0.022 * (which - 1);
      const double next = thumb ? z + 0.015 : z;
      parent = add(name + "Hand" + finger + std::to_string(i + 1), role + finger + phalanges[i],
                   parent, {x * along, 1.4, z}, {x * (along + 0.026), 1.4, next}, 0.016);
    }
  }

  // Nodes: the armature, the bones in their order, the body, the sword.
  static size_t node_of(int bone) { return static_cast<size_t>(bone) + 1; }
  size_t body_node() const { return bones_.size() + 1; }
  size_t sword_node() const { return bones_.size() + 2; }
  int bone_named(const std::string& name) const {
    for (size_t b = 0; b < bones_.size(); ++b) {
      if (bones_[b].name == name) return static_cast<int>(b);
    }
    std::abort();
  }
  const Bone& bone(int which) const { return bones_[static_cast<size_t>(which)]; }

  Quatd armature_turn() const {
    return options_.centimetres ? axis_angle(Vec3d{1, 0, 0}, -kQuarter) : Quatd{};
  }
  double unit() const { return options_.centimetres ? 0.01 : 1.0; }  // Metres.

  void place_joints() {
    for (Bone& b : bones_) {
      b.turn = rotation_between(Vec3d{0, 1, 0}, normalized(b.tip - b.position));
    }
  }
  Quatd turn_above(int which) const {
    return bone(which).parent < 0 ? armature_turn() : bone(bone(which).parent).turn;
  }
  // In units of the file, for a place in the world.
  Vec3d local_position(int which, Vec3d position) const {
    const int parent = bone(which).parent;
    const Vec3d above = parent < 0 ? Vec3d{} : bone(parent).position;
    return rotate(conjugate(turn_above(which)), position - above) / unit();
  }
  // The joint's rotation when it turns by `turn` about the world's axes, as they were at rest.
  Quatd local_turn(int which, Quatd turn = {}) const {
    return normalized(conjugate(turn_above(which)) * turn * bone(which).turn);
  }

  void add_nodes() {
    Json& nodes = parts_.json["nodes"];
    Json armature = {{"name", "Armature"}, {"children", Json::array({1})}};
    if (options_.centimetres) {
      armature["rotation"] = numbers(armature_turn().as<float>());
      armature["scale"] = {0.01, 0.01, 0.01};
    }
    nodes.push_back(armature);
    for (size_t b = 0; b < bones_.size(); ++b) {
      const int which = static_cast<int>(b);
      const Vec3 t = local_position(which, bones_[b].position).as<float>();
      nodes.push_back({{"name", bones_[b].name},
                       {"translation", {t.x, t.y, t.z}},
                       {"rotation", numbers(local_turn(which).as<float>())}});
      if (bones_[b].parent >= 0) {
        nodes[node_of(bones_[b].parent)]["children"].push_back(node_of(which));
      }
    }
    nodes.push_back({{"name", "Body"}, {"mesh", 0}, {"skin", 0}});
    nodes.push_back({{"name", "Sword"}, {"mesh", 1}});
    const int hand = bone_named("RightHand");
    nodes[node_of(hand)]["children"].push_back(sword_node());
    // Held by its end, across the palm.
    const Quatd across = rotation_between(Vec3d{0, 1, 0}, Vec3d{0, 0, 1});
    nodes[sword_node()]["rotation"] = numbers((conjugate(bone(hand).turn) * across).as<float>());
    const Vec3 grip =
        (rotate(conjugate(bone(hand).turn), Vec3d{-0.07, -0.03, 0}) / unit()).as<float>();
    nodes[sword_node()]["translation"] = {grip.x, grip.y, grip.z};
    nodes[sword_node()]["scale"] = {1 / unit(), 1 / unit(), 1 / unit()};
    parts_.json["scene"] = 0;
    parts_.json["scenes"] =
        Json::array({{{"name", "Scene"}, {"nodes", Json::array({size_t{0}, body_node()})}}});
  }
  static Json numbers(Quat q) { return {q.x, q.y, q.z, q.w}; }

  Json primitive(const BoxMesh& mesh, int material) {
    Json attributes = {{"POSITION", parts_.add_bounded(mesh.positions, "VEC3", 3, kVertexData)},
                       {"NORMAL", parts_.add(mesh.normals, "VEC3", 3, kVertexData)}};
    const size_t indices = parts_.add(mesh.indices, "SCALAR", 1, kIndexData);
    return {{"attributes", attributes}, {"indices", indices}, {"material", material}};
  }

  void add_body() {
    BoxMesh mesh;
    for (size_t b = 0; b < bones_.size(); ++b) {
      const Bone& from = bones_[b];
      mesh.add_box(from.position, from.tip, from.width, static_cast<int>(b), from.parent,
                   from.name == "Head" ? 0.05 : 0.0);
    }
    Json body = primitive(mesh, 0);
    body["attributes"]["JOINTS_0"] = parts_.add(mesh.joints, "VEC4", 4, kVertexData);
    body["attributes"]["WEIGHTS_0"] = parts_.add(mesh.weights, "VEC4", 4, kVertexData);
    body["targets"][0]["POSITION"] = parts_.add_bounded(mesh.morph, "VEC3", 3, kVertexData);
    parts_.json["meshes"].push_back(
        {{"name", "Body"},
         {"primitives", Json::array({body})},
         {"weights", Json::array({0.0})},
         {"extras", Json::object({{"targetNames", Json::array({"puff"})}})}});
    parts_.json["materials"] = {
        {{"name", "Skin"},
         {"pbrMetallicRoughness",
          {{"baseColorFactor", {0.8, 0.55, 0.4, 1.0}}, {"metallicFactor", 0.0}}}},
        {{"name", "Steel"},
         {"pbrMetallicRoughness",
          {{"baseColorFactor", {0.2, 0.3, 0.8, 1.0}}, {"metallicFactor", 0.0}}}}};

    std::vector<float> matrices;
    Json joints = Json::array();
    for (size_t b = 0; b < bones_.size(); ++b) {
      const Quatd back = conjugate(bones_[b].turn);
      const double k = 1 / unit();
      for (const Vec3d axis : {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}}) {
        append(matrices, (rotate(back, axis) * k).as<float>());
        matrices.push_back(0);
      }
      append(matrices, (rotate(back, -bones_[b].position) * k).as<float>());
      matrices.push_back(1);
      joints.push_back(node_of(static_cast<int>(b)));
    }
    const size_t accessor = parts_.add(matrices, "MAT4", 16);
    parts_.json["skins"][0] = {
        {"inverseBindMatrices", accessor}, {"joints", joints}, {"skeleton", 1}};
  }

  void add_sword() {
    BoxMesh mesh;
    mesh.add_box({0, -0.1, 0}, {0, 0.6, 0}, 0.03, 0, -1, 0);
    mesh.add_box({-0.08, 0.05, 0}, {0.08, 0.05, 0}, 0.03, 0, -1, 0);
    Json sword = primitive(mesh, 1);
    parts_.json["meshes"].push_back({{"name", "Sword"}, {"primitives", Json::array({sword})}});
  }

  // Rotation keys of a bone: by turn(0 to 1) about the world's axes.
  template <class Turn>
  size_t turns(const std::string& name, int keys, const Turn& turn) {
    std::vector<float> values;
    for (int i = 0; i < keys; ++i) {
      append(values, local_turn(bone_named(name), turn(static_cast<double>(i) / (keys - 1)))
                         .template as<float>());
    }
    return parts_.add(values, "VEC4", 4);
  }

  // One second of two steps, 31 keys, hips that go 1.2 m.
  void add_walk() {
    constexpr int kKeys = 31;
    const Vec3d x = {1, 0, 0}, z = {0, 0, 1};
    Json& animation = parts_.json["animations"][0];
    animation["name"] = "Walk";
    animation["extras"]["stride"] = 1.2;
    const size_t times = parts_.add_bounded(key_times(kKeys), "SCALAR", 1);
    const auto wave = [](double t, double shift) { return std::sin(4 * kQuarter * (t + shift)); };
    const auto turn = [&](const std::string& name, const auto& turn_at) {
      parts_.add_channel(0, node_of(bone_named(name)), "rotation", "LINEAR", times,
                         turns(name, kKeys, turn_at));
    };
    std::vector<float> positions;
    for (int i = 0; i < kKeys; ++i) {
      const double t = i / 30.0;
      const Vec3d at = {0.02 * wave(t, 0), 0.95 + 0.02 * wave(2 * t, 0), 1.2 * t};
      append(positions, local_position(0, at).as<float>());
    }
    parts_.add_channel(0, node_of(0), "translation", "LINEAR", times,
                       parts_.add(positions, "VEC3", 3));
    turn("Hips", [&](double t) { return rotation_y(0.1 * wave(t, 0)); });
    turn("Spine", [&](double t) { return rotation_y(-0.1 * wave(t, 0)); });
    for (const double side : {1.0, -1.0}) {
      const std::string name = side > 0 ? "Left" : "Right";
      // Arms down from the T-pose, then against the leg of their side.
      turn(name + "Arm", [&](double t) {
        return axis_angle(x, 0.4 * side * wave(t, 0)) * axis_angle(z, -1.3 * side);
      });
      turn(name + "ForeArm",
           [&](double t) { return rotation_y(-side * (0.35 + 0.15 * side * wave(t, 0))); });
      turn(name + "UpLeg", [&](double t) { return axis_angle(x, -0.45 * side * wave(t, 0)); });
      turn(name + "Leg", [&](double t) {
        return axis_angle(x, 0.1 + 0.7 * std::max(0.0, side * wave(t, 0.25)));
      });
      turn(name + "Foot", [&](double t) { return axis_angle(x, -0.15 * side * wave(t, 0)); });
    }
  }

  // Two seconds of waving, with keys of every kind.
  void add_wave() {
    const Vec3d y = {0, 1, 0}, z = {0, 0, 1};
    parts_.json["animations"][1]["name"] = "Wave";
    const size_t dense = parts_.add_bounded(key_times(61), "SCALAR", 1);
    const size_t coarse = parts_.add_bounded(key_times(5, 2), "SCALAR", 1);
    const size_t single = parts_.add_bounded({0.0f}, "SCALAR", 1);
    const auto node = [&](const char* name) { return node_of(bone_named(name)); };

    // Tangents of zero: from pose to pose with a rest at each.
    std::vector<float> spline;
    for (int i = 0; i < 5; ++i) {
      const double raise = i == 0 || i == 4 ? 1.3 : -0.9;
      append(spline, Quat{0, 0, 0, 0});
      append(spline, local_turn(bone_named("RightArm"), axis_angle(z, raise)).as<float>());
      append(spline, Quat{0, 0, 0, 0});
    }
    parts_.add_channel(1, node("RightArm"), "rotation", "CUBICSPLINE", coarse,
                       parts_.add(spline, "VEC4", 4));
    parts_.add_channel(1, node("RightForeArm"), "rotation", "LINEAR", dense,
                       turns("RightForeArm", 61, [&](double t) {
                         return axis_angle(z, -0.5 * std::sin(16 * kQuarter * t));
                       }));
    parts_.add_channel(1, node("LeftArm"), "rotation", "LINEAR", single,
                       turns("LeftArm", 2, [&](double) { return axis_angle(z, -1.3); }));
    parts_.json["accessors"].back()["count"] = 1;
    parts_.add_channel(
        1, node("RightHandIndex1"), "rotation", "STEP", coarse,
        turns("RightHandIndex1", 5, [&](double t) { return axis_angle(z, t > 0.4 ? 0.6 : 0.0); }));

    std::vector<int16_t> packed;
    for (int i = 0; i < 5; ++i) {
      const Quatd q = local_turn(bone_named("Head"), axis_angle(y, 0.3 * (i % 2)));
      for (const double v : {q.x, q.y, q.z, q.w}) {
        packed.push_back(static_cast<int16_t>(std::lround(v * 32767)));
      }
    }
    const size_t head = parts_.add(packed, "VEC4", 4);
    parts_.json["accessors"][head]["normalized"] = true;
    parts_.add_channel(1, node("Head"), "rotation", "LINEAR", coarse, head);

    const float k = static_cast<float>(1 / unit());
    parts_.add_channel(
        1, sword_node(), "scale", "LINEAR", coarse,
        parts_.add(std::vector<float>{k, k, k, k, 1.5f * k, k, k, k, k, k, 1.5f * k, k, k, k, k},
                   "VEC3", 3));
    parts_.add_channel(1, body_node(), "weights", "LINEAR", coarse,
                       parts_.add(std::vector<float>{0, 1, 0, 1, 0}, "SCALAR", 1));
  }

  void add_extensions() {
    Json& json = parts_.json;
    json["asset"]["extras"]["author"] = "nobody";
    json["extensionsUsed"].push_back("ACME_mood");
    Json& mood = json["extensions"]["ACME_mood"]["moods"][0];
    mood["name"] = "calm";
    mood["level"] = 0.25;
    json["nodes"][node_of(bone_named("Head"))]["extensions"]["ACME_mood"]["mood"] = 0;
    json["nodes"][sword_node()]["extras"] = {{"damage", 7}, {"runes", {"a", "b"}}};
    using enum CharacterOptions::Vrm;
    if (options_.vrm == none) return;
    const char* const name = options_.vrm == vrm1 ? "VRMC_vrm" : "VRM";
    json["extensionsUsed"].push_back(name);
    Json& vrm = json["extensions"][name];
    vrm["specVersion"] = options_.vrm == vrm1 ? "1.0" : "0.0";
    for (size_t b = 0; b < bones_.size(); ++b) {
      std::string role = bones_[b].role;
      if (role.empty()) continue;
      const size_t node = node_of(static_cast<int>(b));
      if (options_.vrm == vrm1) {
        vrm["humanoid"]["humanBones"][role]["node"] = node;
        continue;
      }
      const size_t thumb = role.find("Thumb");
      if (thumb != std::string::npos) {
        const std::string side = role.substr(0, thumb + 5), part = role.substr(thumb + 5);
        role = side + (part == "Metacarpal" ? "Proximal"
                       : part == "Proximal" ? "Intermediate"
                                            : "Distal");
      }
      vrm["humanoid"]["humanBones"].push_back({{"bone", role}, {"node", node}});
    }
  }

  CharacterOptions options_;
  std::vector<Bone> bones_;
  GltfParts parts_;
};

inline GltfParts character(const CharacterOptions& options = {}) {
  return CharacterMaker(options).take();
}

}  // namespace panache::test
