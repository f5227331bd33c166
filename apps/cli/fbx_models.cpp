#include "fbx_models.h"

#include <algorithm>

#include "base/utf8.h"
#include "clip/unique_name.h"

namespace panache::cli {
namespace {

constexpr size_t kMostModels = 10'000, kMaxParents = 500, kLongestName = 200;

Vec3d product(Vec3d a, Vec3d b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }

// By FBX number; R = R(axis[0]) R(axis[1]) R(axis[2]). The last is "spheric" rotation, which
// programs treat as XYZ.
constexpr EulerOrder kOrders[] = {{3, {2, 1, 0}}, {3, {1, 2, 0}}, {3, {0, 2, 1}}, {3, {2, 0, 1}},
                                  {3, {1, 0, 2}}, {3, {0, 1, 2}}, {3, {2, 1, 0}}};

Quatd turned(const EulerOrder& order, Vec3d degrees) {
  const double of[] = {degrees.x, degrees.y, degrees.z};
  const auto& axis = order.axis;
  return euler_to_quat(order, {of[axis[0]], of[axis[1]], of[axis[2]]});
}

// Frames per second, by time mode.
constexpr double kRates[] = {30,         120, 100, 60,   50,         48, 30, 30, 30 / 1.001,
                             30 / 1.001, 25,  24,  1000, 24 / 1.001, 0,  96, 72, 60 / 1.001};
constexpr size_t kCustomRate = 14;

// Reads numeric properties from the object, or else from the template for its type.
class Properties {
 public:
  Properties(const FbxDocument& document, const FbxNode& object, const FbxNode* fallback)
      : document_(document), object_(object), fallback_(fallback) {}

  // Keeps `out` if the property is missing; false if it is not a number.
  bool read(std::string_view name, double& out) {
    return read(name, 1, [&](const double* v) { out = v[0]; });
  }
  bool read(std::string_view name, int& out) {
    return read(name, 1, [&](const double* v) { out = static_cast<int>(v[0]); });
  }
  bool read(std::string_view name, Vec3d& out) {
    return read(name, 3, [&](const double* v) { out = {v[0], v[1], v[2]}; });
  }
  const Error& error() const { return error_; }

 private:
  template <class Use>
  bool read(std::string_view name, size_t count, Use use) {
    std::vector<std::string_view> values = fbx_property(object_, name);
    if (values.empty() && fallback_) values = fbx_property(*fallback_, name);
    if (values.empty()) return true;
    double numbers[3] = {};
    for (size_t i = 0; i < count; ++i) {
      Result<double> number =
          document_.number(i < values.size() ? values[i] : "", "'" + std::string(name) + "'");
      if (!number) {
        error_ = number.error();
        return false;
      }
      numbers[i] = *number;
    }
    use(numbers);
    return true;
  }

