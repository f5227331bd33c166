// The animation of FBX 6: takes, whose channels are nested down to those of a single number.

#include "clip/fbx_document.h"

namespace panache {
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
