#include <algorithm>
#include <cmath>
#include <span>
#include <tuple>
#include <utility>

#include "base/text.h"
#include "clip/fbx_document.h"
#include "clip/motion_file.h"

namespace panache {
namespace {

Vec3d product(Vec3d a, Vec3d b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }

// By FBX number; R = R(axis[0]) R(axis[1]) R(axis[2]). The last is "spheric" rotation, which
// programs treat as XYZ.
constexpr EulerOrder kFbxOrders[] = {{3, {2, 1, 0}}, {3, {1, 2, 0}}, {3, {0, 2, 1}}, {3, {2, 0, 1}},
                                     {3, {1, 0, 2}}, {3, {0, 1, 2}}, {3, {2, 1, 0}}};

Quatd turned(const EulerOrder& order, Vec3d degrees) {
  const auto& axis = order.axis;
  return euler_to_quat(order, {degrees[axis[0]], degrees[axis[1]], degrees[axis[2]]});
}

// Frames per second, by time mode.
constexpr double kFbxRates[] = {30,         120, 100, 60,   50,         48, 30, 30, 30 / 1.001,
                                30 / 1.001, 25,  24,  1000, 24 / 1.001, 0,  96, 72, 60 / 1.001};
constexpr size_t kCustomRate = 14;

// Reads numeric properties from an object, or else from the template for its type.
class FbxProperties {
 public:
  FbxProperties(const FbxTree& tree, const FbxNode& object, const FbxNode* fallback)
      : tree_(tree), object_(object), fallback_(fallback) {}

  void read(std::string_view name, double& out) { read(name, std::span(&out, 1)); }
  void read(std::string_view name, int& out) {
    double number = out;
    read(name, number);
    out = static_cast<int>(number);
  }
  void read(std::string_view name, Vec3d& out) {
    double numbers[] = {out.x, out.y, out.z};
    read(name, std::span<double>(numbers));
    out = {numbers[0], numbers[1], numbers[2]};
  }
  // The first error.
  const Result<void>& result() const { return result_; }

 private:
  void read(std::string_view name, std::span<double> out) {
    if (!result_) return;
    if (fallback_ && !find_fbx_property(object_, name).node) {
      result_ = read_fbx_property(tree_, *fallback_, name, out);
    } else {
      result_ = read_fbx_property(tree_, object_, name, out);
    }
  }

  const FbxTree& tree_;
  const FbxNode& object_;
  const FbxNode* fallback_;
  Result<void> result_;
};

// Defaults that FBX 7 states once for all models.
const FbxNode* model_template(const FbxTree& tree) {
  for (const FbxNode* type : tree.in_sections("Definitions")) {
    if (type->name == "ObjectType" && tree.text(*type, 0) == "Model") {
      return type->child("PropertyTemplate");
    }
  }
  return nullptr;
}

Result<FbxModel> read_model(const FbxTree& tree, const FbxNode& node, const FbxNode* fallback) {
  FbxModel out;
  out.node = &node;
  out.id = tree.text(node, 0);
  const bool has_number = node.values.size() > 2;  // FBX 7; the name is the ID in FBX 6.
  out.file_name = fbx_name(fbx_without_class(tree.text(node, has_number ? 1 : 0)));
  if (!node.values.empty()) out.kind = tree.text(node, node.values.size() - 1);
  FbxProperties properties(tree, node, fallback);
  // Programs state these three. Where a file does not, its numbers count, as in a product of
  // matrices.
  int is_active = 1, order = 0, inherit = 1;
  Vec3d before, after, geometric;
  auto& [translation, rotation, scale] = out.channels.parts;
  properties.read("Lcl Translation", translation);
  properties.read("Lcl Rotation", rotation);
  properties.read("Lcl Scaling", scale);
  properties.read("RotationOffset", out.rotation_offset);
  properties.read("RotationPivot", out.rotation_pivot);
  properties.read("ScalingOffset", out.scale_offset);
  properties.read("ScalingPivot", out.scale_pivot);
  properties.read("RotationActive", is_active);
  properties.read("RotationOrder", order);
  properties.read("PreRotation", before);
  properties.read("PostRotation", after);
  properties.read("InheritType", inherit);
  properties.read("GeometricTranslation", out.geometry.translation);
  properties.read("GeometricRotation", geometric);
  properties.read("GeometricScaling", out.geometry.scale);
  if (!properties.result()) return properties.result().error();
  if (is_active) {
    out.order = kFbxOrders[std::clamp<int>(order, 0, std::size(kFbxOrders) - 1)];
    out.before = turned(kFbxOrders[0], before);
    out.after = conjugate(turned(kFbxOrders[0], after));
  }
  using enum FbxModel::Inherit;
  out.inherit = inherit == 0 ? RrSs : inherit == 2 ? Rrs : RSrs;
  out.geometry.rotation = turned(kFbxOrders[0], geometric);
  return out;
}

Result<void> read_settings(FbxDocument& document) {
  const FbxTree& tree = document.tree;
  FbxSettings& out = document.settings;
  const FbxNode *objects = tree.root().child("Objects"),
                *global = tree.root().child("GlobalSettings");
  if (!global && objects) global = objects->child("GlobalSettings");  // FBX 6.
  out.node = global;
  int mode = -1;
  double custom = 0;
  if (global) {
    FbxProperties properties(tree, *global, nullptr);
    properties.read("UpAxis", out.up_axis);
    properties.read("UpAxisSign", out.up_sign);
    properties.read("CoordAxis", out.side_axis);
    properties.read("CoordAxisSign", out.side_sign);
    properties.read("UnitScaleFactor", out.centimetres);
    properties.read("TimeMode", mode);
    properties.read("CustomFrameRate", custom);
    if (!properties.result()) return properties.result();
  }
  if (!(out.centimetres > 1e-6 && out.centimetres < 1e6)) out.centimetres = 1;
  const FbxNode* version5 = tree.root().child("Version5");
  const FbxNode* settings = version5 ? version5->child("Settings") : nullptr;
  const FbxNode* rate = settings ? settings->child("FrameRate") : nullptr;
  if (mode >= 0 && mode < std::ssize(kFbxRates)) {
    out.rate = mode == kCustomRate ? custom : kFbxRates[mode];
  } else if (rate) {
    tree.number(*rate, 0, out.rate);
  }
  if (!(out.rate >= 1 && out.rate <= 1000)) out.rate = 30;
  return {};
}

class FbxModelsReader {
 public:
  explicit FbxModelsReader(FbxDocument& document) : document_(document), tree_(document.tree) {}