  const FbxDocument& document_;
  const FbxNode& object_;
  const FbxNode* fallback_;
  Error error_;
};

// Defaults that FBX 7 states once for all models.
const FbxNode* model_template(const FbxDocument& document) {
  for (const FbxNode* type : document.in_sections("Definitions")) {
    if (type->name == "ObjectType" && type->value(0) == "Model") {
      return type->child("PropertyTemplate");
    }
  }
  return nullptr;
}

Result<FbxModel> read_model(const FbxDocument& document, const FbxNode& node,
                            const FbxNode* fallback) {
  FbxModel out;
  // A number (FBX 7) or the name (FBX 6).
  out.id = node.value(0);
  out.name = fbx_name(fbx_without_class(node.value(node.values.size() > 2 ? 1 : 0)));
  Properties properties(document, node, fallback);
  int is_active = 0, order = 0;
  Vec3d before, after;
  const bool good =
      properties.read("Lcl Translation", out.place.translation) &&
      properties.read("Lcl Rotation", out.place.rotation) &&
      properties.read("Lcl Scaling", out.place.scale) &&
      properties.read("RotationOffset", out.rotation_offset) &&
      properties.read("RotationPivot", out.rotation_pivot) &&
      properties.read("ScalingOffset", out.scale_offset) &&
      properties.read("ScalingPivot", out.scale_pivot) &&
      properties.read("RotationActive", is_active) && properties.read("RotationOrder", order) &&
      properties.read("PreRotation", before) && properties.read("PostRotation", after);
  if (!good) return properties.error();
  if (is_active) {
    out.order = kOrders[std::clamp<int>(order, 0, std::size(kOrders) - 1)];
    out.before = turned(kOrders[0], before);
    out.after = conjugate(turned(kOrders[0], after));
  }
  return out;
}

bool is_left_out(std::string_view type) {
  return type == "Camera" || type == "CameraSwitcher" || type == "Light";
}

}  // namespace

Trs FbxModel::trs(const FbxPlace& at) const {
  const Quatd rotation = normalized(before * turned(order, at.rotation) * after);
  const Vec3d below = scale_offset - rotation_pivot + scale_pivot - product(at.scale, scale_pivot);
  return {at.translation + rotation_offset + rotation_pivot + rotate(rotation, below), rotation,
          at.scale};
}

std::string_view fbx_without_class(std::string_view text) {
  const size_t colons = text.find("::");
  return colons == text.npos ? text : text.substr(colons + 2);
}

std::string fbx_name(std::string_view text) { return to_utf8(text.substr(0, kLongestName)); }

std::vector<std::string_view> fbx_property(const FbxNode& object, std::string_view name) {
  for (const auto& [list, item, skipped] :
       {std::tuple("Properties70", "P", 4), std::tuple("Properties60", "Property", 3)}) {
    const FbxNode* properties = object.child(list);
    if (!properties) continue;
    for (const FbxNode& property : properties->children) {
      if (property.name != item || property.value(0) != name) continue;
      const auto& values = property.values;
      return {values.begin() + std::min<std::ptrdiff_t>(skipped, std::ssize(values)), values.end()};
    }
  }
  return {};
}

std::vector<FbxConnection> fbx_connections(const FbxDocument& document) {
  std::vector<FbxConnection> out;
  for (const FbxNode* node : document.in_sections("Connections")) {
    if (node->name != "C" && node->name != "Connect") continue;
    out.push_back({node->value(1), node->value(2), node->value(3)});
  }
  return out;
}

Result<FbxSettings> fbx_settings(const FbxDocument& document) {
  FbxSettings out;
  const FbxNode& root = document.root();
  const FbxNode* objects = root.child("Objects");
  const FbxNode* global = root.child("GlobalSettings");
  if (!global && objects) global = objects->child("GlobalSettings");  // FBX 6.
  int mode = -1;
  double custom = 0;
  if (global) {
    Properties properties(document, *global, nullptr);
    const bool good =
        properties.read("UpAxis", out.up_axis) && properties.read("UpAxisSign", out.up_sign) &&
        properties.read("CoordAxis", out.side_axis) &&
        properties.read("CoordAxisSign", out.side_sign) &&
        properties.read("UnitScaleFactor", out.centimetres) && properties.read("TimeMode", mode) &&
        properties.read("CustomFrameRate", custom);
    if (!good) return properties.error();
  }
  const FbxNode* version5 = root.child("Version5");
  const FbxNode* settings = version5 ? version5->child("Settings") : nullptr;
  const FbxNode* rate = settings ? settings->child("FrameRate") : nullptr;
  if (mode >= 0 && mode < std::ssize(kRates)) {
    out.rate = mode == kCustomRate ? custom : kRates[mode];
  } else if (rate) {
    Result<double> number = document.number(rate->value(0), "the frame rate");
    if (!number) return number.error();
    out.rate = *number;
  }
  if (!(out.rate >= 1 && out.rate <= 1000)) out.rate = 30;
  return out;
}

Result<std::vector<FbxModel>> fbx_models(const FbxDocument& document) {
  const FbxNode* fallback = model_template(document);
  std::vector<FbxModel> found;
  std::vector<bool> is_needed;
  std::map<std::string_view, size_t> places;  // Index by id.
  for (const FbxNode* node : document.in_sections("Objects")) {
    if (node->name != "Model" || !places.emplace(node->value(0), found.size()).second) continue;
    if (found.size() == kMostModels) {
      return document.error(node->name, "at most " + std::to_string(kMostModels) + " models");
    }
    Result<FbxModel> model = read_model(document, *node, fallback);
    if (!model) return model.error();
    found.push_back(*std::move(model));
    is_needed.push_back(!is_left_out(node->values.empty() ? "" : node->values.back()));
  }
  std::vector<std::vector<size_t>> children(found.size());
  for (const FbxConnection& connection : fbx_connections(document)) {
    const auto child = places.find(connection.child), parent = places.find(connection.parent);
    if (child == places.end() || parent == places.end()) continue;
    if (!connection.property.empty() || found[child->second].parent >= 0) continue;
    found[child->second].parent = static_cast<int>(parent->second);
    children[parent->second].push_back(child->second);
  }
  // Breadth-first from the roots.
  std::vector<FbxModel> out;
  TakenNames taken;
  std::vector<std::pair<size_t, int>> level;  // Index in `found`, and the parent's index in `out`.
  for (size_t i = 0; i < found.size(); ++i) {
    if (found[i].parent < 0) level.emplace_back(i, -1);
  }
  size_t reached = 0;
  for (size_t depth = 0; !level.empty(); ++depth) {
    if (depth > kMaxParents) {
      return document.error(found[level[0].first].id,
                            "at most " + std::to_string(kMaxParents) + " models below each other");
    }
    std::vector<std::pair<size_t, int>> next;
    for (const auto& [i, parent] : level) {
      ++reached;
      if (!is_needed[i] && children[i].empty()) continue;
      out.push_back(found[i]);
      out.back().parent = parent;
      out.back().name = unique_name(found[i].name, taken);
      for (const size_t child : children[i])
        next.emplace_back(child, static_cast<int>(out.size()) - 1);
    }
    level = std::move(next);
  }
  if (reached < found.size()) {
    return Error{document.name() + ": expected models that hang on the scene, found " +
                 std::to_string(found.size() - reached) + " that hang on each other in a circle"};
  }
  return out;
}

}  // namespace panache::cli
