#include "fbx_takes.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <unordered_map>

#include "clip/unique_name.h"

namespace panache::cli {
namespace {

constexpr double kSparse = kFbxSecond / 20;  // Keys no further apart than this are the frames.
constexpr double kSameFrame = 0.1;           // In frames: max distance between a key and its frame.
// 18 days, which keeps differences of times far from overflow.
constexpr int64_t kLatest = int64_t{1} << 56;

// Sorts by time; the last of several keys at one time wins, as a jump has two.
void sort_keys(std::vector<FbxKey>& keys) {
  std::stable_sort(keys.begin(), keys.end(),
                   [](const FbxKey& a, const FbxKey& b) { return a.time < b.time; });
  size_t kept = 0;
  for (size_t i = 0; i < keys.size(); ++i) {
    if (i + 1 < keys.size() && keys[i + 1].time == keys[i].time) continue;
    keys[kept++] = keys[i];
  }
  keys.resize(kept);
}

class TakesReader {
 public:
  TakesReader(const FbxDocument& document, const std::vector<FbxModel>& models)
      : document_(document) {
    for (size_t i = 0; i < models.size(); ++i) places_.emplace(models[i].id, i);
  }

  Result<std::vector<FbxTake>> read() {
    for (const FbxNode* take : document_.in_sections("Takes")) {
      if (take->name != "Take") continue;
      if (auto good = read_take(*take); !good) return good.error();
    }
    if (auto good = read_stacks(); !good) return good.error();
    for (FbxTake& take : takes_) set_range(take);
    std::erase_if(takes_, [](const FbxTake& take) { return take.end < take.begin; });
    TakenNames taken;
    for (FbxTake& take : takes_) take.name = unique_name(take.name, taken);
    return std::move(takes_);
  }

 private:
  static void set_range(FbxTake& take) {
    take.begin = kLatest + 1;
    take.end = -kLatest - 1;
    for (const auto& [model, curves] : take.curves) {
      for (const auto& axes : curves) {
        for (const FbxCurve& curve : axes) {
          if (curve.keys.empty()) continue;
          take.begin = std::min(take.begin, curve.keys.front().time);
          take.end = std::max(take.end, curve.keys.back().time);
        }
      }
    }
  }

  Result<FbxKey> read_key(std::string_view time, std::string_view value) const {
    Result<int64_t> when = document_.time(time);
    if (!when) return when.error();
    if (*when > kLatest || *when < -kLatest) return document_.error(time, "a time within 18 days");
    Result<double> number = document_.number(value, "a key");
    if (!number) return number.error();
    return FbxKey{*when, *number};
  }

  // FBX 6: channels are nested, down to those of a single number.
  Result<void> read_take(const FbxNode& node) {
    FbxTake& take = takes_.emplace_back();
    take.name = fbx_name(node.value(0));
    for (const FbxNode& model : node.children) {
      const auto place = places_.find(model.value(0));
      if (model.name != "Model" || place == places_.end()) continue;
      const FbxNode* transform = channel(model, "Transform");
      if (!transform) continue;
      for (size_t what = 0; what < 3; ++what) {
        const FbxNode* whole = channel(*transform, std::string(1, "TRS"[what]));
        for (size_t axis = 0; whole && axis < 3; ++axis) {
          const FbxNode* number = channel(*whole, std::string(1, "XYZ"[axis]));
          if (!number) continue;
          FbxCurve& curve = take.curves[place->second][what][axis];
          if (auto good = read_channel(*number, curve); !good) return good;
        }
      }
    }
    return {};
  }

  static const FbxNode* channel(const FbxNode& node, std::string_view name) {
    for (const FbxNode& child : node.children) {
      if (child.name == "Channel" && child.value(0) == name) return &child;
    }
    return nullptr;
  }