  Result<void> read() {
    if (auto good = find(); !good) return good;
    connect();
    return order();
  }

 private:
  Result<void> find() {
    const FbxNode* fallback = model_template(tree_);
    for (const FbxNode* node : tree_.in_sections("Objects")) {
      if (node->name == "Geometry") document_.has_meshes = true;
      if (node->name != "Model") continue;
      if (!indices_.emplace(tree_.text(*node, 0), found_.size()).second) continue;
      if (found_.size() == kFbxMaxModels) {
        return tree_.error(*node, "at most " + std::to_string(kFbxMaxModels) + " models", "more");
      }
      Result<FbxModel> model = read_model(tree_, *node, fallback);
      if (!model) return model.error();
      // In FBX 6 a model holds its mesh itself.
      if (node->child("Vertices")) document_.has_meshes = true;
      found_.push_back(*std::move(model));
    }
    return {};
  }

  void connect() {
    children_.resize(found_.size());
    for (const FbxConnection& connection : document_.connections) {
      const auto child = indices_.find(connection.child), parent = indices_.find(connection.parent);
      if (child == indices_.end() || parent == indices_.end()) continue;
      if (!connection.property.empty() || found_[child->second].parent >= 0) continue;
      found_[child->second].parent = static_cast<int>(parent->second);
      children_[parent->second].push_back(child->second);
    }
  }

  // Depth-first, children in the order of their connections; without recursion, because the file
  // determines the depth.
  Result<void> order() {
    struct Visit {
      size_t model;
      int parent;
      size_t depth;
    };
    TakenNames taken;
    std::vector<Visit> waiting;
    for (size_t i = found_.size(); i-- > 0;) {
      if (found_[i].parent < 0) waiting.push_back({i, -1, 0});
    }
    size_t reached = 0;
    while (!waiting.empty()) {
      const auto [i, parent, depth] = waiting.back();
      waiting.pop_back();
      ++reached;
      if (depth > kFbxMaxParents) {
        return tree_.error(*found_[i].node,
                           "at most " + std::to_string(kFbxMaxParents) + " models below each other",
                           "more");
      }
      if (found_[i].is_camera_or_light() && children_[i].empty()) continue;
      FbxModel& model = document_.models.emplace_back(found_[i]);
      model.parent = parent;
      model.name = unique_name(model.file_name, taken);
      const int own = static_cast<int>(document_.models.size()) - 1;
      for (size_t c = children_[i].size(); c-- > 0;) {
        waiting.push_back({children_[i][c], own, depth + 1});
      }
    }
    if (reached == found_.size()) return {};
    return Error{tree_.name() + ": expected models that hang on the scene, found " +
                 std::to_string(found_.size() - reached) + " that hang on each other in a circle"};
  }

