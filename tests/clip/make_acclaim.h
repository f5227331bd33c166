#pragma once
// Motions as .asf and .amc, written for tests.

#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "clip/clip.h"
#include "clip/euler.h"

namespace panache::test {

// Writes the text of a skeleton and of its motion. Rest rotations are the identity. Each bone has
// an axis of its own, so that none of its numbers are those of its rotation in the skeleton's axes.
// A joint with several others below it gets a bone without a length, and each of those a bone
// without freedom that leads to it, as CMU's hips have.
class AcclaimMaker {
 public:
  explicit AcclaimMaker(const Clip& clip) : clip_(clip), children_(clip.joints()) {
    for (size_t j = 0; j < clip.joints(); ++j) {
      const int parent = clip.skeleton.joints[j].parent;
      if (parent >= 0) children_[static_cast<size_t>(parent)].push_back(j);
    }
  }

  std::string asf() {
    std::string bones, hierarchy;
    for (size_t j = 0; j < clip_.joints(); ++j) {
      const std::vector<size_t>& below = children_[j];
      const bool leads = below.size() == 1;
      const auto& ends = clip_.skeleton.joints[j].ends;
      const Vec3 tip = leads           ? clip_.skeleton.joints[below[0]].offset
                       : !ends.empty() ? ends[0]
                                       : Vec3{};
      if (j > 0) bones += bone(name(j), j > 0 ? tip : Vec3{}, axis(j), "dof rx ry rz\n");
      if (below.empty()) continue;
      hierarchy += name(j);
      for (const size_t child : below) {
        hierarchy += " " + (leads && j > 0 ? name(child) : name(child) + "_from_parent");
      }
      hierarchy += "\n";
      if (leads && j > 0) continue;
      for (const size_t child : below) {
        bones += bone(name(child) + "_from_parent", clip_.skeleton.joints[child].offset, {}, "");
        hierarchy += name(child) + "_from_parent " + name(child) + "\n";
      }
    }
    return "# made for a test\n:version 1.10\n:name NOBODY\n:units\n  mass 1.0\n  length 0.45\n"
           "  angle deg\n:documentation\n   nothing to say\n:root\n   order TX TY TZ RX RY RZ\n"
           "   axis XYZ\n   position 0 0 0\n   orientation 0 0 0\n:bonedata\n" +
           bones + ":hierarchy\n  begin\n" + hierarchy + "  end\n";
  }

  std::string amc() {
    std::string out = "#!OML:ASF nowhere\n:FULLY-SPECIFIED\n:DEGREES\n";
    for (int f = 0; f < clip_.frames; ++f) {
      out += std::to_string(f + 1) + "\n";
      const ConstPose pose = clip_.pose(f);
      for (size_t j = 0; j < clip_.joints(); ++j) {
        out += name(j);
        if (j == 0) out += text(pose.translations[0].as<double>());
        const Quatd axes = turned(j == 0 ? Vec3d{} : axis(j));
        const Quatd turn = conjugate(axes) * pose.rotations[j].as<double>() * axes;
        // Rz Ry Rx: x is the first to be applied, and stands first in the file.
        const EulerAngles deg = quat_to_euler({3, {2, 1, 0}}, turn, {});
        out += text({deg[2], deg[1], deg[0]}) + "\n";
      }
    }
    return out;
  }

  // CMU's name of a canonical joint; of any other its own.
  std::string name(size_t joint) const {
    if (joint == 0) return "root";
    static const std::map<std::string, std::string> kNames = {
        {"spine", "lowerback"},   {"chest", "thorax"},     {"neck", "lowerneck"},
        {"Shoulder", "clavicle"}, {"UpperArm", "humerus"}, {"LowerArm", "radius"},
        {"Hand", "hand"},         {"UpperLeg", "femur"},   {"LowerLeg", "tibia"},
        {"Foot", "foot"},         {"Toes", "toes"}};
    std::string own = clip_.skeleton.joints[joint].name, side;
    for (const std::string word : {"left", "right"}) {
      if (own.starts_with(word)) side = word[0], own = own.substr(word.size());
    }
    const auto known = kNames.find(own);
    return side + (known == kNames.end() ? own : known->second);
  }

 private:
  static Vec3d axis(size_t joint) {
    const auto j = static_cast<double>(joint);
    return {7 * j - 40, 30 - 5 * j, 3 * j};
  }
  static Quatd turned(Vec3d deg) {
    constexpr double kDegree = 3.14159265358979323846 / 180;
    return axis_angle(Vec3d{0, 0, 1}, deg.z * kDegree) *
           axis_angle(Vec3d{0, 1, 0}, deg.y * kDegree) *
           axis_angle(Vec3d{1, 0, 0}, deg.x * kDegree);
  }
  static std::string text(Vec3d v) {
    char out[100];
    std::snprintf(out, sizeof out, " %.7f %.7f %.7f", v.x, v.y, v.z);
    return out;
  }
  static std::string bone(const std::string& name, Vec3 tip, Vec3d axis, const std::string& more) {
    const double size = static_cast<double>(length(tip));
    const Vec3d direction = size > 0 ? tip.as<double>() / size : Vec3d{0, 1, 0};
    return "  begin\n     id 1\n     name " + name + "\n     direction" + text(direction) +
           "\n     length " + std::to_string(size) + "\n     axis" + text(axis) + "  XYZ\n" + more +
           (more.empty() ? "" : "    limits (-160.0 20.0)\n           (-70 70)\n (-60 70)\n") +
           "  end\n";
  }

  const Clip& clip_;
  std::vector<std::vector<size_t>> children_;
};

}  // namespace panache::test
