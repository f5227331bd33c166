#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <vector>

#include "clip/fk.h"
#include "clip/gltf.h"
#include "clip/gltf_encode.h"

namespace panache {
namespace {

constexpr int kUnsignedByte = 5121, kUnsignedShort = 5123;
constexpr int kVertexData = 34962, kTriangleData = 34963;
constexpr const char* kVrmAnimation = "VRMC_vrm_animation";
// Where an octahedron is widest, and how wide it is there, in lengths of its stick.
constexpr float kWaist = 0.2f, kHalfWidth = 0.08f;

class GlbFormatter {
 public:
  GlbFormatter(const Clip& clip, const std::string& name, double metres_per_unit, Quat to_y_up)
      : clip_(clip), name_(name), scale_(metres_per_unit), turn_(to_y_up.as<double>()) {
    assert(metres_per_unit > 0);
    // [joints] The joints at rest, under the node that scales and turns them.
    std::vector<Quat> rotations;
    std::vector<Vec3> translations;
    for (const Joint& joint : clip.skeleton.joints) {
      rotations.push_back(joint.rest);
      translations.push_back(joint.offset);
    }
    world_pose(clip.skeleton, {rotations, translations}, {rotations, translations});
    for (size_t j = 0; j < clip.joints(); ++j) {
      rest_turns_.push_back(normalized(turn_ * rotations[j].as<double>()));
      rest_places_.push_back(rotate(turn_, translations[j].as<double>()) * scale_);
    }
  }

  std::string format(const SkinnedBody* body) {
    begin();
    if (body) {
      add_body(*body);
    } else {
      add_skin();
      add_figure();
    }
    return end();
  }

  // As a VRM animation: without a figure, but with a humanoid.
  std::string format_vrma() {
    begin();
    add_humanoid();
    return end();
  }

 private:
  void begin() {
    json_["asset"] = {{"version", "2.0"}, {"generator", "Panache"}};
    json_["scene"] = 0;
    json_["scenes"][0]["nodes"].push_back(0);
    add_nodes();
    json_["buffers"][0]["byteLength"] = 0;
  }

  std::string end() {
    add_animation();

    GltfContainer container;
    container.binary = true;
    container.has_bin = true;
    container.buffers.emplace_back("");
    return write_gltf_container(container, std::move(json_), bytes_);
  }

  // The node above all, the joints, then the End Sites.
  void add_nodes() {
    const Skeleton& skeleton = clip_.skeleton;
    GltfJson above = {{"name", name_}, {"children", GltfJson::array()}};
    const Quat turn = turn_.as<float>();
    above["rotation"] = {turn.x, turn.y, turn.z, turn.w};
    above["scale"] = {scale_, scale_, scale_};
    json_["nodes"].push_back(std::move(above));
    for (const Joint& joint : skeleton.joints) {
      GltfJson node = {{"name", joint.name}};
      node["translation"] = {joint.offset.x, joint.offset.y, joint.offset.z};
      node["rotation"] = {joint.rest.x, joint.rest.y, joint.rest.z, joint.rest.w};
      json_["nodes"].push_back(std::move(node));
    }
    for (size_t j = 0; j < skeleton.joints.size(); ++j) {
      json_["nodes"][node_above(j)]["children"].push_back(j + 1);
    }
    for (size_t j = 0; j < skeleton.joints.size(); ++j) {
      for (const Vec3 end : skeleton.joints[j].ends) {
        json_["nodes"][j + 1]["children"].push_back(json_["nodes"].size());
        json_["nodes"].push_back(
            {{"name", skeleton.joints[j].name + " end"}, {"translation", {end.x, end.y, end.z}}});
      }
    }
  }

  void add_humanoid() {
    json_["extensionsUsed"].push_back(kVrmAnimation);
    GltfJson& animation = json_["extensions"][kVrmAnimation];
    animation["specVersion"] = "1.0";
    for (size_t j = 0; j < clip_.joints(); ++j) {
      const std::string& role = clip_.skeleton.joints[j].role;
      if (!role.empty()) animation["humanoid"]["humanBones"][role]["node"] = j + 1;
    }
  }

  size_t node_above(size_t joint) const {
    return static_cast<size_t>(clip_.skeleton.joints[joint].parent + 1);
  }

