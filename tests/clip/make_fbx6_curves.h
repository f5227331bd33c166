#pragma once
// FBX 6.1 files in text form whose curves have any keys, and where their models are by the formula
// of FBX: T Roff Rp R Rp^-1 Soff Sp S Sp^-1 along the tree.

#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "clip/rescale.h"

namespace panache::test {

struct CurveKey {
  double frame = 0, value = 0;
  bool is_held = false;  // Up to the next key; else a straight line leads there.
};
// Of translation (centimetres), rotation (degrees) and scale, by axis.
using ModelCurves = std::array<std::array<std::vector<CurveKey>, 3>, 3>;

struct CurveModel {
  std::string name;
  int parent = -1;                          // An index that is smaller than its own.
  std::map<std::string, Vec3d> properties;  // By the names of FBX.

  Vec3d property(const std::string& of) const {
    const auto found = properties.find(of);
    return found != properties.end() ? found->second
           : of == "Lcl Scaling"     ? Vec3d{1, 1, 1}
                                     : Vec3d{};
  }
};

struct CurveTake {
  std::string name;
  std::map<size_t, ModelCurves> curves;  // By the index of the model.
};

inline constexpr double kCurveRate = 30;  // Frames a second.
inline constexpr const char* kCurvesOf[] = {"Lcl Translation", "Lcl Rotation", "Lcl Scaling"};

class Fbx6CurvesMaker {
 public:
  Fbx6CurvesMaker(const std::vector<CurveModel>& models, const std::vector<CurveTake>& takes)
      : models_(models), takes_(takes) {}

  std::string make() {
    text_ =
        "; FBX 6.1.0 project file\nFBXHeaderExtension:  {\n\tFBXVersion: 6100\n}\nObjects:  {\n";
    std::string connections;
    for (const CurveModel& model : models_) {
      text_ += "\tModel: \"Model::" + model.name + "\", \"Limb\" {\n\t\tProperties60:  {\n";
      for (const auto& [name, v] : model.properties) {
        text_ += "\t\t\tProperty: \"" + name + "\", \"Vector3D\", \"A+\"," + number(v.x) + "," +
                 number(v.y) + "," + number(v.z) + "\n";
      }
      text_ += "\t\t}\n\t}\n";
      connections +=
          "\tConnect: \"OO\", \"Model::" + model.name + "\", \"Model::" +
          (model.parent < 0 ? "Scene" : models_[static_cast<size_t>(model.parent)].name) + "\"\n";
    }
    text_ += "}\nConnections:  {\n" + connections + "}\nTakes:  {\n\tCurrent: \"\"\n";
    for (const CurveTake& take : takes_) add_take(take);
    text_ += "}\nVersion5:  {\n\tSettings:  {\n\t\tFrameRate: \"30\"\n\t}\n}\n";
    return text_;
  }

 private:
  static std::string number(double value) {
    char out[40];
    std::snprintf(out, sizeof out, "%.9f", value);
    return out;
  }

  void add_take(const CurveTake& take) {
    text_ += "\tTake: \"" + take.name + "\" {\n";
    for (const auto& [model, curves] : take.curves) {
      text_ +=
          "\t\tModel: \"Model::" + models_[model].name + "\" {\n\t\t\tChannel: \"Transform\" {\n";
      for (size_t what = 0; what < 3; ++what) {
        text_ += std::string("\t\t\t\tChannel: \"") + "TRS"[what] + "\" {\n";
        Vec3d rest = models_[model].property(kCurvesOf[what]);
        for (size_t axis = 0; axis < 3; ++axis) {
          text_ += std::string("\t\t\t\t\tChannel: \"") + "XYZ"[axis] +
                   "\" {\n\t\t\t\t\t\tDefault: " + number(rest[axis]) + "\n";
          if (!curves[what][axis].empty()) add_keys(curves[what][axis]);
          text_ += "\t\t\t\t\t}\n";
        }
        text_ += "\t\t\t\t}\n";
      }
      text_ += "\t\t\t}\n\t\t}\n";
    }
    text_ += "\t}\n";
  }

