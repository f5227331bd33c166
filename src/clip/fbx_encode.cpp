#include "clip/fbx_encode.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <unordered_set>

#include "clip/motion_file.h"

namespace panache {
namespace {

// What a reader takes: scales near 0 and steep tangents lead further.
double readable(double number) {
  constexpr double kFarthest = 9e8;
  return std::isfinite(number) ? std::clamp(number, -kFarthest, kFarthest) : 0;
}
Vec3d readable(Vec3d v) { return {readable(v.x), readable(v.y), readable(v.z)}; }

class FbxEncoder {
 public:
  explicit FbxEncoder(const FbxDocument& document) : document_(document), tree_(document.tree) {
    for (const FbxNode* node : tree_.in_sections("Objects")) ids_.insert(tree_.text(*node, 0));
    for (const FbxConnection& connection : document.connections) ++uses_[connection.child];
    for (const FbxNode& section : tree_.root().children) {
      if (!section.has_list) continue;
      if (section.name == "Objects" && !objects_) objects_ = &section;
      if (section.name == "Connections" && !connections_) connections_ = &section;
    }
  }

  std::string encode(std::span<const ClipEdit> edits, EditMode mode) {
    const bool only_new =
        mode == EditMode::replace &&
        std::ranges::any_of(edits, [](const ClipEdit& edit) { return edit.clip == kNewClip; });
    TakenNames names;
    if (only_new) {
      drop_stacks();
    } else {
      for (const FbxStack& stack : document_.stacks) unique_name(stack.name, names);
    }
    for (const ClipEdit& edit : edits) {
      const FbxBake bake(document_, edit);
      if (mode == EditMode::replace && bake.stack()) {
        replace(bake);
        continue;
      }
      if (!bake.stack() && bake.parts().empty() && edit.clip != kNewClip) continue;
      const std::string name = unique_name(edit.name.empty() ? "animation" : edit.name, names);
      if (first_new_.empty()) first_new_ = name;
      add(bake, name, mode == EditMode::add_first);
    }
    if (!first_new_.empty() && (mode == EditMode::add_first || only_new)) set_active(first_new_);
    add_connections();
    count_objects();
    return edits_.apply(tree_);
  }

  std::string encode_still() {
    drop_stacks();
    return edits_.apply(tree_);
  }

  std::string retime(std::span<const double> factors, double fps) {
    std::unordered_set<std::string> done;
    for (size_t s = 0; s < document_.stacks.size(); ++s) {
      const FbxStack& stack = document_.stacks[s];
      const auto later = [&](int64_t time) {
        return stack.begin + std::llround(static_cast<double>(time - stack.begin) * factors[s]);
      };
      for (const FbxLayer& layer : stack.layers) {
        for (const FbxCurveNode& node : layer.nodes) {
          for (const FbxConnection& link : node.curve_links) {
            if (done.insert(link.child).second) retime_curve(*objects().at(link.child), later);
          }
        }
      }
      set_span(stack, later(stack.begin), later(stack.end));
    }
    set_rate(fps);
    return edits_.apply(tree_);
  }

 private:
  // ---- parts of the tree

  const std::unordered_map<std::string, const FbxNode*>& objects() {
    if (by_id_.empty()) {
      for (const FbxNode* node : tree_.in_sections("Objects"))
        by_id_.emplace(tree_.text(*node, 0), node);
    }
    return by_id_;
  }

  int64_t new_id() {
    while (ids_.contains(std::to_string(next_))) ++next_;
    return next_++;
  }
  int64_t id_of(const std::string& id) const {
    FbxNode node;
    node.values = {{'w', id}};
    int64_t out = 0;
    tree_.integer(node, 0, out);
    return out;
  }

  void add_object(FbxNewNode node) {
    ++new_objects_[node.name];
    edits_.add_to(*objects_, std::move(node));
  }
  void connect(int64_t child, int64_t parent, const std::string& property = "") {
    new_connections_.push_back(new_fbx_connection(child, parent, property));
  }
  void add_connections() {
    if (new_connections_.empty()) return;
    if (!connections_) {
      edits_.add_to(tree_.root(), {"Connections", {}, std::move(new_connections_), true});
      return;
    }
    for (FbxNewNode& node : new_connections_) edits_.add_to(*connections_, std::move(node));
  }

  // ---- a motion in place of the file's own

  void replace(const FbxBake& bake) {
    const FbxStack& stack = *bake.stack();
    if (bake.keeps_time() && bake.parts().empty()) return;
    if (!bake.keeps_time()) {
      for (const FbxLayer& layer : stack.layers) retime_layer(bake, layer);
      set_span(stack, bake.times().front(), bake.times().back());
    }
    for (const auto& [target, numbers] : bake.parts()) replace_part(bake, target, numbers);
  }