  GltfDataWriter writer() { return GltfDataWriter({0, 0}, json_, bytes_); }

  void add_skin() {
    std::vector<float> matrices;  // [joints][16], columns one after the other.
    GltfJson joints = GltfJson::array();
    for (size_t j = 0; j < clip_.joints(); ++j) {
      const Quatd back = conjugate(rest_turns_[j]);
      for (const Vec3d axis : {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}}) {
        append(matrices, rotate(back, axis) / scale_, 0);
      }
      append(matrices, -rotate(back, rest_places_[j]) / scale_, 1);
      joints.push_back(j + 1);
    }
    // New members move the others: no reference to one outlives an addition.
    const size_t accessor = writer().add(matrices, "MAT4", 16);
    GltfJson& skin = json_["skins"][0];
    skin["inverseBindMatrices"] = accessor;
    skin["joints"] = std::move(joints);
  }
  static void append(std::vector<float>& numbers, Vec3d v, float last) {
    const Vec3 f = v.as<float>();
    numbers.insert(numbers.end(), {f.x, f.y, f.z, last});
  }
  static void append(std::vector<float>& numbers, Vec3d v) {
    const Vec3 f = v.as<float>();
    numbers.insert(numbers.end(), {f.x, f.y, f.z});
  }

  // An octahedron from every joint to each of its children and ends, in metres where it rests.
  void add_figure() {
    const Skeleton& skeleton = clip_.skeleton;
    for (size_t j = 0; j < skeleton.joints.size(); ++j) {
      const Joint& joint = skeleton.joints[j];
      if (joint.parent >= 0 && stays(j)) {
        add_stick(static_cast<size_t>(joint.parent), rest_places_[j]);
      }
      for (const Vec3 end : joint.ends) {
        add_stick(j, rest_places_[j] + rotate(rest_turns_[j], end.as<double>()) * scale_);
      }
    }
    if (positions_.empty()) return;
    GltfJson attributes;
    attributes["POSITION"] = add_positions(positions_);
    attributes["NORMAL"] = add_vertex_data(normals_, "VEC3", 3);
    attributes["JOINTS_0"] = add_joint_numbers();
    attributes["WEIGHTS_0"] = add_vertex_data(weights_, "VEC4", 4);
    add_mesh("sticks", {0.85, 0.6, 0.35, 1.0}, {{"attributes", std::move(attributes)}});
  }

  void add_body(const SkinnedBody& body) {
    std::vector<float> matrices;
    GltfJson joints = GltfJson::array();
    for (const SkinnedBody::Bind& bind : body.binds) {
      for (const Vec3 axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
        append(matrices, (rotate(bind.rotation, axis) * bind.scale).as<double>(), 0);
      }
      append(matrices, bind.translation.as<double>(), 1);
      joints.push_back(bind.joint + 1);
    }
    const size_t accessor = writer().add(matrices, "MAT4", 16);
    json_["skins"][0]["inverseBindMatrices"] = accessor;
    json_["skins"][0]["joints"] = std::move(joints);

    std::vector<float> positions, normals;
    for (const Vec3 v : body.positions) positions.insert(positions.end(), {v.x, v.y, v.z});
    for (const Vec3 v : body.normals) normals.insert(normals.end(), {v.x, v.y, v.z});
    GltfJson attributes;
    attributes["POSITION"] = add_positions(positions);
    attributes["NORMAL"] = add_vertex_data(normals, "VEC3", 3);
    attributes["JOINTS_0"] = add_bytes(body.joints, false);
    attributes["WEIGHTS_0"] = add_bytes(body.weights, true);
    attributes["COLOR_0"] = add_bytes(body.colours, true);
    const size_t indices = add_triangles(body.triangles);
    add_mesh("body", {1.0, 1.0, 1.0, 1.0},
             {{"attributes", std::move(attributes)}, {"indices", indices}});
  }

