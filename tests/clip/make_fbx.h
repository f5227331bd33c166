#pragma once
// FBX files in text form for tests, made in memory from a clip. A joint turns by its PreRotation
// and then by its three angles, R = Rz Ry Rx; curves hold all keys of one number.

#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "clip/clip.h"
#include "clip/euler.h"

namespace panache::test {

struct FbxOptions {
  double centimetres = 1;               // Per unit of the file; the clip's numbers are metres.
  bool z_up = false;                    // The axes of Max and of Blender.
  Quat pre_rotation;                    // Of every joint but the roots, as Maya's joint orients.
  double first_key = 0;                 // Seconds.
  std::string motion = "Take 001";      // Its name; empty for none.
  std::map<std::string, Vec3d> scales;  // Of the joints so called, as they are in the clip's axes.
  bool has_scale_keys = false;          // Whether they stand in the motion, too.
};

class FbxMaker {
 public:
  FbxMaker(const Clip& clip, const FbxOptions& options) : clip_(clip), options_(options) {}

  std::string make() {
    text_ =
        "; FBX 7.4.0 project file\nFBXHeaderExtension:  {\n\tFBXHeaderVersion: 1003\n"
        "\tFBXVersion: 7400\n}\n";
    add_settings();
    text_ += "Objects:  {\n";
    for (size_t j = 0; j < clip_.joints(); ++j) add_joint(j);
    if (!options_.motion.empty()) add_motion();
    text_ += "}\nConnections:  {\n" + connections_ + "}\n";
    return text_;
  }

 private:
  static constexpr int64_t kSecond = 46'186'158'000;  // In the units of time of FBX.
  static constexpr int64_t kStack = 10, kLayer = 11;

  static int64_t joint_id(size_t joint) { return 1000 + static_cast<int64_t>(joint); }
  static int64_t node_id(size_t joint, int what) {
    return 100'000 + 20 * static_cast<int64_t>(joint) + what;
  }
  static std::string vector(Vec3d v) {
    return std::to_string(v.x) + "," + std::to_string(v.y) + "," + std::to_string(v.z);
  }

  bool is_root(size_t j) const { return clip_.skeleton.joints[j].parent < 0; }
  // From +Y up to the file's axes.
  Quatd axes() const {
    return options_.z_up ? Quatd{std::sqrt(0.5), 0, 0, std::sqrt(0.5)} : Quatd{};
  }

  // The numbers of the file for a joint in a frame; `near` are the angles of the frame before.
  Vec3d position(size_t j, Vec3 translation) const {
    const Vec3d metres = translation.as<double>();
    return (is_root(j) ? rotate(axes(), metres) : metres) * (100 / options_.centimetres);
  }
  Vec3d angles(size_t j, Quat rotation, EulerAngles& near) const {
    const Quatd local = rotation.as<double>();
    const Quatd before = is_root(j) ? axes() : conjugate(options_.pre_rotation.as<double>());
    near = quat_to_euler({3, {2, 1, 0}}, before * local, near);
    return {near[2], near[1], near[0]};
  }
  // What stands before the joint's own rotation, as angles.
  Vec3d pre_angles(size_t j) const {
    if (is_root(j)) return {};
    const EulerAngles zyx =
        quat_to_euler({3, {2, 1, 0}}, options_.pre_rotation.as<double>(), EulerAngles{});
    return {zyx[2], zyx[1], zyx[0]};
  }

  void add_number(const std::string& name, const std::string& type, const std::string& value) {
    text_ += "\t\tP: \"" + name + "\", \"" + type + "\", \"\", \"\"," + value + "\n";
  }

  void add_settings() {
    text_ += "GlobalSettings:  {\n\tVersion: 1000\n\tProperties70:  {\n";
    add_number("UpAxis", "int", options_.z_up ? "2" : "1");
    add_number("UpAxisSign", "int", "1");
    add_number("FrontAxis", "int", options_.z_up ? "1" : "2");
    add_number("FrontAxisSign", "int", options_.z_up ? "-1" : "1");
    add_number("CoordAxis", "int", "0");
    add_number("CoordAxisSign", "int", "1");
    add_number("UnitScaleFactor", "double", std::to_string(options_.centimetres));
    add_number("TimeMode", "enum", "14");
    add_number("CustomFrameRate", "double", std::to_string(1 / clip_.frame_time));
    text_ += "\t}\n}\n";
  }

  void connect(const std::string& kind, int64_t child, int64_t parent,
               const std::string& property = "") {
    connections_ += "\tC: \"" + kind + "\"," + std::to_string(child) + "," +
                    std::to_string(parent) + (property.empty() ? "" : ", \"" + property + "\"") +
                    "\n";
  }