  // Other layers let go of the property, so that the base layer alone says what it is.
  void replace_part(const FbxBake& bake, std::pair<size_t, size_t> target,
                    std::span<const Vec3d> numbers) {
    const FbxStack& stack = *bake.stack();
    const FbxCurveNode* base = nullptr;
    for (const FbxLayer& layer : stack.layers) {
      const auto found = layer.by_target.find(target);
      if (found == layer.by_target.end()) continue;
      const FbxCurveNode& node = layer.nodes[found->second];
      const bool is_base = &layer == &stack.layers.front();
      if (is_base && node.targets.size() == 1 && uses_[node.id] == 2) {
        base = &node;
      } else {
        let_go(node, target);
      }
    }
    int64_t node = 0;
    if (base) {
      node = id_of(base->id);
    } else {
      node = new_id();
      add_object(new_fbx_curve_node(node, target.second, readable(numbers.front())));
      connect(node, id_of(base_layer(stack)));
      connect(node, id_of(document_.models[target.first].id), kFbxPartNames[target.second]);
    }
    for (size_t axis = 0; axis < 3; ++axis) {
      const std::vector<float> values = axis_values(numbers, axis);
      set_curve(base, node, axis, {bake.times(), values});
    }
  }

  static std::vector<float> axis_values(std::span<const Vec3d> numbers, size_t axis) {
    std::vector<float> out;
    for (const Vec3d v : numbers) out.push_back(static_cast<float>(readable(v[axis])));
    return out;
  }

  // Drops the connection of a curve node with a property, and with its layer if it has no other.
  void let_go(const FbxCurveNode& node, std::pair<size_t, size_t> target) {
    const std::string& model = document_.models[target.first].id;
    for (const FbxConnection& link : document_.connections) {
      if (link.child != node.id) continue;
      const bool is_it = link.parent == model && link.property == kFbxPartNames[target.second];
      if (is_it || (node.targets.size() == 1 && link.property.empty())) edits_.drop(*link.node);
    }
  }

  const std::string& base_layer(const FbxStack& stack) { return stack.layers.front().id; }

  // Puts keys into the curve of an axis, if it has one of its own, or into a new one.
  void set_curve(const FbxCurveNode* node, int64_t id, size_t axis, const FbxKeys& keys) {
    const std::string name = std::string("d|") + "XYZ"[axis];
    bool is_done = false;
    for (size_t i = 0; node && i < node->curve_links.size(); ++i) {
      const FbxConnection& link = node->curve_links[i];
      if (link.property != name) continue;
      if (!is_done && uses_[link.child] == 1) {
        write_keys(*objects().at(link.child), keys);
        is_done = true;
      } else {
        edits_.drop(*link.node);
      }
    }
    if (is_done) return;
    const int64_t curve = new_id();
    add_object(new_fbx_curve(curve, keys, !tree_.is_binary()));
    connect(curve, id, name);
  }

  void write_keys(const FbxNode& curve, const FbxKeys& keys) {
    FbxNewNode out = copy_fbx_node(curve);
    set_fbx_keys(keys, !tree_.is_binary(), out);
    edits_.replace(curve, std::move(out));
  }

  // Everything that a layer animates follows the frames of a motion.
  void retime_layer(const FbxBake& bake, const FbxLayer& layer) {
    for (const FbxCurveNode& node : layer.nodes) {
      for (const FbxConnection& link : node.curve_links) {
        const FbxNode& curve = *objects().at(link.child);
        if (edits_.is_replaced(curve)) continue;
        std::vector<float> values;
        bool are_steps = false;
        if (!sample_curve(bake, curve, values, are_steps)) continue;
        write_keys(curve, {bake.times(), values, are_steps});
      }
    }
  }

  // The values of a curve at the frames; false if it is constant, or cannot be read.
  bool sample_curve(const FbxBake& bake, const FbxNode& node, std::vector<float>& out,
                    bool& are_steps) const {
    const Result<FbxCurve> curve = read_fbx_curve(tree_, node);
    if (!curve || curve->keys.size() < 2) return false;
    for (size_t i = 0; i < bake.times().size(); ++i) {
      out.push_back(static_cast<float>(readable(curve->at(bake.source_time(i), 0))));
    }
    are_steps = curve->is_step();
    return true;
  }

  // ---- a motion beside those of the file

