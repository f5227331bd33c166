#pragma once
// FBX 7.4 files in text form with any models, layers and keys, and where their models are by the
// formula of the FBX manual, as products of matrices:
// T Roff Rp Rpre R Rpost^-1 Rp^-1 Soff Sp S Sp^-1.

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "clip/make_fbx6_curves.h"

namespace panache::test {

struct SceneModel {
  std::string name;
  int parent = -1;                                     // An index smaller than its own.
  std::map<std::string, std::vector<double>> numbers;  // Of properties.
  std::string kind = "LimbNode";

  Vec3d vector(const std::string& property) const {
    const auto found = numbers.find(property);
    const double still = property == "Lcl Scaling" ? 1 : 0;
    if (found == numbers.end()) return {still, still, still};
    return {found->second[0], found->second[1], found->second[2]};
  }
  int number(const std::string& property, int otherwise) const {
    const auto found = numbers.find(property);
    return found == numbers.end() ? otherwise : static_cast<int>(found->second[0]);
  }
};

// Keys at frames of kCurveRate.
struct SceneKey {
  double frame = 0, value = 0;
};
struct SceneCurve {
  std::vector<SceneKey> keys;
  int flags = 4;                 // Linear.
  std::vector<float> data = {};  // Slopes and weights of all its keys, if it has any.
};
struct SceneCurves {
  size_t model = 0;
  int part = 0;  // 0 translation, 1 rotation, 2 scale.
  std::array<SceneCurve, 3> axes;
};
struct SceneLayer {
  std::string name = "BaseLayer";
  std::map<std::string, double> numbers;
  std::vector<SceneCurves> curves;
};
struct SceneStack {
  std::string name = "Take 001";
  std::vector<SceneLayer> layers;
};

struct SceneOptions {
  bool reversed = false;  // The connections, last first.
  double centimetres = 1;
  int up_axis = 1, side_axis = 0;
};

class FbxSceneMaker {
 public:
  FbxSceneMaker(const std::vector<SceneModel>& models, const std::vector<SceneStack>& stacks,
                const SceneOptions& options)
      : models_(models), stacks_(stacks), options_(options) {}

  std::string make() {
    text_ =
        "; FBX 7.4.0 project file\nFBXHeaderExtension:  {\n\tFBXVersion: 7400\n}\n"
        "GlobalSettings:  {\n\tProperties70:  {\n";
    property("UpAxis", {static_cast<double>(options_.up_axis)});
    property("UpAxisSign", {1});
    property("CoordAxis", {static_cast<double>(options_.side_axis)});
    property("CoordAxisSign", {1});
    property("UnitScaleFactor", {options_.centimetres});
    property("TimeMode", {6});  // 30 frames a second.
    text_ += "\t}\n}\nObjects:  {\n";
    for (size_t m = 0; m < models_.size(); ++m) add_model(m);
    for (const SceneStack& stack : stacks_) add_stack(stack);
    text_ += "}\nConnections:  {\n";
    if (options_.reversed) std::reverse(connections_.begin(), connections_.end());
    for (const std::string& line : connections_) text_ += line;
    return text_ + "}\nTakes:  {\n\tCurrent: \"\"\n}\n";
  }

 private:
  static std::string number(double value) {
    char out[40];
    std::snprintf(out, sizeof out, "%.12g", value);
    return out;
  }
  void property(const std::string& name, const std::vector<double>& numbers) {
    text_ += "\t\tP: \"" + name + "\", \"\", \"\", \"\"";
    for (const double value : numbers) text_ += "," + number(value);
    text_ += "\n";
  }
  void connect(int64_t child, int64_t parent, const std::string& to = "") {
    connections_.push_back("\tC: \"" + std::string(to.empty() ? "OO" : "OP") + "\"," +
                           std::to_string(child) + "," + std::to_string(parent) +
                           (to.empty() ? "" : ", \"" + to + "\"") + "\n");
  }
  static int64_t model_id(size_t m) { return 2000 + static_cast<int64_t>(m); }
  void begin(const std::string& kind, int64_t id, const std::string& name,
             const std::string& last = "") {
    text_ += "\t" + kind + ": " + std::to_string(id) + ", \"" + name + "\", \"" + last + "\" {\n";
  }

  void add_model(size_t m) {
    const SceneModel& model = models_[m];
    begin("Model", model_id(m), "Model::" + model.name, model.kind);
    text_ += "\tProperties70:  {\n";
    property("RotationActive", {1});
    for (const auto& [name, numbers] : model.numbers) property(name, numbers);
    text_ += "\t}\n\t}\n";
    connect(model_id(m), model.parent < 0 ? 0 : model_id(static_cast<size_t>(model.parent)));
  }

  void add_stack(const SceneStack& stack) {
    const int64_t id = next_++;
    begin("AnimationStack", id, "AnimStack::" + stack.name);
    text_ += "\t}\n";
    for (const SceneLayer& layer : stack.layers) {
      const int64_t layer_id = next_++;
      begin("AnimationLayer", layer_id, "AnimLayer::" + layer.name);
      text_ += "\tProperties70:  {\n";
      for (const auto& [name, value] : layer.numbers) property(name, {value});
      text_ += "\t}\n\t}\n";
      connect(layer_id, id);
      for (const SceneCurves& curves : layer.curves) add_curves(layer_id, curves);
    }
  }