  // A key is its time, its value, a capital letter for the interpolation to the next key (Constant,
  // Linear, cUbic), then its details in lower-case letters and numbers.
  Result<void> read_channel(const FbxNode& node, FbxCurve& curve) const {
    curve.is_there = true;
    if (const FbxNode* value = node.child("Default")) {
      Result<double> number = document_.number(value->value(0), "a channel's default");
      if (!number) return number.error();
      curve.value = *number;
    }
    const FbxNode *count = node.child("KeyCount"), *keys = node.child("Key");
    if (!count && !keys) return {};
    const std::vector<std::string_view> none;
    const auto& words = keys ? keys->values : none;
    for (size_t i = 0; i < words.size(); ++i) {
      const bool is_letter = words[i].size() == 1 && words[i][0] >= 'A' && words[i][0] <= 'Z';
      if (!is_letter) continue;
      if (i < 2) return document_.error(words[i], "the time and the value of a key");
      Result<FbxKey> key = read_key(words[i - 2], words[i - 1]);
      if (!key) return key.error();
      key->is_held = words[i] == "C";
      curve.keys.push_back(*key);
    }
    const std::string_view said = count ? count->value(0) : "";
    if (said != std::to_string(curve.keys.size())) {
      return document_.error(
          said, "a KeyCount of " + std::to_string(curve.keys.size()) + ", as there are keys");
    }
    sort_keys(curve.keys);
    return {};
  }

  // FBX 7: curves belong to nodes, nodes to layers and model properties, layers to stacks.
  Result<void> read_stacks() {
    std::unordered_map<std::string_view, const FbxNode*> objects;
    std::vector<const FbxNode*> stacks;
    for (const FbxNode* node : document_.in_sections("Objects")) {
      if (!node->name.starts_with("Animation")) continue;
      if (!objects.emplace(node->value(0), node).second) continue;
      if (node->name == "AnimationStack") stacks.push_back(node);
    }
    std::unordered_map<std::string_view, std::vector<FbxConnection>> below, above;
    for (const FbxConnection& connection : fbx_connections(document_)) {
      if (!objects.contains(connection.child)) continue;
      below[connection.parent].push_back(connection);
      above[connection.child].push_back(connection);
    }
    for (const FbxNode* stack : stacks) {
      FbxTake& take = takes_.emplace_back();
      take.name = fbx_name(fbx_without_class(stack->value(1)));
      for (const FbxConnection& layer : below[stack->value(0)]) {
        for (const FbxConnection& node : below[layer.child]) {
          for (const FbxConnection& on : above[node.child]) {
            if (auto good = read_curves(*objects[node.child], on, below[node.child], objects, take);
                !good) {
              return good;
            }
          }
        }
      }
    }
    return {};
  }

  // The curves of a node, if it animates a property of a model.
  Result<void> read_curves(const FbxNode& node, const FbxConnection& on,
                           const std::vector<FbxConnection>& curves,
                           const std::unordered_map<std::string_view, const FbxNode*>& objects,
                           FbxTake& take) const {
    static constexpr std::string_view kProperties[] = {"Lcl Translation", "Lcl Rotation",
                                                       "Lcl Scaling"};
    const auto what = std::find(std::begin(kProperties), std::end(kProperties), on.property);
    const auto place = places_.find(on.parent);
    if (what == std::end(kProperties) || place == places_.end()) return {};
    auto& axes = take.curves[place->second][static_cast<size_t>(what - kProperties)];
    if (axes[0].is_there) return {};  // From another layer.
    for (size_t axis = 0; axis < 3; ++axis) {
      const std::string number = std::string("d|") + "XYZ"[axis];
      if (const auto value = fbx_property(node, number); !value.empty()) {
        Result<double> read = document_.number(value[0], "'" + number + "'");
        if (!read) return read.error();
        axes[axis].value = *read;
        axes[axis].is_there = true;
      }
      for (const FbxConnection& curve : curves) {
        if (curve.property != number) continue;
        axes[axis].is_there = true;
        if (auto good = read_curve(*objects.at(curve.child), axes[axis]); !good) return good;
      }
    }
    return {};
  }

  // `Name: *3 { a: 1,2,3 }`, or in older files `Name: 1,2,3`.
  static const std::vector<std::string_view>* list(const FbxNode& node, std::string_view name) {
    const FbxNode* child = node.child(name);
    const FbxNode* inner = child ? child->child("a") : nullptr;
    return inner ? &inner->values : child ? &child->values : nullptr;
  }