  void add(const FbxBake& bake, const std::string& name, bool is_first) {
    const int64_t stack = new_id();
    const int64_t begin = bake.times().front(), end = bake.times().back();
    FbxNewNode made = new_fbx_stack(stack, name, begin, end);
    const FbxNode* before = is_first ? first_stack() : nullptr;
    ++new_objects_[made.name];
    if (before) {
      edits_.add_before(*before, std::move(made));
    } else {
      edits_.add_to(*objects_, std::move(made));
    }
    add_take(name, begin, end, is_first);
    int64_t base = 0;
    if (bake.stack()) {
      for (const FbxLayer& layer : bake.stack()->layers) {
        const int64_t copy = copy_layer(bake, layer, stack);
        if (base == 0) base = copy;
      }
    } else {
      base = new_id();
      add_object(new_fbx_layer(base));
      connect(base, stack);
    }
    for (const auto& [target, numbers] : bake.parts()) {
      const int64_t node = new_id();
      add_object(new_fbx_curve_node(node, target.second, readable(numbers.front())));
      connect(node, base);
      connect(node, id_of(document_.models[target.first].id), kFbxPartNames[target.second]);
      for (size_t axis = 0; axis < 3; ++axis) {
        const std::vector<float> values = axis_values(numbers, axis);
        set_curve(nullptr, node, axis, {bake.times(), values});
      }
    }
  }

  const FbxNode* first_stack() const {
    for (const FbxNode& node : objects_->children) {
      if (node.name == "AnimationStack") return &node;
    }
    return nullptr;
  }

  FbxNewNode copy_object(const FbxNode& node, int64_t id) const {
    FbxNewNode out = copy_fbx_node(node);
    out.values[0] = FbxNewValue::whole(id);
    return out;
  }

  // Copies a layer with all its curves except those of parts that have new ones.
  int64_t copy_layer(const FbxBake& bake, const FbxLayer& layer, int64_t stack) {
    const int64_t copy = new_id();
    add_object(copy_object(*layer.node, copy));
    connect(copy, stack);
    for (size_t n = 0; n < layer.nodes.size(); ++n) {
      const FbxCurveNode& node = layer.nodes[n];
      std::vector<const FbxConnection*> kept;
      for (const FbxConnection& target : node.targets) {
        const bool is_new = std::ranges::any_of(bake.parts(), [&](const auto& part) {
          return document_.models[part.first.first].id == target.parent &&
                 kFbxPartNames[part.first.second] == target.property;
        });
        if (!is_new) kept.push_back(&target);
      }
      if (kept.empty()) continue;
      const int64_t id = new_id();
      add_object(copy_object(*node.node, id));
      connect(id, copy);
      for (const FbxConnection* target : kept) connect(id, id_of(target->parent), target->property);
      for (const FbxConnection& link : node.curve_links) {
        const FbxNode& old = *objects().at(link.child);
        if (!read_fbx_curve(tree_, old)) continue;  // A reader may refuse the file for its sake.
        const int64_t curve = new_id();
        FbxNewNode made = copy_object(old, curve);
        std::vector<float> values;
        bool are_steps = false;
        if (!bake.keeps_time() && sample_curve(bake, old, values, are_steps)) {
          set_fbx_keys({bake.times(), values, are_steps}, !tree_.is_binary(), made);
        }
        add_object(std::move(made));
        connect(curve, id, link.property);
      }
    }
    return copy;
  }

  // ---- what else names motions

  void drop_stacks() {
    std::unordered_set<std::string> dropped;
    for (const FbxNode* node : tree_.in_sections("Objects")) {
      if (!node->name.starts_with("Animation")) continue;
      dropped.insert(tree_.text(*node, 0));
      edits_.drop(*node);
      --new_objects_[std::string(node->name)];
    }
    for (const FbxConnection& link : document_.connections) {
      if (dropped.contains(link.child) || dropped.contains(link.parent)) edits_.drop(*link.node);
    }
    for (const FbxNode* take : tree_.in_sections("Takes")) {
      if (take->name == "Take") edits_.drop(*take);
    }
  }

  const FbxNode* takes() const {
    const FbxNode* out = tree_.root().child("Takes");
    return out && out->has_list ? out : nullptr;
  }

  void add_take(const std::string& name, int64_t begin, int64_t end, bool is_first) {
    const FbxNode* section = takes();
    if (!section) return;
    const FbxNode* first = is_first ? section->child("Take") : nullptr;
    if (first) {
      edits_.add_before(*first, new_fbx_take(name, begin, end));
    } else {
      edits_.add_to(*section, new_fbx_take(name, begin, end));
    }
  }

  void set_last_value(const FbxNode& node, FbxNewValue value) {
    FbxNewNode out = copy_fbx_node(node);
    out.values.back() = std::move(value);
    edits_.replace(node, std::move(out));
  }

  void set_active(const std::string& name) {
    const FbxNode* current = takes() ? takes()->child("Current") : nullptr;
    if (current && !current->values.empty()) set_last_value(*current, FbxNewValue::string(name));
    for (const FbxNode* node : tree_.in_sections("Documents")) {
      const FbxProperty active = find_fbx_property(*node, "ActiveAnimStackName");
      if (active.node && active.node->values.size() == active.first + 1) {
        set_last_value(*active.node, FbxNewValue::string(name));
      }
    }
  }