  void add_keys(const std::vector<CurveKey>& keys) {
    text_ += "\t\t\t\t\t\tKeyVer: 4005\n\t\t\t\t\t\tKeyCount: " + std::to_string(keys.size()) +
             "\n\t\t\t\t\t\tKey: ";
    for (size_t i = 0; i < keys.size(); ++i) {
      const double seconds = keys[i].frame / kCurveRate;
      text_ += (i > 0 ? ",\n" : "") + std::to_string(std::llround(seconds * 46'186'158'000)) + "," +
               number(keys[i].value) + (keys[i].is_held ? ",C,s" : ",L");
    }
    text_ += "\n";
  }

  const std::vector<CurveModel>& models_;
  const std::vector<CurveTake>& takes_;
  std::string text_;
};

inline std::string format_fbx6(const std::vector<CurveModel>& models,
                               const std::vector<CurveTake>& takes) {
  return Fbx6CurvesMaker(models, takes).make();
}

inline double value_at(const std::vector<CurveKey>& keys, double frame) {
  if (frame <= keys.front().frame) return keys.front().value;
  for (size_t i = 0; i + 1 < keys.size(); ++i) {
    const CurveKey &a = keys[i], &b = keys[i + 1];
    if (frame >= b.frame) continue;
    return a.is_held ? a.value
                     : std::lerp(a.value, b.value, (frame - a.frame) / (b.frame - a.frame));
  }
  return keys.back().value;
}

inline Affine affine_move(Vec3d by) {
  return {{{1, 0, 0, by.x}, {0, 1, 0, by.y}, {0, 0, 1, by.z}}};
}
inline Affine affine_grow(Vec3d by) {
  return {{{by.x, 0, 0, 0}, {0, by.y, 0, 0}, {0, 0, by.z, 0}}};
}
// Rz Ry Rx.
inline Affine affine_turn(Vec3d degrees) {
  const Vec3d r = degrees * (3.14159265358979323846 / 180);
  const double cx = std::cos(r.x), sx = std::sin(r.x), cy = std::cos(r.y), sy = std::sin(r.y),
               cz = std::cos(r.z), sz = std::sin(r.z);
  const Affine x = {{{1, 0, 0, 0}, {0, cx, -sx, 0}, {0, sx, cx, 0}}};
  const Affine y = {{{cy, 0, sy, 0}, {0, 1, 0, 0}, {-sy, 0, cy, 0}}};
  const Affine z = {{{cz, -sz, 0, 0}, {sz, cz, 0, 0}, {0, 0, 1, 0}}};
  return z * y * x;
}

// In the world, in metres.
inline Vec3d position_by_formula(const std::vector<CurveModel>& models, const CurveTake& take,
                                 size_t model, double frame) {
  Affine at = affine_move({});
  for (int m = static_cast<int>(model); m >= 0; m = models[static_cast<size_t>(m)].parent) {
    const CurveModel& from = models[static_cast<size_t>(m)];
    Vec3d v[3];
    const auto curves = take.curves.find(static_cast<size_t>(m));
    for (size_t what = 0; what < 3; ++what) {
      v[what] = from.property(kCurvesOf[what]);
      for (size_t axis = 0; axis < 3; ++axis) {
        if (curves == take.curves.end() || curves->second[what][axis].empty()) continue;
        v[what][axis] = value_at(curves->second[what][axis], frame);
      }
    }
    const Vec3d turning = from.property("RotationPivot"), growing = from.property("ScalingPivot");
    at = affine_move(v[0] + from.property("RotationOffset") + turning) * affine_turn(v[1]) *
         affine_move(from.property("ScalingOffset") - turning + growing) * affine_grow(v[2]) *
         affine_move(growing * -1.0) * at;
  }
  return Vec3d{at[0][3], at[1][3], at[2][3]} * 0.01;
}

}  // namespace panache::test