  void add_joint(size_t j) {
    const Joint& joint = clip_.skeleton.joints[j];
    EulerAngles near = {};
    text_ += "\tModel: " + std::to_string(joint_id(j)) + ", \"Model::" + joint.name +
             "\", \"LimbNode\" {\n\tVersion: 232\n\tProperties70:  {\n";
    add_number("RotationActive", "bool", "1");
    add_number("PreRotation", "Vector3D", vector(pre_angles(j)));
    add_number("Lcl Translation", "Lcl Translation", vector(position(j, joint.offset)));
    add_number("Lcl Rotation", "Lcl Rotation", vector(angles(j, joint.rest, near)));
    if (const auto scale = options_.scales.find(joint.name); scale != options_.scales.end()) {
      add_number("Lcl Scaling", "Lcl Scaling", vector(scale->second));
    }
    text_ += "\t}\n\t}\n";
    const auto parent = joint.parent < 0 ? 0 : joint_id(static_cast<size_t>(joint.parent));
    connect("OO", joint_id(j), parent);
  }

  void add_motion() {
    const std::string end = std::to_string(static_cast<int64_t>(
        (options_.first_key + (clip_.frames - 1) * clip_.frame_time) * kSecond));
    text_ += "\tAnimationStack: " + std::to_string(kStack) + ", \"AnimStack::" + options_.motion +
             "\", \"\" {\n\tProperties70:  {\n";
    add_number("LocalStop", "KTime", end);
    text_ += "\t}\n\t}\n\tAnimationLayer: " + std::to_string(kLayer) +
             ", \"AnimLayer::Base\", \"\" {\n\t}\n";
    connect("OO", kLayer, kStack);
    for (size_t j = 0; j < clip_.joints(); ++j) {
      std::vector<Vec3d> positions, turns;
      EulerAngles near = {};
      for (int f = 0; f < clip_.frames; ++f) {
        positions.push_back(position(j, clip_.pose(f).translations[j]));
        turns.push_back(angles(j, clip_.pose(f).rotations[j], near));
      }
      if (is_root(j)) add_curves(j, 0, "T", "Lcl Translation", positions);
      add_curves(j, 5, "R", "Lcl Rotation", turns);
      const auto scale = options_.scales.find(clip_.skeleton.joints[j].name);
      if (!options_.has_scale_keys || scale == options_.scales.end()) continue;
      add_curves(j, 10, "S", "Lcl Scaling", std::vector<Vec3d>(positions.size(), scale->second));
    }
  }

  void add_curves(size_t j, int what, const std::string& letter, const std::string& property,
                  const std::vector<Vec3d>& keys) {
    const int64_t node = node_id(j, what);
    text_ += "\tAnimationCurveNode: " + std::to_string(node) + ", \"AnimCurveNode::" + letter +
             "\", \"\" {\n\tProperties70:  {\n";
    for (const char* axis : {"X", "Y", "Z"}) add_number("d|" + std::string(axis), "Number", "0");
    text_ += "\t}\n\t}\n";
    connect("OO", node, kLayer);
    connect("OP", node, joint_id(j), property);
    for (int axis = 0; axis < 3; ++axis) {
      add_curve(node + 1 + axis, axis, keys);
      connect("OP", node + 1 + axis, node, "d|" + std::string(1, "XYZ"[axis]));
    }
  }

  void add_curve(int64_t id, int axis, const std::vector<Vec3d>& keys) {
    std::string times, values;
    for (size_t f = 0; f < keys.size(); ++f) {
      const double seconds = options_.first_key + static_cast<double>(f) * clip_.frame_time;
      const double value = axis == 0 ? keys[f].x : axis == 1 ? keys[f].y : keys[f].z;
      times += (f ? "," : "") + std::to_string(std::llround(seconds * kSecond));
      values += (f ? "," : "") + std::to_string(value);
    }
    const std::string count = std::to_string(keys.size());
    text_ += "\tAnimationCurve: " + std::to_string(id) +
             ", \"AnimCurve::\", \"\" {\n\t\tDefault: 0\n\t\tKeyVer: 4008\n\t\tKeyTime: *" + count +
             " {\n\t\t\ta: " + times + "\n\t\t}\n\t\tKeyValueFloat: *" + count +
             " {\n\t\t\ta: " + values + "\n\t\t}\n\t}\n";
  }

  const Clip& clip_;
  const FbxOptions options_;
  std::string text_, connections_;
};

// A clip in metres with +Y up as the text of an FBX file in the units and axes of the options.
inline std::string format_fbx(const Clip& clip, const FbxOptions& options = {}) {
  return FbxMaker(clip, options).make();
}

}  // namespace panache::test