  void add_curves(int64_t layer, const SceneCurves& curves) {
    const int64_t node = next_++;
    begin("AnimationCurveNode", node, "AnimCurveNode::");
    text_ += "\t}\n";
    connect(node, layer);
    connect(node, model_id(curves.model), kCurvesOf[curves.part]);
    for (size_t axis = 0; axis < 3; ++axis) {
      const SceneCurve& curve = curves.axes[axis];
      if (curve.keys.empty()) continue;
      const int64_t id = next_++;
      begin("AnimationCurve", id, "AnimCurve::");
      std::vector<std::string> times, values, data;
      for (const SceneKey& key : curve.keys) {
        times.push_back(std::to_string(std::llround(key.frame / kCurveRate * 46'186'158'000)));
        values.push_back(number(key.value));
      }
      for (const float value : curve.data) {
        data.push_back(std::to_string(std::bit_cast<int32_t>(value)));
      }
      list("KeyTime", times);
      list("KeyValueFloat", values);
      list("KeyAttrFlags", {std::to_string(curve.flags)});
      if (!data.empty()) list("KeyAttrDataFloat", data);
      list("KeyAttrRefCount", {std::to_string(times.size())});
      text_ += "\t}\n";
      connect(id, node, std::string("d|") + "XYZ"[axis]);
    }
  }

  void list(const std::string& name, const std::vector<std::string>& words) {
    text_ += "\t\t" + name + ": *" + std::to_string(words.size()) + " {\n\t\t\ta: ";
    for (size_t i = 0; i < words.size(); ++i) text_ += (i ? "," : "") + words[i];
    text_ += "\n\t\t}\n";
  }

  const std::vector<SceneModel>& models_;
  const std::vector<SceneStack>& stacks_;
  const SceneOptions options_;
  int64_t next_ = 5000;
  std::string text_;
  std::vector<std::string> connections_;
};

inline std::string make_fbx_scene(const std::vector<SceneModel>& models,
                                  const std::vector<SceneStack>& stacks,
                                  const SceneOptions& options = {}) {
  return FbxSceneMaker(models, stacks, options).make();
}

// What a model's animated numbers are at a frame: translation, rotation and scale.
using SceneTransform = std::array<Vec3d, 3>;
inline SceneTransform saved_transform(const SceneModel& model) {
  return {model.vector(kCurvesOf[0]), model.vector(kCurvesOf[1]), model.vector(kCurvesOf[2])};
}

// A rotation by degrees in an order of FBX, 0 XYZ to 5 ZYX: X first is Rz Ry Rx.
inline Affine affine_turn(Vec3d degrees, int order) {
  static constexpr int kFirstToLast[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 2, 0},
                                             {1, 0, 2}, {2, 0, 1}, {2, 1, 0}};
  Affine out = affine_move({});
  for (const int axis : kFirstToLast[order]) {
    Vec3d one;
    one[static_cast<size_t>(axis)] = degrees[static_cast<size_t>(axis)];
    out = affine_turn(one) * out;
  }
  return out;
}

inline Affine turned_back(const Affine& rotation) {
  Affine out = affine_move({});
  for (size_t r = 0; r < 3; ++r) {
    for (size_t c = 0; c < 3; ++c) out[r][c] = rotation[c][r];
  }
  return out;
}
inline Affine linear_of(Affine of) {
  for (size_t r = 0; r < 3; ++r) of[r][3] = 0;
  return of;
}

// All models in the world, in the file's unit. With W and B of the parent (the product of
// the rotations, and what is left of its linear part), InheritType 0 is W R B S, 1 is W B R S, and
// 2 is W R B S'^-1 S, where S' is the parent's own scale.
inline std::vector<Affine> worlds_by_formula(const std::vector<SceneModel>& models,
                                             const std::vector<SceneTransform>& transforms) {
  std::vector<Affine> worlds, turns;
  for (size_t m = 0; m < models.size(); ++m) {
    const SceneModel& model = models[m];
    const auto& [translation, rotation, scale] = transforms[m];
    const Vec3d turning = model.vector("RotationPivot"), growing = model.vector("ScalingPivot");
    const Affine turn = affine_turn(model.vector("PreRotation")) *
                        affine_turn(rotation, model.number("RotationOrder", 0)) *
                        turned_back(affine_turn(model.vector("PostRotation")));
    const Affine local = affine_move(translation + model.vector("RotationOffset") + turning) *
                         turn * affine_move(model.vector("ScalingOffset") - turning + growing) *
                         affine_grow(scale) * affine_move(growing * -1.0);
    if (model.parent < 0) {
      worlds.push_back(local);
      turns.push_back(turn);
    } else {
      const auto parent = static_cast<size_t>(model.parent);
      const Affine rest = turned_back(turns[parent]) * linear_of(worlds[parent]);
      const Vec3d s = transforms[parent][2];
      const int inherit = model.number("InheritType", 1);
      const Affine without = rest * affine_grow({1 / s.x, 1 / s.y, 1 / s.z});
      Affine world = inherit == 1   ? turns[parent] * rest * turn * affine_grow(scale)
                     : inherit == 0 ? turns[parent] * turn * rest * affine_grow(scale)
                                    : turns[parent] * turn * without * affine_grow(scale);
      const Affine placed = worlds[parent] * local;
      for (size_t r = 0; r < 3; ++r) world[r][3] = placed[r][3];
      worlds.push_back(world);
      turns.push_back(turns[parent] * turn);
    }
  }
  return worlds;
}

inline std::vector<Vec3d> positions_by_formula(const std::vector<SceneModel>& models,
                                               const std::vector<SceneTransform>& transforms) {
  std::vector<Vec3d> out;
  for (const Affine& world : worlds_by_formula(models, transforms)) {
    out.push_back({world[0][3], world[1][3], world[2][3]});
  }
  return out;
}

}  // namespace panache::test