  Result<void> read_curve(const FbxNode& node, FbxCurve& curve) const {
    const auto *times = list(node, "KeyTime"), *values = list(node, "KeyValueFloat");
    if (!times || !values || times->size() != values->size()) {
      return document_.error(node.name, "a curve with as many values as times");
    }
    curve.keys.clear();
    for (size_t i = 0; i < times->size(); ++i) {
      Result<FbxKey> key = read_key((*times)[i], (*values)[i]);
      if (!key) return key.error();
      curve.keys.push_back(*key);
    }
    // Interpolation flags apply to runs of keys; bit 1 is constant.
    const auto *flags = list(node, "KeyAttrFlags"), *counts = list(node, "KeyAttrRefCount");
    size_t k = 0;
    for (size_t run = 0; flags && counts && run < std::min(flags->size(), counts->size()); ++run) {
      Result<int64_t> flag = document_.time((*flags)[run]), count = document_.time((*counts)[run]);
      if (!flag) return flag.error();
      if (!count) return count.error();
      for (int64_t i = 0; i < *count && k < curve.keys.size(); ++i) {
        curve.keys[k++].is_held = (*flag & 2) != 0;
      }
    }
    sort_keys(curve.keys);
    return {};
  }

  const FbxDocument& document_;
  std::unordered_map<std::string_view, size_t> places_;  // Model indices by id.
  std::vector<FbxTake> takes_;
};

// Whether any value differs at the later time; there are no keys in between.
bool moves_between(const FbxCurves& curves, int64_t earlier, int64_t later) {
  return std::ranges::any_of(curves, [&](const auto& axes) {
    return std::ranges::any_of(
        axes, [&](const FbxCurve& curve) { return curve.at(earlier, 0) != curve.at(later, 0); });
  });
}

double& part(FbxPlace& place, size_t what, size_t axis) {
  Vec3d& vector = what == 0 ? place.translation : what == 1 ? place.rotation : place.scale;
  return axis == 0 ? vector.x : axis == 1 ? vector.y : vector.z;
}

}  // namespace

double FbxCurve::at(int64_t time, double fallback) const {
  if (!is_there) return fallback;
  if (keys.empty()) return value;
  const auto next = std::upper_bound(keys.begin(), keys.end(), time,
                                     [](int64_t t, const FbxKey& key) { return t < key.time; });
  if (next == keys.begin()) return keys.front().value;
  const FbxKey& key = next[-1];
  if (next == keys.end() || key.is_held || key.time == time) return key.value;
  const double share =
      static_cast<double>(time - key.time) / static_cast<double>(next->time - key.time);
  return key.value + share * (next->value - key.value);
}

Result<std::vector<FbxTake>> fbx_takes(const FbxDocument& document,
                                       const std::vector<FbxModel>& models) {
  return TakesReader(document, models).read();
}

std::vector<int64_t> fbx_pose_times(const FbxTake& take, const FbxCurves& curves, double rate) {
  std::set<int64_t> keys;
  for (const auto& axes : curves) {
    for (const FbxCurve& curve : axes) {
      for (const FbxKey& key : curve.keys) keys.insert(key.time);
    }
  }
  if (keys.empty()) keys.insert(take.begin);
  std::vector<int64_t> out;
  const double frame = kFbxSecond / rate;
  const auto frames_to = [&](int64_t time) {
    return static_cast<double>(time - take.begin) / frame;
  };
  // Keys off the frames show that the file's rate is not the motion's; then closely spaced keys are
  // its frames.
  const bool are_on_frames = std::ranges::all_of(keys, [&](int64_t key) {
    return std::abs(frames_to(key) - std::round(frames_to(key))) < kSameFrame;
  });
  const double closest = std::max((1 + kSameFrame) * frame, are_on_frames ? 0 : kSparse);
  for (const int64_t time : keys) {
    if (!out.empty() && static_cast<double>(time - out.back()) > closest &&
        moves_between(curves, out.back(), time)) {
      const double begin = frames_to(out.back());
      for (double f = std::floor(begin + 1 + kSameFrame);; ++f) {
        if (frames_to(time) - f < kSameFrame) break;
        out.push_back(take.begin + static_cast<int64_t>(std::llround(f * frame)));
      }
    }
    out.push_back(time);
  }
  return out;
}

FbxPlace fbx_place(const FbxCurves& curves, const FbxPlace& rest, int64_t time) {
  FbxPlace out = rest;
  for (size_t what = 0; what < 3; ++what) {
    for (size_t axis = 0; axis < 3; ++axis) {
      double& number = part(out, what, axis);
      number = curves[what][axis].at(time, number);
    }
  }
  return out;
}

}  // namespace panache::cli
