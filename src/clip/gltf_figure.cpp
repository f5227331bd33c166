#include "clip/gltf_encode.h"

#include <algorithm>
#include <initializer_list>

#include "base/bytes.h"

namespace panache {
namespace {

constexpr int kUnsignedByte = 5121, kUnsignedShort = 5123;
constexpr int kVertexData = 34962, kTriangleData = 34963;
// Position and half width of an octahedron's widest point, relative to the length of its stick.
constexpr double kWaist = 0.2, kHalfWidth = 0.08;

void append(std::vector<float>& numbers, Vec3d v) {
  const Vec3 f = v.as<float>();
  numbers.insert(numbers.end(), {f.x, f.y, f.z});
}

// Appends to a list and returns the index. New members move the others: references to them do not
// survive an addition.
size_t push(GltfJson& json, const char* list, GltfJson element) {
  json[list].push_back(std::move(element));
  return json[list].size() - 1;
}

class FigureWriter {
 public:
  FigureWriter(GltfPosition added_at, GltfJson& json, std::string& bytes,
               std::span<const FigureJoint> joints, const std::string& name)
      : added_at_(added_at), json_(json), bytes_(bytes), joints_(joints), name_(name) {}

  void add_sticks() {
    std::vector<size_t> order;
    std::vector<Affine> inverse_binds;
    for (size_t j = 0; j < joints_.size(); ++j) {
      const FigureJoint& joint = joints_[j];
      order.push_back(j);
      inverse_binds.push_back(inverse(joint.world));
      if (joint.parent >= 0 && !joint.wanders) {
        add_stick(joint.parent, joint.world.origin);
      }
    }
    const size_t skin = add_skin(order, inverse_binds);
    if (positions_.empty()) return;
    GltfJson attributes;
    attributes["POSITION"] = add_positions(positions_);
    attributes["NORMAL"] = add_vertex_data(normals_, "VEC3", 3);
    attributes["JOINTS_0"] = add_joint_numbers();
    attributes["WEIGHTS_0"] = add_vertex_data(weights_, "VEC4", 4);
    add_mesh("sticks", {0.85, 0.6, 0.35, 1.0}, skin, {{"attributes", std::move(attributes)}});
  }

  void add_body(const SkinnedBody& body) {
    // The joints of the mesh come first, so that vertices can keep the body's indices.
    std::vector<size_t> order;
    std::vector<char> bound(joints_.size());
    std::vector<Affine> inverse_binds(joints_.size()), binds(joints_.size());
    for (const SkinnedBody::Bind& bind : body.binds) {
      const auto found =
          std::find_if(joints_.begin(), joints_.end(), [&](const FigureJoint& joint) {
            return joint.clip_joint == static_cast<int>(bind.joint);
          });
      const size_t j = found - joints_.begin();
      const double s = bind.scale;
      order.push_back(j);
      bound[j] = 1;
      inverse_binds[j] = inverse(found->stretch) * affine(bind.rotation.as<double>(),
                                                          bind.translation.as<double>(), {s, s, s});
    }
    for (size_t j = 0; j < joints_.size(); ++j) {
      if (bound[j]) {
        binds[j] = inverse(inverse_binds[j]);
        continue;
      }
      const int parent = joints_[j].parent;
      binds[j] = parent < 0 ? joints_[j].world : binds[parent] * joints_[j].local;
      inverse_binds[j] = inverse(binds[j]);
      order.push_back(j);
    }
    const size_t skin = add_skin(order, inverse_binds);

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
    add_mesh("body", {1.0, 1.0, 1.0, 1.0}, skin,
             {{"attributes", std::move(attributes)}, {"indices", indices}});
  }

 private:
  GltfDataWriter writer() { return {added_at_, json_, bytes_}; }

  // Adds a skin with the joints in `order` and their inverse bind matrices; returns its index.
  size_t add_skin(std::span<const size_t> order, std::span<const Affine> inverse_binds) {
    std::vector<float> matrices;  // [joints][16], column-major.
    GltfJson joints = GltfJson::array();
    for (const size_t j : order) {
      append_matrix(matrices, inverse_binds[j]);
      joints.push_back(joints_[j].node);
    }
    const size_t accessor = writer().add(matrices, "MAT4", 16);
    return push(json_, "skins", {{"inverseBindMatrices", accessor}, {"joints", std::move(joints)}});
  }