  void add_mesh(const std::string& what, std::initializer_list<double> colour, GltfJson primitive) {
    GltfJson& material = json_["materials"][0];
    material["name"] = what;
    material["pbrMetallicRoughness"] = {
        {"baseColorFactor", colour}, {"metallicFactor", 0.0}, {"roughnessFactor", 0.8}};
    primitive["material"] = 0;
    GltfJson& mesh = json_["meshes"][0];
    mesh["name"] = what;
    mesh["primitives"][0] = std::move(primitive);
    // A skinned mesh stands where its joints are, whatever is above its node.
    json_["scenes"][0]["nodes"].push_back(json_["nodes"].size());
    json_["nodes"].push_back({{"name", name_ + " " + what}, {"mesh", 0}, {"skin", 0}});
  }

  // With the bounds that a file has to say.
  size_t add_positions(const std::vector<float>& positions) {
    const size_t index = add_vertex_data(positions, "VEC3", 3);
    GltfJson& accessor = json_["accessors"][index];
    for (size_t axis = 0; axis < 3; ++axis) {
      float least = positions[axis], most = least;
      for (size_t i = axis; i < positions.size(); i += 3) {
        least = std::min(least, positions[i]);
        most = std::max(most, positions[i]);
      }
      accessor["min"].push_back(least);
      accessor["max"].push_back(most);
    }
    return index;
  }

  size_t add_bytes(std::span<const std::array<uint8_t, 4>> vertices, bool normalized) {
    const size_t begin = bytes_.size();
    for (const auto& vertex : vertices) bytes_.append(vertex.begin(), vertex.end());
    const size_t accessor =
        add_accessor(begin, kUnsignedByte, vertices.size(), "VEC4", kVertexData);
    if (normalized) json_["accessors"][accessor]["normalized"] = true;
    return accessor;
  }

  size_t add_triangles(std::span<const uint16_t> corners) {
    const size_t begin = bytes_.size();
    for (const uint16_t corner : corners) append_short(corner);
    const size_t accessor =
        add_accessor(begin, kUnsignedShort, corners.size(), "SCALAR", kTriangleData);
    bytes_.resize((bytes_.size() + 3) / 4 * 4, '\0');
    return accessor;
  }

  // Whether the joint keeps to its place. A stick to one that wanders off, such as the hips over
  // the ground, would stay behind.
  bool stays(size_t joint) const {
    const Joint& j = clip_.skeleton.joints[joint];
    const float reach = length(j.offset) / 2;
    for (int f = 0; j.can_translate && f < clip_.frames; ++f) {
      if (!(length(clip_.pose(f).translations[joint] - j.offset) <= reach)) return false;
    }
    return true;
  }

  void add_stick(size_t joint, Vec3d tip) {
    const Vec3d base = rest_places_[joint], along = tip - base;
    const double size = length(along);
    // Shorter than a tenth of a millimetre there is nothing to see, and no direction.
    if (!(size > 1e-4)) return;
    const Quatd turn = rotation_between(Vec3d{0, 1, 0}, along / size);
    const auto corner = [&](double x, double z) {
      return base +
             rotate(turn, Vec3d{x * static_cast<double>(kHalfWidth), static_cast<double>(kWaist),
                                z * static_cast<double>(kHalfWidth)}) *
                 size;
    };
    const std::array<Vec3d, 4> waist = {corner(1, 0), corner(0, 1), corner(-1, 0), corner(0, -1)};
    for (size_t i = 0; i < 4; ++i) {
      add_triangle(joint, base, waist[i], waist[(i + 1) % 4]);
      add_triangle(joint, tip, waist[(i + 1) % 4], waist[i]);
    }
  }

  // Counterclockwise as seen from outside.
  void add_triangle(size_t joint, Vec3d a, Vec3d b, Vec3d c) {
    const Vec3d normal = normalized(cross(b - a, c - a), {0, 1, 0});
    for (const Vec3d corner : {a, b, c}) {
      append(positions_, corner);
      append(normals_, normal);
      weights_.insert(weights_.end(), {1, 0, 0, 0});
      joint_numbers_.push_back(joint);
    }
  }

  size_t add_vertex_data(const std::vector<float>& numbers, const char* type, size_t components) {
    const size_t accessor = writer().add(numbers, type, components);
    json_["bufferViews"].back()["target"] = kVertexData;
    return accessor;
  }

