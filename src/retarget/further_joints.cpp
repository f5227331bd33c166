#include "retarget/further_joints.h"

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "rig/joint_name.h"

namespace panache {
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
