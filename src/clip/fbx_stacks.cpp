// The animation of FBX 7: curves belong to curve nodes, curve nodes to layers and to properties,
// layers to stacks. All of this is said by connections, in any order.

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "clip/fbx_document.h"
#include "clip/motion_file.h"

namespace panache {
namespace {

constexpr char kFbxAxes[] = "XYZ";

Vec3d scaled_power(Vec3d v, double power) {
  const auto one = [&](double x) { return x < 0 ? 1 + (x - 1) * power : std::pow(x, power); };
  return {one(v.x), one(v.y), one(v.z)};
}

Quatd nlerp_far(Quatd a, Quatd b, double t) {
  return normalized(a * exp_rotation(log_rotation(conjugate(a) * b) * t));
}

class FbxStacksReader {
 public:
  explicit FbxStacksReader(FbxDocument& document) : document_(document), tree_(document.tree) {
    for (size_t m = 0; m < document.models.size(); ++m) models_.emplace(document.models[m].id, m);
  }

  Result<void> read() {
    std::vector<const FbxNode*> stacks;
    for (const FbxNode* node : tree_.in_sections("Objects")) {
      if (!node->name.starts_with("Animation")) continue;
      if (!objects_.emplace(tree_.text(*node, 0), node).second) continue;
      if (node->name == "AnimationStack") stacks.push_back(node);
    }
    if (stacks.size() > kFbxMaxStacks) {
      return tree_.error(*stacks[kFbxMaxStacks],
                         "at most " + std::to_string(kFbxMaxStacks) + " animation stacks", "more");
    }
    for (const FbxConnection& connection : document_.connections) {
      if (!objects_.contains(connection.child)) continue;
      below_[connection.parent].push_back(&connection);
      above_[connection.child].push_back(&connection);
    }
    for (const FbxNode* node : stacks) {
      FbxStack stack;
      stack.node = node;
      stack.id = tree_.text(*node, 0);
      stack.name = fbx_name(fbx_without_class(tree_.text(*node, 1)));
      if (auto good = read_layers(stack); !good) return good;
      document_.stacks.push_back(std::move(stack));
    }
    return {};
  }

 private:
  const FbxNode* object(const std::string& id, std::string_view kind) const {
    const auto found = objects_.find(id);
    return found != objects_.end() && found->second->name == kind ? found->second : nullptr;
  }

  Result<void> read_layers(FbxStack& stack) {
    std::vector<const FbxNode*> layers;
    for (const FbxConnection* connection : below_[stack.id]) {
      const FbxNode* layer = object(connection->child, "AnimationLayer");
      if (layer && !std::count(layers.begin(), layers.end(), layer)) layers.push_back(layer);
    }
    // Programs connect the base layer first. Where another one comes before it, the connections
    // have lost their order, and that of the objects counts.
    const auto base = std::find_if(layers.begin(), layers.end(),
                                   [&](const FbxNode* layer) { return is_base(*layer); });
    if (base != layers.end() && base != layers.begin()) {
      std::rotate(layers.begin(), base, base + 1);
      std::sort(layers.begin() + 1, layers.end(),
                [](const FbxNode* a, const FbxNode* b) { return a->begin < b->begin; });
    }
    for (const FbxNode* node : layers) {
      FbxLayer& layer = stack.layers.emplace_back();
      layer.node = node;
      layer.id = tree_.text(*node, 0);
      if (auto good = read_layer(layer); !good) return good;
    }
    return {};
  }

  // "Base", "BaseLayer", "Base Animation".
  bool is_base(const FbxNode& layer) const {
    return lower_case(fbx_without_class(tree_.text(layer, 1))).starts_with("base");
  }

  Result<void> read_layer(FbxLayer& layer) {
    double weight = 100, blend = 0, muted = 0, solo = 0, scales = 0;
    // Where the file does not say how rotations add up, their angles do.
    double rotations = 1;
    for (const auto& [name, number] :
         {std::pair("Weight", &weight), std::pair("BlendMode", &blend), std::pair("Mute", &muted),
          std::pair("Solo", &solo), std::pair("RotationAccumulationMode", &rotations),
          std::pair("ScaleAccumulationMode", &scales)}) {
      const FbxNode* const from =
          find_fbx_property(*layer.node, name).node ? layer.node : layer_template();
      if (!from) continue;
      if (auto good = read_fbx_property(tree_, *from, name, std::span(number, 1)); !good)
        return good;
    }
    layer.weight = weight / 100;
    layer.blend = blend == 0 ? FbxLayer::Blend::add : FbxLayer::Blend::replace;
    layer.is_muted = muted != 0;
    layer.is_solo = solo != 0;
    layer.adds_angles = rotations != 0;
    layer.multiplies_scales = scales == 0;
    for (const FbxConnection* link : below_[layer.id]) {
      const FbxNode* node = object(link->child, "AnimationCurveNode");
      if (!node) continue;
      if (!link->property.empty()) {  // The layer's own weight.
        if (auto good = read_weight(*link, layer); !good) return good;
        continue;
      }
      layer.links.push_back(link);
      if (auto good = read_node(*node, layer); !good) return good;
    }
    return {};
  }