  size_t add_joint_numbers() {
    const size_t begin = bytes_.size();
    for (const size_t joint : joint_numbers_) {
      append_short(joint);
      bytes_.append(6, '\0');  // The three joints without weight.
    }
    return add_accessor(begin, kUnsignedShort, joint_numbers_.size(), "VEC4", kVertexData);
  }

  void append_short(size_t number) {
    bytes_ += static_cast<char>(number & 0xff);
    bytes_ += static_cast<char>(number >> 8 & 0xff);
  }

  // An accessor of all bytes from `begin` on, with a view of its own.
  size_t add_accessor(size_t begin, int component, size_t count, const char* type, int target) {
    json_["accessors"].push_back({{"bufferView", json_["bufferViews"].size()},
                                  {"componentType", component},
                                  {"count", count},
                                  {"type", type}});
    json_["bufferViews"].push_back({{"buffer", 0},
                                    {"byteOffset", begin},
                                    {"byteLength", bytes_.size() - begin},
                                    {"target", target}});
    return json_["accessors"].size() - 1;
  }

  void add_animation() {
    GltfDataWriter data = writer();
    std::vector<float> times;
    for (int f = 0; f < clip_.frames; ++f) {
      const float time = static_cast<float>(f * clip_.frame_time);
      times.push_back(f > 0 ? std::max(time, std::nextafter(times.back(), HUGE_VALF)) : time);
    }
    GltfJson channels = GltfJson::array(), samplers = GltfJson::array();
    size_t input = 0;
    const auto add = [&](size_t joint, const char* path, size_t components,
                         const std::vector<float>& numbers) {
      if (samplers.empty()) input = data.add(times, "SCALAR", 1, true);
      channels.push_back(
          {{"sampler", samplers.size()}, {"target", {{"node", joint + 1}, {"path", path}}}});
      samplers.push_back(
          {{"input", input},
           {"interpolation", "LINEAR"},
           {"output", data.add(numbers, components == 3 ? "VEC3" : "VEC4", components)}});
    };
    for (size_t j = 0; j < clip_.joints(); ++j) {
      const Joint& joint = clip_.skeleton.joints[j];
      if (joint.can_translate) add(j, "translation", 3, places_of(j));
      if (joint.can_rotate) add(j, "rotation", 4, turns_of(j));
    }
    if (channels.empty()) return;
    GltfJson& animation = json_["animations"][0];
    animation["name"] = name_;
    animation["channels"] = std::move(channels);
    animation["samplers"] = std::move(samplers);
  }

  std::vector<float> places_of(size_t joint) const {
    std::vector<float> numbers;
    for (int f = 0; f < clip_.frames; ++f) {
      const Vec3 t = clip_.pose(f).translations[joint];
      numbers.insert(numbers.end(), {t.x, t.y, t.z});
    }
    return numbers;
  }

  std::vector<float> turns_of(size_t joint) const {
    std::vector<float> numbers;
    Quat before;
    for (int f = 0; f < clip_.frames; ++f) {
      Quat q = clip_.pose(f).rotations[joint];
      // Of the two quaternions of a rotation the one on the side of the frame before.
      if (f > 0 && dot(q, before) < 0) q = {-q.x, -q.y, -q.z, -q.w};
      numbers.insert(numbers.end(), {q.x, q.y, q.z, q.w});
      before = q;
    }
    return numbers;
  }

  const Clip& clip_;
  const std::string& name_;
  double scale_;
  Quatd turn_;
  std::vector<Quatd> rest_turns_;                     // [joints] in the world
  std::vector<Vec3d> rest_places_;                    // [joints] in the world, metres
  std::vector<float> positions_, normals_, weights_;  // [corners of triangles][3, 3, 4]
  std::vector<size_t> joint_numbers_;                 // [corners of triangles]
  GltfJson json_;
  std::string bytes_;
};

}  // namespace

std::string format_glb(const Clip& clip, const std::string& clip_name, double metres_per_unit,
                       Quat to_y_up, const SkinnedBody* body) {
  return GlbFormatter(clip, clip_name, metres_per_unit, to_y_up).format(body);
}

std::string format_vrma(const Clip& clip, const std::string& clip_name) {
  return GlbFormatter(clip, clip_name, 1, {}).format_vrma();
}

}  // namespace panache
