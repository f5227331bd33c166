#include "retarget/joint_pairs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "rig/figures.h"
#include "rig/joint_name.h"

namespace panache {

namespace {

// Files round: of offsets, relative to the body, and of quaternions.
constexpr float kSameOffset = 1e-4f, kSameTurn = 1e-4f;

// Each joint by its name; -1 for names that are not unique.
std::map<std::string, int> by_name(const Skeleton& skeleton) {
  std::map<std::string, int> joints;
  for (size_t j = 0; j < skeleton.joints.size(); ++j) {
    const auto [other, is_new] = joints.emplace(skeleton.joints[j].name, static_cast<int>(j));
    if (!is_new) other->second = -1;
  }
  return joints;
}

bool same_turn(Quat a, Quat b) { return length((conjugate(a) * b).xyz()) < kSameTurn; }

// The rotation of what is above a joint at rest, Y up.
Quat above_at_rest(const Skeleton& skeleton, const Rig& rig, int joint) {
  Quat turn;
  for (int up = skeleton.joints[joint].parent; up >= 0; up = skeleton.joints[up].parent) {
    turn = skeleton.joints[up].rest * turn;
  }
  return turn_up(rig.up_axis()).value_or(Quat{}) * turn;
}

float legs_of(const Skeleton& skeleton, const Rig& rig) {
  const auto reach = [&](HumanJoint joint) {
    const int found = rig.joints()[index(joint)];
    return found < 0 ? 0 : length(skeleton.joints[found].offset);
  };
  return reach(HumanJoint::left_lower_leg) + reach(HumanJoint::right_lower_leg);
}

class Matcher {
 public:
  Matcher(const Skeleton& from, const Rig& from_rig, const Skeleton& onto, const Rig& onto_rig)
      : from_(from), from_rig_(from_rig), onto_(onto), onto_rig_(onto_rig) {}

  std::optional<SameSkeleton> match() {
    const float from_legs = legs_of(from_, from_rig_), onto_legs = legs_of(onto_, onto_rig_);
    if (!(from_legs > 0 && onto_legs > 0)) return std::nullopt;
    out_.scale = onto_legs / from_legs;
    // A ratio of 1 that was rounded would change every number.
    if (std::abs(out_.scale - 1) < kSameOffset) out_.scale = 1;
    const bool in_order = by_order();
    if (!in_order && !by_names()) return std::nullopt;
    for (int j = 0; j < kHumanJoints; ++j) {
      const int joint = onto_rig_.joints()[j], of = from_rig_.joints()[j];
      if ((joint < 0 ? -1 : out_.from[joint]) != of) return std::nullopt;
    }
    return fits() ? std::optional(out_) : std::nullopt;
  }

 private:
  bool by_order() {
    if (from_.joints.size() != onto_.joints.size()) return false;
    for (size_t j = 0; j < onto_.joints.size(); ++j) {
      if (from_.joints[j].name != onto_.joints[j].name) return false;
      out_.from.push_back(static_cast<int>(j));
    }
    return true;
  }
  bool by_names() {
    const std::map<std::string, int> from = by_name(from_), onto = by_name(onto_);
    out_.from.clear();
    for (const Joint& joint : onto_.joints) {
      const auto found = from.find(joint.name);
      const bool unique = onto.at(joint.name) >= 0;
      out_.from.push_back(found == from.end() || !unique ? -1 : found->second);
    }
    return true;
  }

  bool fits() const {
    const float size = legs_of(onto_, onto_rig_);
    std::vector<char> used(from_.joints.size());
    for (const int joint : out_.from) {
      if (joint >= 0) used[joint] = 1;
    }
    for (size_t j = 0; j < onto_.joints.size(); ++j) {
      const Joint& joint = onto_.joints[j];
      const int above = joint.parent < 0 ? -1 : out_.from[joint.parent];
      if (out_.from[j] < 0) {
        if (!carries_matches(j)) return false;
        continue;
      }
      const Joint& other = from_.joints[out_.from[j]];
      if (joint.parent >= 0 && out_.from[joint.parent] < 0 && has_match_above(joint.parent)) {
        return false;
      }
      if (above >= 0 && other.parent != above) return false;
      if (length(joint.offset - other.offset * out_.scale) > kSameOffset * size) return false;
      if (above < 0) {
        if (other.parent >= 0 && used[other.parent]) return false;
        const Quat turn = above_at_rest(onto_, onto_rig_, static_cast<int>(j));
        if (!same_turn(turn, above_at_rest(from_, from_rig_, out_.from[j]))) return false;
        continue;
      }
      if (!same_turn(joint.rest, other.rest)) return false;
    }
    for (size_t j = 0; j < used.size(); ++j) {
      const int parent = from_.joints[j].parent;
      if (!used[j] && parent >= 0 && used[parent] && has_users_below(used, j)) return false;
    }
    return true;
  }
  // Whether a matched joint of the character hangs below `joint`.
  bool carries_matches(size_t joint) const {
    std::vector<char> below(onto_.joints.size());
    below[joint] = 1;
    for (size_t j = joint + 1; j < below.size(); ++j) {
      const int parent = onto_.joints[j].parent;
      below[j] = parent >= 0 && below[parent];
      if (below[j] && out_.from[j] >= 0) return true;
    }
    return false;
  }
  bool has_match_above(int joint) const {
    for (; joint >= 0; joint = onto_.joints[joint].parent) {
      if (out_.from[joint] >= 0) return true;
    }
    return false;
  }
  // Whether a matched joint of the motion hangs below `joint`, which is not.
  bool has_users_below(const std::vector<char>& used, size_t joint) const {
    std::vector<char> below(used.size());
    below[joint] = 1;
    for (size_t j = joint + 1; j < used.size(); ++j) {
      const int parent = from_.joints[j].parent;
      below[j] = parent >= 0 && below[parent];
      if (below[j] && used[j]) return true;
    }
    return false;
  }