  const FbxNode* layer_template() const {
    for (const FbxNode* type : tree_.in_sections("Definitions")) {
      if (type->name == "ObjectType" && tree_.text(*type, 0) == "AnimationLayer") {
        return type->child("PropertyTemplate");
      }
    }
    return nullptr;
  }

  Result<void> read_weight(const FbxConnection& link, FbxLayer& layer) {
    if (link.property != "Weight") return {};
    for (const FbxConnection* curve : below_[link.child]) {
      const FbxNode* node = object(curve->child, "AnimationCurve");
      if (node) return read_curve(*node, layer.weight_curve);
    }
    return {};
  }

  Result<void> read_node(const FbxNode& node, FbxLayer& layer) {
    FbxCurveNode out;
    out.node = &node;
    out.id = tree_.text(node, 0);
    std::vector<std::pair<size_t, size_t>> targets;
    for (const FbxConnection* link : above_[out.id]) {
      if (link->property.empty()) continue;
      out.targets.push_back(*link);
      const auto part =
          std::find(std::begin(kFbxPartNames), std::end(kFbxPartNames), link->property);
      const auto model = models_.find(link->parent);
      if (part == std::end(kFbxPartNames) || model == models_.end()) continue;
      targets.emplace_back(model->second, static_cast<size_t>(part - kFbxPartNames));
    }
    for (const FbxConnection* link : below_[out.id]) {
      if (object(link->child, "AnimationCurve")) out.curve_links.push_back(*link);
    }
    if (!targets.empty()) {
      for (size_t axis = 0; axis < 3; ++axis) {
        if (auto good = read_axis(node, axis, out); !good) return good;
      }
    }
    for (const auto& target : targets) layer.by_target.emplace(target, layer.nodes.size());
    layer.nodes.push_back(std::move(out));
    return {};
  }

  Result<void> read_axis(const FbxNode& node, size_t axis, FbxCurveNode& out) {
    const std::string name = std::string("d|") + kFbxAxes[axis];
    if (find_fbx_property(node, name).node) {
      double number = 0;
      if (auto good = read_fbx_property(tree_, node, name, std::span(&number, 1)); !good)
        return good;
      out.still[axis] = number;
    }
    for (const FbxConnection& link : out.curve_links) {
      if (link.property != name || !out.curves[axis].keys.empty()) continue;
      if (auto good = read_curve(*objects_.at(link.child), out.curves[axis]); !good) return good;
    }
    return {};
  }

  Result<void> read_curve(const FbxNode& node, FbxCurve& out) {
    Result<FbxCurve> curve = read_fbx_curve(tree_, node);
    if (!curve) return curve.error();
    out = *std::move(curve);
    keys_ += out.keys.size();
    const size_t max = fbx_max_keys(tree_.bytes().size());
    if (keys_ <= max) return {};
    return tree_.error(node, "at most " + std::to_string(max) + " keys in all", "more");
  }

