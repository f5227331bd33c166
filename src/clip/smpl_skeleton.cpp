#include "clip/smpl.h"

#include <array>
#include <cassert>
#include <string_view>

namespace panache {
namespace {

struct Line {
  std::string_view name;  // '*' stands for "left" or "right".
  std::string_view role;
  std::string_view parent;
  Vec3 position;  // Left side, in the model's frame.
};

// In the order of the models: for each '*', left before right.
constexpr Line kBody[] = {
    {"pelvis", "hips", "", {0, -0.22f, 0.03f}},
    {"*_hip", "*UpperLeg", "pelvis", {0.07f, -0.315f, 0.02f}},
    {"spine1", "spine", "pelvis", {0, -0.115f, 0}},
    {"*_knee", "*LowerLeg", "*_hip", {0.105f, -0.695f, 0.015f}},
    {"spine2", "chest", "spine1", {0, 0.02f, 0.005f}},
    {"*_ankle", "*Foot", "*_knee", {0.09f, -1.09f, -0.025f}},
    {"spine3", "upperChest", "spine2", {0, 0.075f, 0.03f}},
    {"*_foot", "*Toes", "*_ankle", {0.115f, -1.145f, 0.095f}},
    {"neck", "neck", "spine3", {0, 0.29f, -0.015f}},
    {"*_collar", "*Shoulder", "spine3", {0.08f, 0.195f, -0.01f}},
    {"head", "head", "neck", {0, 0.355f, 0.035f}},
    {"*_shoulder", "*UpperArm", "*_collar", {0.175f, 0.225f, -0.015f}},
    {"*_elbow", "*LowerArm", "*_shoulder", {0.43f, 0.215f, -0.04f}},
    {"*_wrist", "*Hand", "*_elbow", {0.68f, 0.22f, -0.045f}},
};
constexpr Line kPalms[] = {{"*_hand", "", "*_wrist", {0.765f, 0.215f, -0.06f}}};
constexpr Line kFace[] = {{"jaw", "jaw", "head", {0, 0.34f, 0.045f}},
                          {"*_eye_smplhf", "*Eye", "head", {0.03f, 0.4f, 0.105f}}};

struct Finger {
  std::string_view name, role;
  Vec3 base, along;  // From the wrist; from part to part.
};
constexpr Finger kFingers[] = {
    {"index", "Index", {0.1f, -0.01f, 0.02f}, {0.03f, 0, 0}},
    {"middle", "Middle", {0.11f, 0, 0}, {0.03f, 0, 0}},
    {"pinky", "Little", {0.085f, -0.015f, -0.04f}, {0.02f, 0, 0}},
    {"ring", "Ring", {0.1f, -0.005f, -0.02f}, {0.03f, 0, 0}},
    {"thumb", "Thumb", {0.04f, -0.015f, 0.025f}, {0.025f, -0.01f, 0.025f}}};

std::string on_side(std::string_view text, std::string_view side) {
  std::string out;
  for (const char c : text) out += c == '*' ? std::string(side) : std::string(1, c);
  return out;
}

class Builder {
 public:
  void add(const Line& line) {
    if (line.name.front() != '*') return add(line, "", 1);
    add(line, "left", 1);
    add(line, "right", -1);
  }

  void add_hand(std::string_view side, float sign) {
    for (const Finger& finger : kFingers) {
      int parent = find(std::string(side) + "_wrist");
      for (size_t part = 0; part < 3; ++part) {
        const bool thumb = finger.role == "Thumb";
        const std::string_view roles[] = {thumb ? "Metacarpal" : "Proximal",
                                          thumb ? "Proximal" : "Intermediate", "Distal"};
        const Vec3 offset = part == 0 ? finger.base : finger.along;
        add(std::string(side) + "_" + std::string(finger.name) + std::to_string(part + 1),
            std::string(side) + std::string(finger.role) + std::string(roles[part]), parent,
            {sign * offset.x, offset.y, offset.z});
        parent = static_cast<int>(out_.joints.size()) - 1;
      }
    }
  }

  Skeleton take() { return std::move(out_); }

 private:
  void add(const Line& line, std::string_view side, float sign) {
    const int parent = line.parent.empty() ? -1 : find(on_side(line.parent, side));
    const Vec3 position = {sign * line.position.x, line.position.y, line.position.z};
    const Vec3 above = parent < 0 ? Vec3{} : positions_[parent];
    add(on_side(line.name, side), on_side(line.role, side), parent, position - above);
  }

  void add(std::string name, std::string role, int parent, Vec3 offset) {
    Joint joint;
    joint.name = std::move(name);
    joint.role = std::move(role);
    joint.parent = parent;
    joint.offset = offset;
    joint.can_rotate = true;
    joint.can_translate = parent < 0;
    positions_.push_back(parent < 0 ? offset : positions_[parent] + offset);
    out_.joints.push_back(std::move(joint));
  }

  int find(const std::string& name) const {
    for (size_t j = 0; j < out_.joints.size(); ++j) {
      if (out_.joints[j].name == name) return static_cast<int>(j);
    }
    assert(false);
    return -1;
  }

  Skeleton out_;
  std::vector<Vec3> positions_;  // [joints]
};

}  // namespace

Skeleton smpl_skeleton(size_t joints) {
  assert(joints == kSmplJoints || joints == kSmplHJoints || joints == kSmplXJoints);
  Builder builder;
  for (const Line& line : kBody) builder.add(line);
  if (joints == kSmplJoints) {
    for (const Line& line : kPalms) builder.add(line);
    return builder.take();
  }
  if (joints == kSmplXJoints) {
    for (const Line& line : kFace) builder.add(line);
  }
  builder.add_hand("left", 1);
  builder.add_hand("right", -1);
  return builder.take();
}

}  // namespace panache