  const Skeleton& from_;
  const Rig& from_rig_;
  const Skeleton& onto_;
  const Rig& onto_rig_;
  SameSkeleton out_;
};

}  // namespace

std::optional<SameSkeleton> find_same_skeleton(const Skeleton& from, const Rig& from_rig,
                                               const Skeleton& onto, const Rig& onto_rig) {
  return Matcher(from, from_rig, onto, onto_rig).match();
}

void copy_pose(const SameSkeleton& same, const Skeleton& onto, ConstPose from, Pose out) {
  for (size_t j = 0; j < onto.joints.size(); ++j) {
    const int joint = same.from[j];
    out.rotations[j] = joint < 0 ? onto.joints[j].rest : from.rotations[joint];
    out.translations[j] = joint < 0 ? onto.joints[j].offset : from.translations[joint] * same.scale;
  }
}

namespace {

// A human joint, and the name of a row below it: a finger or the twist joints.
using Row = std::pair<int, std::string>;

// "thumb", "index", ... from the name; 3ds Max numbers fingers from 0 and their joints by a second
// digit ("Finger11"), Rokoko numbers digits from 1.
std::string finger_of(const JointName& name) {
  static constexpr std::array<std::string_view, 5> kFingers = {"thumb", "index", "middle", "ring",
                                                               "little"};
  if (has_any(name, {"ik", "target"})) return "";
  // A thumb begins in the palm, other fingers further out.
  if (name.has("thumb")) return "thumb";
  if (has_any(name, {"metacarpal", "carpal", "palm"})) return "";
  for (const std::string_view finger : kFingers) {
    if (name.has(finger)) return std::string(finger);
  }
  if (name.has("mid")) return "middle";
  if (name.has("pinky")) return "little";
  for (size_t i = 0; i + 1 < name.words.size(); ++i) {
    const bool from_0 = name.words[i] == "finger", from_1 = name.words[i] == "digit";
    if (!from_0 && !from_1) continue;
    const int number = name.words[i + 1].front() - '0' - (from_1 ? 1 : 0);
    if (number >= 0 && number < 5) return std::string(kFingers[number]);
  }
  return "";
}

// The joints of each row, from the body outwards.
std::map<Row, std::vector<int>> find_rows(const Skeleton& skeleton, const Rig& rig) {
  std::vector<int> human(skeleton.joints.size(), -1);
  for (int j = 0; j < kHumanJoints; ++j) {
    if (rig.joints()[j] >= 0) human[rig.joints()[j]] = j;
  }
  std::map<Row, std::vector<int>> rows;
  for (size_t i = 0; i < skeleton.joints.size(); ++i) {
    const Joint& joint = skeleton.joints[i];
    if (human[i] >= 0 || joint.parent < 0) continue;
    human[i] = human[joint.parent];
    if (human[i] < 0 || !joint.can_rotate) continue;
    const JointName name = parse_joint_name(joint.role.empty() ? joint.name : joint.role);
    const bool on_hand =
        human[i] == index(HumanJoint::left_hand) || human[i] == index(HumanJoint::right_hand);
    std::string row = on_hand ? finger_of(name) : "";
    if (row.empty() && has_any(name, {"twist", "roll"})) row = "twist";
    if (!row.empty()) rows[{human[i], row}].push_back(static_cast<int>(i));
  }
  return rows;
}

}  // namespace

std::vector<std::pair<int, std::string>> find_fingers(const Skeleton& skeleton, const Rig& rig) {
  std::vector<std::pair<int, std::string>> fingers;
  for (const auto& [row, joints] : find_rows(skeleton, rig)) {
    if (row.second != "twist") fingers.push_back(row);
  }
  return fingers;
}

std::vector<JointPair> find_further_joints(const Skeleton& from, const Rig& from_rig,
                                           const Skeleton& onto, const Rig& onto_rig) {
  const auto rows = find_rows(from, from_rig);
  std::vector<JointPair> pairs;
  for (const auto& [row, joints] : find_rows(onto, onto_rig)) {
    const auto other = rows.find(row);
    if (other == rows.end()) continue;
    if (row.second == "twist" && other->second.size() != joints.size()) continue;
    for (size_t k = 0; k < std::min(joints.size(), other->second.size()); ++k) {
      pairs.push_back({other->second[k], joints[k], row.first});
    }
  }
  std::sort(pairs.begin(), pairs.end(),
            [](const JointPair& a, const JointPair& b) { return a.onto < b.onto; });
  return pairs;
}

}  // namespace panache
