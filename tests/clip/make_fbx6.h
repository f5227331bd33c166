#pragma once
// FBX 6.1 files in text form for tests, made in memory from a clip in metres with +Y up. All parts
// of a joint's transform are used, each with numbers of its own for each joint.

#include <cmath>
#include <cstdint>
#include <map>
#include <string>

#include "clip/clip.h"
#include "clip/euler.h"

namespace panache::test {

class Fbx6Maker {
 public:
  // `order` is the file's number of a rotation order, 0 to 5, of all joints but the roots; their
  // own is 0, as they are not "active". `unit` is centimetres. `scales` are those of the joints so
  // called, at rest and in keys, as they are in the clip's axes.
  Fbx6Maker(const Clip& clip, int order, double unit, std::map<std::string, Vec3d> scales = {})
      : clip_(clip), order_(order), unit_(unit), scales_(std::move(scales)) {}

  std::string make() {
    text_ =
        "; FBX 6.1.0 project file\nFBXHeaderExtension:  {\n\tFBXVersion: 6100\n}\nObjects:  {\n";
    for (size_t j = 0; j < clip_.joints(); ++j) add_joint(j);
    text_ +=
        "\tModel: \"Model::Producer Front\", \"Camera\" {\n\t}\n\tGlobalSettings:  {\n"
        "\t\tProperties60:  {\n";
    property("UpAxis", "int", "1");
    property("UnitScaleFactor", "double", text(unit_));
    text_ += "\t\t}\n\t}\n}\nConnections:  {\n" + connections_ +
             "}\nTakes:  {\n\tCurrent: \"Walk\"\n\tTake: \"Walk\" {\n";
    for (size_t j = 0; j < clip_.joints(); ++j) add_channels(j);
    text_ += "\t}\n}\nVersion5:  {\n\tSettings:  {\n\t\tFrameRate: \"30\"\n\t}\n}\n";
    return text_;
  }

 private:
  static std::string text(double value) {
    char out[40];
    std::snprintf(out, sizeof out, "%.9f", value);
    return out;
  }
  static std::string text(Vec3d v) { return text(v.x) + "," + text(v.y) + "," + text(v.z); }

  void property(const std::string& name, const std::string& type, const std::string& value) {
    text_ += "\t\t\tProperty: \"" + name + "\", \"" + type + "\", \"A+\"," + value + "\n";
  }

  bool is_root(size_t j) const { return clip_.skeleton.joints[j].parent < 0; }
  // X first is R = Rz Ry Rx.
  EulerOrder order(size_t j) const {
    constexpr EulerOrder kOrders[] = {{3, {2, 1, 0}}, {3, {1, 2, 0}}, {3, {0, 2, 1}},
                                      {3, {2, 0, 1}}, {3, {1, 0, 2}}, {3, {0, 1, 2}}};
    return kOrders[is_root(j) ? 0 : order_];
  }
  static Quatd turned(Vec3d degrees) {
    return euler_to_quat({3, {2, 1, 0}}, {degrees.z, degrees.y, degrees.x});
  }
  static Vec3d own(size_t j, double a, double b, double c) {
    const double k = 1 + static_cast<double>(j % 3);
    return {a * k, b * k, c * k};
  }
  Vec3d scale(size_t j) const {
    const auto found = scales_.find(clip_.skeleton.joints[j].name);
    return found == scales_.end() ? Vec3d{1, 1, 1} : found->second;
  }
  static Vec3d pre(size_t j) { return own(j, 10, -20, 15); }
  static Vec3d post(size_t j) { return own(j, -5, 12, 25); }
  static Vec3d pivot(size_t j) { return own(j, 1, -2, 3); }
  static Vec3d offset(size_t j) { return own(j, 0.5, 1.5, -1); }