  void add_mesh(const std::string& what, std::initializer_list<double> colour, size_t skin,
                GltfJson primitive) {
    primitive["material"] =
        push(json_, "materials",
             {{"name", what},
              {"pbrMetallicRoughness",
               {{"baseColorFactor", colour}, {"metallicFactor", 0.0}, {"roughnessFactor", 0.8}}}});
    GltfJson mesh = {{"name", what}};
    mesh["primitives"].push_back(std::move(primitive));
    const size_t index = push(json_, "meshes", std::move(mesh));
    const size_t node =
        push(json_, "nodes", {{"name", name_ + " " + what}, {"mesh", index}, {"skin", skin}});
    // A skinned mesh follows its joints, whatever is above its node.
    const size_t scene = json_.value("scene", size_t{0});
    json_["scenes"][scene]["nodes"].push_back(node);
  }

  // With the bounds that the format requires.
  size_t add_positions(const std::vector<float>& positions) {
    const size_t index = add_vertex_data(positions, "VEC3", 3);
    GltfJson& accessor = json_["accessors"][index];
    for (size_t axis = 0; axis < 3; ++axis) {
      float min = positions[axis], max = min;
      for (size_t i = axis; i < positions.size(); i += 3) {
        min = std::min(min, positions[i]);
        max = std::max(max, positions[i]);
      }
      accessor["min"].push_back(min);
      accessor["max"].push_back(max);
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
    for (const uint16_t corner : corners) append_little_endian(corner, 2, bytes_);
    const size_t accessor =
        add_accessor(begin, kUnsignedShort, corners.size(), "SCALAR", kTriangleData);
    bytes_.resize((bytes_.size() + 3) / 4 * 4, '\0');
    return accessor;
  }

  void add_stick(size_t joint, Vec3d tip) {
    const Vec3d base = joints_[joint].world.origin, along = tip - base;
    const double size = length(along);
    // A stick shorter than a tenth of a millimetre is invisible and has no direction.
    if (!(size > 1e-4)) return;
    const Quatd turn = rotation_between(Vec3d{0, 1, 0}, along / size);
    const auto corner = [&](double x, double z) {
      return base + rotate(turn, Vec3d{x * kHalfWidth, kWaist, z * kHalfWidth}) * size;
    };
    const std::array<Vec3d, 4> waist = {corner(1, 0), corner(0, 1), corner(-1, 0), corner(0, -1)};
    for (size_t i = 0; i < 4; ++i) {
      add_triangle(joint, base, waist[i], waist[(i + 1) % 4]);
      add_triangle(joint, tip, waist[(i + 1) % 4], waist[i]);
    }
  }

  // Counterclockwise seen from outside.
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
      append_little_endian(joint, 8, bytes_);  // And three joints without weight.
    }
    return add_accessor(begin, kUnsignedShort, joint_numbers_.size(), "VEC4", kVertexData);
  }

  // Adds an accessor of all bytes from `begin` on, with its own view.
  size_t add_accessor(size_t begin, int component, size_t count, const char* type, int target) {
    const size_t view = push(json_, "bufferViews",
                             {{"buffer", added_at_.buffer},
                              {"byteOffset", added_at_.offset + begin},
                              {"byteLength", bytes_.size() - begin},
                              {"target", target}});
    return push(
        json_, "accessors",
        {{"bufferView", view}, {"componentType", component}, {"count", count}, {"type", type}});
  }

  GltfPosition added_at_;
  GltfJson& json_;
  std::string& bytes_;
  std::span<const FigureJoint> joints_;
  const std::string& name_;
  std::vector<float> positions_, normals_, weights_;  // [corners of triangles][3, 3, 4]
  std::vector<size_t> joint_numbers_;                 // [corners of triangles]
};

}  // namespace

void append_matrix(std::vector<float>& numbers, const Affine& matrix) {
  for (const Vec3d column : matrix.columns) {
    append(numbers, column);
    numbers.push_back(0);
  }
  append(numbers, matrix.origin);
  numbers.push_back(1);
}

void add_figure(GltfPosition added_at, GltfJson& json, std::string& bytes,
                std::span<const FigureJoint> joints, const std::string& name,
                const SkinnedBody* body) {
  FigureWriter writer(added_at, json, bytes, joints, name);
  if (body) {
    writer.add_body(*body);
  } else {
    writer.add_sticks();
  }
}

bool wanders(const Clip& clip, size_t joint) {
  const Joint& j = clip.skeleton.joints[joint];
  const float reach = length(j.offset) / 2;
  for (int f = 0; j.can_translate && f < clip.frames; ++f) {
    if (!(length(clip.pose(f).translations[joint] - j.offset) <= reach)) return true;
  }
  return false;
}

}  // namespace panache
