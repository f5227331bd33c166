#include "clip/gltf_document.h"

#include <map>
#include <optional>
#include <string>

#include "clip/clip.h"

namespace panache {
namespace {

class Straightener {
 public:
  explicit Straightener(const Clip& rest)
      : joints_(rest.skeleton.joints),
        rotations_(rest.joints()),
        positions_(rest.joints()),
        turns_(rest.joints()) {
    world_pose(rest.skeleton, rest.pose(0), {rotations_, positions_});
    for (size_t j = 0; j < joints_.size(); ++j) {
      if (!joints_[j].role.empty()) by_role_.emplace(joints_[j].role, j);
    }
  }

  // With R a joint's rest rotation in the world and T the rotation from the rest pose to the T-pose
  // there, a child at p from the joint moves to T p, which is R^-1 T p in the joint's axes.
  std::vector<Vec3> run() {
    std::vector<Vec3> offsets;
    for (size_t j = 0; j < joints_.size(); ++j) {
      const int parent = joints_[j].parent;
      if (parent < 0) {
        offsets.push_back(joints_[j].offset);
      } else {
        const auto p = static_cast<size_t>(parent);
        const Vec3 along = rotate(turns_[p], positions_[j] - positions_[p]);
        offsets.push_back(turns_[p] == Quat{} ? joints_[j].offset
                                              : rotate(conjugate(rotations_[p]), along));
        turns_[j] = turns_[p];
      }
      find_turn(j);
    }
    return offsets;
  }

 private:
  // The vector from one role's joint to another's; nothing if one is missing.
  std::optional<Vec3> between(const std::string& from, const std::string& to) const {
    const auto a = by_role_.find(from), b = by_role_.find(to);
    if (a == by_role_.end() || b == by_role_.end()) return std::nullopt;
    return positions_[b->second] - positions_[a->second];
  }
  std::optional<Vec3> between_first(const std::string& from,
                                    std::initializer_list<const char*> to) const {
    for (const char* role : to) {
      if (const auto offset = between(from, role)) return offset;
    }
    return std::nullopt;
  }

  void find_turn(size_t joint) {
    const std::string& role = joints_[joint].role;
    if (role == "hips") return turn_torso(joint, "UpperLeg", {"neck", "head"});
    if (role == "chest" || role == "upperChest") {
      return turn_torso(joint, "UpperArm", {"neck", "head"});
    }
    if (role == "neck") return turn_torso(joint, "", {"head"});
    for (const char* side : {"left", "right"}) {
      if (!role.starts_with(side)) continue;
      turn_limb(joint, side, role.substr(std::string(side).size()));
    }
  }

  // Makes the torso upright, and its right and left joint lie along x. Spines curve by less.
  void turn_torso(size_t joint, const std::string& pair, std::initializer_list<const char*> top) {
    constexpr float kCosine = 0.866f;
    const std::optional<Vec3> up = between_first(joints_[joint].role, top);
    const std::optional<Vec3> across =
        pair.empty() ? std::nullopt : between("right" + pair, "left" + pair);
    Quat& turn = turns_[joint];
    Vec3 y = up ? normalized(rotate(turn, *up), {0, 1, 0}) : Vec3{0, 1, 0};
    Vec3 x = across ? rotate(turn, *across) : Vec3{1, 0, 0};
    x = normalized(x - y * dot(x, y), {1, 0, 0});
    if (y.y > kCosine && (!across || x.x > kCosine)) return;
    if (!across) {
      turn = normalized(rotation_between(y, {0, 1, 0}) * turn);
      return;
    }
    turn = normalized(conjugate(from_axes(x, y, cross(x, y))) * turn);
  }

  void turn_limb(size_t joint, const std::string& side, const std::string& part) {
    const Vec3 out = {side == "left" ? 1.0f : -1.0f, 0, 0};
    const auto point = [&](const std::string& to, Vec3 wanted) {
      const std::optional<Vec3> offset = between(side + part, side + to);
      if (!offset || !(length(*offset) > 1e-6f)) return;
      const Vec3 now = normalized(rotate(turns_[joint], *offset));
      if (now == wanted) return;
      turns_[joint] = normalized(rotation_between(now, wanted) * turns_[joint]);
    };
    if (part == "UpperArm") return point("LowerArm", out);
    if (part == "LowerArm") return point("Hand", out);
    if (part == "Hand") return point("MiddleProximal", out);
    if (part == "UpperLeg") return point("LowerLeg", {0, -1, 0});
    if (part == "LowerLeg") return point("Foot", {0, -1, 0});
    if (part == "Foot") turn_foot(joint, side);
  }

  // Turns the foot ahead and keeps its slope.
  void turn_foot(size_t joint, const std::string& side) {
    const std::optional<Vec3> offset = between(side + "Foot", side + "Toes");
    if (!offset) return;
    const Vec3 now = rotate(turns_[joint], *offset);
    const Vec3 level = {now.x, 0, now.z};
    if (!(length(level) > 0.1f * length(now)) || now.x == 0) return;
    turns_[joint] = normalized(rotation_between(normalized(level), {0, 0, 1}) * turns_[joint]);
  }

  const std::vector<Joint>& joints_;
  std::vector<Quat> rotations_;  // [joints] At rest, in the world.
  std::vector<Vec3> positions_;  // [joints] At rest, in the world.
  std::vector<Quat> turns_;      // [joints] From the rest pose to the T-pose, in the world.
  std::map<std::string, size_t> by_role_;
};

}  // namespace

std::vector<Vec3> t_pose_offsets(const Clip& rest) { return Straightener(rest).run(); }

void stand_in_t_pose(const std::vector<Vec3>& offsets, Clip& clip) {
  std::vector<char> below(clip.joints());  // 1 for joints below the hips.
  for (size_t j = 0; j < clip.joints(); ++j) {
    Joint& joint = clip.skeleton.joints[j];
    if (joint.parent < 0) continue;
    const auto p = static_cast<size_t>(joint.parent);
    below[j] = below[p] || clip.skeleton.joints[p].role == "hips";
    joint.offset = offsets[j];
    if (!below[j]) continue;
    joint.can_translate = false;
    for (int f = 0; f < clip.frames; ++f) clip.pose(f).translations[j] = offsets[j];
  }
}

}  // namespace panache