  FbxDocument& document_;
  const FbxTree& tree_;
  std::vector<FbxModel> found_;
  std::vector<std::vector<size_t>> children_;  // [found]
  std::map<std::string, size_t> indices_;      // By ID.
};

}  // namespace

Quatd FbxSettings::to_y_up() const {
  const auto axis = [](int which, int sign) {
    const double s = sign < 0 ? -1 : 1;
    return which == 0 ? Vec3d{s, 0, 0} : which == 2 ? Vec3d{0, 0, s} : Vec3d{0, s, 0};
  };
  const Vec3d up = axis(std::clamp(up_axis, 0, 2), up_sign);
  Vec3d side = axis(std::clamp(side_axis, 0, 2), side_sign);
  // The settings contradict each other.
  if (std::abs(dot(side, up)) > 0) side = {up.y, up.z, up.x};
  return conjugate(from_axes(side, up, cross(side, up)));
}

bool FbxModel::is_camera_or_light() const {
  return kind == "Camera" || kind == "CameraSwitcher" || kind == "Light";
}

FbxLocal FbxModel::local(const FbxChannels& at) const {
  const auto& [translation, rotation, scale] = at.parts;
  const Quatd turn = rotation_of(rotation);
  return {translation + pivot_shift(turn, scale), turn, scale};
}

Vec3d FbxModel::pivot_shift(Quatd rotation, Vec3d scale) const {
  return rotation_offset + rotation_pivot + rotate(rotation, below_rotation(scale));
}

Vec3d FbxModel::below_rotation(Vec3d scale) const {
  return scale_offset - rotation_pivot + scale_pivot - product(scale, scale_pivot);
}

Quatd FbxModel::rotation_of(Vec3d degrees) const {
  return normalized(before * turned(order, degrees) * after);
}

Vec3d FbxModel::angles_of(Quatd rotation, Vec3d near) const {
  const auto& axis = order.axis;
  const EulerAngles angles = quat_to_euler(order, conjugate(before) * rotation * conjugate(after),
                                           {near[axis[0]], near[axis[1]], near[axis[2]]});
  Vec3d out;
  for (size_t i = 0; i < 3; ++i) out[axis[i]] = angles[i];
  return out;
}

std::string fbx_without_class(const std::string& text) {
  const size_t colons = text.find("::");
  return colons == text.npos ? text : text.substr(colons + 2);
}

std::string fbx_name(const std::string& text) { return to_utf8(text.substr(0, kFbxMaxNameBytes)); }

FbxProperty find_fbx_property(const FbxNode& object, std::string_view name) {
  for (const auto& [list, item, first] :
       {std::tuple("Properties70", "P", 4), std::tuple("Properties60", "Property", 3)}) {
    const FbxNode* properties = object.child(list);
    if (!properties) continue;
    for (const FbxNode& property : properties->children) {
      if (property.name != item || property.values.empty()) continue;
      if (property.values[0].bytes == name) return {&property, static_cast<size_t>(first)};
    }
  }
  return {};
}

Result<void> read_fbx_property(const FbxTree& tree, const FbxNode& object, std::string_view name,
                               std::span<double> out) {
  const FbxProperty property = find_fbx_property(object, name);
  if (!property.node) return {};
  std::vector<double> numbers(out.size());
  for (size_t i = 0; i < out.size(); ++i) {
    if (tree.number(*property.node, property.first + i, numbers[i])) continue;
    // Some programs leave the value of a property out.
    if (property.node->values.size() <= property.first) return {};
    return tree.error(*property.node, property.first + i,
                      "a number between -1e9 and 1e9 for '" + std::string(name) + "'");
  }
  std::copy(numbers.begin(), numbers.end(), out.begin());
  return {};
}

Result<void> read_fbx_models(FbxDocument& document) {
  const FbxTree& tree = document.tree;
  if (tree.version() > 0 && tree.version() < 6000) {
    return Error{tree.name() + ": expected FBX 6 or 7, found version " +
                 std::to_string(tree.version()) + "; Autodesk's FBX Converter makes FBX 7 of it"};
  }
  if (auto good = read_settings(document); !good) return good;
  for (const FbxNode* node : tree.in_sections("Connections")) {
    if (node->name != "C" && node->name != "Connect") continue;
    document.connections.push_back(
        {tree.text(*node, 1), tree.text(*node, 2), tree.text(*node, 3), node});
  }
  if (auto good = FbxModelsReader(document).read(); !good) return good;
  read_fbx_bind(document);
  return {};
}

}  // namespace panache