  // The span of time that a stack and its take state.
  void set_span(const FbxStack& stack, int64_t begin, int64_t end) {
    for (const auto& [name, time] :
         {std::pair("LocalStart", begin), std::pair("LocalStop", end),
          std::pair("ReferenceStart", begin), std::pair("ReferenceStop", end)}) {
      const FbxProperty property = find_fbx_property(*stack.node, name);
      if (property.node && property.node->values.size() == property.first + 1) {
        set_last_value(*property.node, FbxNewValue::whole(time));
      }
    }
    for (const FbxNode* take : tree_.in_sections("Takes")) {
      if (take->name != "Take" || fbx_name(tree_.text(*take, 0)) != stack.name) continue;
      for (const char* name : {"LocalTime", "ReferenceTime"}) {
        const FbxNode* span = take->child(name);
        if (!span) continue;
        edits_.replace(*span,
                       {name, {FbxNewValue::whole(begin), FbxNewValue::whole(end)}, {}, false});
      }
    }
  }

  // How many objects of each kind there are.
  void count_objects() {
    int64_t all = 0;
    for (const FbxNode* type : tree_.in_sections("Definitions")) {
      if (type->name != "ObjectType") continue;
      const auto added = new_objects_.find(tree_.text(*type, 0));
      if (added == new_objects_.end()) continue;
      add_count(type->child("Count"), added->second);
      all += added->second;
      new_objects_.erase(added);
    }
    const FbxNode* section = tree_.root().child("Definitions");
    if (!section || !section->has_list) return;
    for (const auto& [kind, count] : new_objects_) {
      if (count <= 0) continue;
      FbxNewNode type{"ObjectType", {FbxNewValue::string(kind)}, {}, true};
      type.add("Count", {FbxNewValue::small(static_cast<int32_t>(count))});
      edits_.add_to(*section, std::move(type));
      all += count;
    }
    add_count(section->child("Count"), all);
  }
  void add_count(const FbxNode* node, int64_t added) {
    int64_t count = 0;
    if (added == 0 || !node || node->values.size() != 1 || !tree_.integer(*node, 0, count)) return;
    const auto sum = static_cast<int32_t>(std::clamp<int64_t>(count + added, 0, 1 << 30));
    set_last_value(*node, FbxNewValue::small(sum));
  }

  // ---- other rates

  void retime_curve(const FbxNode& node, const std::function<int64_t(int64_t)>& later) {
    std::vector<int64_t> times;
    const FbxNode* of = node.child("KeyTime");
    if (!of || !tree_.integers(of, times)) return;
    for (int64_t& time : times) time = later(std::clamp(time, -kFbxLatest, kFbxLatest));
    edits_.replace(*of, {"KeyTime", {FbxNewValue::times(times)}, {}, false});
  }

  void set_rate(double fps) {
    const FbxNode* node = document_.settings.node;
    const FbxNode* list = node ? node->child("Properties70") : nullptr;
    if (!list) return;
    const auto set = [&](const char* name, const char* type, FbxNewValue value) {
      const FbxProperty property = find_fbx_property(*node, name);
      if (property.node && property.node->values.size() == property.first + 1) {
        return set_last_value(*property.node, std::move(value));
      }
      edits_.add_to(*list, {"P",
                            {FbxNewValue::string(name), FbxNewValue::string(type),
                             FbxNewValue::string(""), FbxNewValue::string(""), std::move(value)},
                            {},
                            false});
    };
    set("TimeMode", "enum", FbxNewValue::small(14));
    set("CustomFrameRate", "double", FbxNewValue::number(fps));
  }

  const FbxDocument& document_;
  const FbxTree& tree_;
  FbxEdits edits_;
  const FbxNode* objects_ = nullptr;
  const FbxNode* connections_ = nullptr;
  std::unordered_set<std::string> ids_;
  std::unordered_map<std::string, int> uses_;  // How often each object is connected as a child.
  std::unordered_map<std::string, const FbxNode*> by_id_;
  std::map<std::string, int64_t> new_objects_;  // By kind.
  std::vector<FbxNewNode> new_connections_;
  int64_t next_ = 1'000'000;
  std::string first_new_;
};

}  // namespace

std::string encode_fbx(const FbxDocument& document, std::span<const ClipEdit> edits,
                       EditMode mode) {
  return FbxEncoder(document).encode(edits, mode);
}

std::string encode_still_fbx(const FbxDocument& document) {
  return FbxEncoder(document).encode_still();
}

std::string retime_fbx(const FbxDocument& document, std::span<const double> factors, double fps) {
  return FbxEncoder(document).retime(factors, fps);
}

}  // namespace panache