  // The place is T + Roff + Rp - (Rpre R Rpost^-1) Rp where there is no scale.
  Vec3d position(size_t j, Vec3 metres, Quat rotation) const {
    const Vec3d there = metres.as<double>() * (100 / unit_);
    return there - offset(j) - pivot(j) + rotate(rotation.as<double>(), pivot(j));
  }
  Vec3d angles(size_t j, Quat rotation, EulerAngles& near) const {
    Quatd inner = rotation.as<double>();
    if (!is_root(j)) inner = conjugate(turned(pre(j))) * inner * turned(post(j));
    near = quat_to_euler(order(j), inner, near);
    double out[3];
    for (size_t i = 0; i < 3; ++i) out[order(j).axis[i]] = near[i];
    return {out[0], out[1], out[2]};
  }

  void add_joint(size_t j) {
    const Joint& joint = clip_.skeleton.joints[j];
    EulerAngles near = {};
    text_ += "\tModel: \"Model::" + joint.name +
             "\", \"Limb\" {\n\t\tVersion: 232\n\t\tProperties60:  {\n";
    property("RotationActive", "bool", is_root(j) ? "0" : "1");
    property("RotationOrder", "enum", std::to_string(order_));
    property("PreRotation", "Vector3D", text(pre(j)));
    property("PostRotation", "Vector3D", text(post(j)));
    property("RotationOffset", "Vector3D", text(offset(j)));
    property("RotationPivot", "Vector3D", text(pivot(j)));
    property("Lcl Translation", "Lcl Translation", text(position(j, joint.offset, joint.rest)));
    property("Lcl Rotation", "Lcl Rotation", text(angles(j, joint.rest, near)));
    property("Lcl Scaling", "Lcl Scaling", text(scale(j)));
    text_ += "\t\t}\n\t}\n";
    const std::string parent =
        is_root(j) ? "Scene" : clip_.skeleton.joints[static_cast<size_t>(joint.parent)].name;
    connections_ += "\tConnect: \"OO\", \"Model::" + joint.name + "\", \"Model::" + parent + "\"\n";
  }

  void add_channels(size_t j) {
    text_ += "\t\tModel: \"Model::" + clip_.skeleton.joints[j].name +
             "\" {\n\t\t\tChannel: \"Transform\" {\n";
    std::vector<Vec3d> positions, turns;
    EulerAngles near = {};
    for (int f = 0; f < clip_.frames; ++f) {
      const Quat rotation = clip_.pose(f).rotations[j];
      positions.push_back(position(j, clip_.pose(f).translations[j], rotation));
      turns.push_back(angles(j, rotation, near));
    }
    add_channel("T", positions);
    add_channel("R", turns);
    if (!scales_.empty()) add_channel("S", std::vector<Vec3d>(turns.size(), scale(j)));
    text_ += "\t\t\t}\n\t\t}\n";
  }

  void add_channel(const std::string& letter, const std::vector<Vec3d>& values) {
    // Ways in which keys go on, each with what programs write behind its letter.
    static constexpr const char* kInterpolations[] = {",L", ",U,s,0,-1.5,n", ",C,n",
                                                      ",U,a,0.333,0.333"};
    text_ += "\t\t\t\tChannel: \"" + letter + "\" {\n";
    for (int axis = 0; axis < 3; ++axis) {
      text_ += std::string("\t\t\t\t\tChannel: \"") + "XYZ"[axis] +
               "\" {\n\t\t\t\t\t\tDefault: 0\n\t\t\t\t\t\tKeyVer: 4005\n\t\t\t\t\t\tKeyCount: " +
               std::to_string(values.size()) + "\n\t\t\t\t\t\tKey: ";
      for (size_t f = 0; f < values.size(); ++f) {
        const Vec3d v = values[f];
        const double seconds = 2 + static_cast<double>(f) * clip_.frame_time;
        text_ += (f ? ",\n\t\t\t\t\t\t\t" : "") +
                 std::to_string(std::llround(seconds * 46'186'158'000)) + "," +
                 text(axis == 0   ? v.x
                      : axis == 1 ? v.y
                                  : v.z) +
                 kInterpolations[(f + j_) % 4];
      }
      text_ += "\n\t\t\t\t\t}\n";
    }
    ++j_;
    text_ += "\t\t\t\t}\n";
  }

  const Clip& clip_;
  const int order_;
  const double unit_;
  const std::map<std::string, Vec3d> scales_;
  size_t j_ = 0;
  std::string text_, connections_;
};

}  // namespace panache::test