  FbxDocument& document_;
  const FbxTree& tree_;
  std::unordered_map<std::string, size_t> models_;  // Index by ID.
  std::unordered_map<std::string, const FbxNode*> objects_;
  std::unordered_map<std::string, std::vector<const FbxConnection*>> below_, above_;
  size_t keys_ = 0;
};

// What a layer does to a value that the layers below it have given.
Vec3d blended(const FbxLayer& layer, const FbxModel& model, size_t part, Vec3d below, Vec3d own,
              double weight) {
  const bool turns = part == kFbxRotation && !layer.adds_angles;
  if (turns) {
    const Quatd a = model.rotation_of(below), b = model.rotation_of(own);
    // `before` and `after` belong to the model, not to the layer.
    const Quatd inner = conjugate(model.before) * b * conjugate(model.after);
    const Quatd sum =
        layer.blend == FbxLayer::Blend::add
            ? a * conjugate(model.after) * exp_rotation(log_rotation(inner) * weight) * model.after
            : nlerp_far(a, b, weight);
    return model.angles_of(sum, below);
  }
  if (layer.blend == FbxLayer::Blend::replace) return lerp(below, own, weight);
  if (part == kFbxScale && layer.multiplies_scales) {
    const Vec3d by = scaled_power(own, weight);
    return {below.x * by.x, below.y * by.y, below.z * by.z};
  }
  return below + own * weight;
}

}  // namespace

bool FbxStack::animates(size_t model, size_t part) const {
  return std::ranges::any_of(layers, [&](const FbxLayer& layer) {
    return layer.by_target.contains({model, part});
  });
}

FbxChannels FbxStack::channels(const FbxDocument& document, size_t model, int64_t time) const {
  const FbxModel& of = document.models[model];
  FbxChannels out = of.channels;
  const bool has_solo =
      std::ranges::any_of(layers, [](const FbxLayer& layer) { return layer.is_solo; });
  for (const FbxLayer& layer : layers) {
    if (layer.is_muted || (has_solo && !layer.is_solo)) continue;
    const bool is_base = &layer == &layers.front();
    const double weight = is_base ? 1 : layer.weight_curve.at(time, layer.weight * 100) / 100;
    for (size_t part = 0; part < 3; ++part) {
      const auto found = layer.by_target.find({model, part});
      if (found == layer.by_target.end()) continue;
      const FbxCurveNode& curves = layer.nodes[found->second];
      // Where a layer that adds says nothing of an axis, it adds nothing.
      const bool adds = !is_base && layer.blend == FbxLayer::Blend::add;
      const double nothing = part == kFbxScale && layer.multiplies_scales ? 1 : 0;
      Vec3d own = adds ? Vec3d{nothing, nothing, nothing} : out.parts[part];
      for (size_t axis = 0; axis < 3; ++axis) {
        own[axis] = curves.curves[axis].at(time, curves.still[axis].value_or(own[axis]));
      }
      out.parts[part] = is_base ? own : blended(layer, of, part, out.parts[part], own, weight);
    }
  }
  return out;
}

Result<void> read_fbx_stacks(FbxDocument& document) { return FbxStacksReader(document).read(); }

// The animation of FBX 6: takes, whose channels are nested down to those of a single number.
namespace {

class Fbx6TakesReader {
 public:
  explicit Fbx6TakesReader(FbxDocument& document) : document_(document), tree_(document.tree) {
    for (size_t m = 0; m < document.models.size(); ++m) models_.emplace(document.models[m].id, m);
  }

  Result<void> read() {
    for (const FbxNode* take : tree_.in_sections("Takes")) {
      if (take->name != "Take") continue;
      FbxStack& stack = document_.stacks.emplace_back();
      stack.name = fbx_name(tree_.text(*take, 0));
      FbxLayer& layer = stack.layers.emplace_back();
      for (const FbxNode& node : take->children) {
        const auto model = models_.find(tree_.text(node, 0));
        if (node.name != "Model" || model == models_.end()) continue;
        if (auto good = read_model(node, model->second, layer); !good) return good;
      }
    }
    return {};
  }

 private:
  const FbxNode* channel(const FbxNode& node, char name) const {
    return channel(node, std::string(1, name));
  }
  const FbxNode* channel(const FbxNode& node, const std::string& name) const {
    for (const FbxNode& child : node.children) {
      if (child.name == "Channel" && tree_.text(child, 0) == name) return &child;
    }
    return nullptr;
  }

  Result<void> read_model(const FbxNode& node, size_t model, FbxLayer& layer) {
    const FbxNode* transform = channel(node, "Transform");
    for (size_t part = 0; transform && part < 3; ++part) {
      const FbxNode* whole = channel(*transform, "TRS"[part]);
      if (!whole) continue;
      FbxCurveNode out;
      for (size_t axis = 0; axis < 3; ++axis) {
        const FbxNode* number = channel(*whole, "XYZ"[axis]);
        if (!number) continue;
        if (auto good = read_channel(*number, axis, out); !good) return good;
      }
      layer.by_target.emplace(std::pair(model, part), layer.nodes.size());
      layer.nodes.push_back(std::move(out));
    }
    return {};
  }

  Result<void> read_channel(const FbxNode& node, size_t axis, FbxCurveNode& out) const {
    if (const FbxNode* value = node.child("Default")) {
      double number = 0;
      if (!tree_.number(*value, 0, number)) {
        return tree_.error(*value, 0, "a number between -1e9 and 1e9 for a channel's default");
      }
      out.still[axis] = number;
    }
    Result<FbxCurve> curve = read_fbx6_channel(tree_, node);
    if (!curve) return curve.error();
    out.curves[axis] = *std::move(curve);
    return {};
  }

  FbxDocument& document_;
  const FbxTree& tree_;
  std::unordered_map<std::string, size_t> models_;  // Index by ID, which is a name.
};

}  // namespace

Result<void> read_fbx6_takes(FbxDocument& document) { return Fbx6TakesReader(document).read(); }

}  // namespace panache
