#include "rig/other_creature.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "rig/joint_name.h"
#include "rig/joint_words.h"

namespace panache {
namespace {

using enum HumanJoint;

// From hips to shoulders, in legs: a person has 0.5, a child or a dwarf 0.4 and more.
constexpr float kShortestTrunk = 0.15f;
// The distance of hip and foot of a straight leg, in lengths of it: a rest pose has 0.95 and more.
constexpr float kAlwaysBent = 0.75f;
// Height of hands above the feet, in heights of the hips.
constexpr float kHandsOnGround = 0.2f;
// A further limb is so long, and its tip so far beside the body, in legs; both sides are alike.
constexpr float kLongLimb = 0.5f, kFarTip = 0.6f, kLimbsAlike = 0.12f;

bool is_of_animal(const JointName& name) {
  constexpr const char* kAnimal[] = {"wing",     "wings",   "paw",      "hoof", "fetlock",
                                     "hock",     "pastern", "flipper",  "fin",  "tentacle",
                                     "mandible", "pincer",  "chelicera"};
  return std::any_of(std::begin(kAnimal), std::end(kAnimal),
                     [&](const char* word) { return name.has(word); });
}
bool is_limb(const JointName& name) {
  return is_of_animal(name) || is_hand(name) || is_foot(name) || is_forearm(name) ||
         is_shin(name) || name.has("leg") || name.has("arm") || name.has("limb");
}

class Creature {
 public:
  Creature(const Skeleton& skeleton, std::span<const JointPositions> poses, const Mapping& mapping)
      : skeleton_(skeleton),
        poses_(poses),
        tree_(skeleton, poses),
        joint_of_(mapping.joint_of),
        leg_(tree_.distance(at(left_upper_leg), at(left_lower_leg)) +
             tree_.distance(at(left_lower_leg), at(left_foot))) {
    for (const Joint& joint : skeleton.joints) {
      names_.push_back(parse_joint_name(joint.role.empty() ? joint.name : joint.role));
    }
    by_shape_ = mapping.reasons[index(left_upper_leg)].starts_with("by the skeleton's shape");
  }

  // What is not a person's; empty if nothing is.
  std::string oddity() const {
    for (int j = index(left_upper_arm); j <= index(right_toes); ++j) {
      if (joint_of_[j] < 0 || !is_of_animal(names_[joint_of_[j]])) continue;
      return std::string(human_joint_name(j)) + " would be " + quoted(joint_of_[j]);
    }
    if (!(leg_ > 0)) return "";
    const auto in_all = [&](auto holds) {
      return std::all_of(poses_.begin(), poses_.end(), holds);
    };
    if (in_all([&](const JointPositions& pose) {
          return length(trunk(pose)) < kShortestTrunk * leg_;
        })) {
      return "arms and legs leave the body at one place";
    }
    if (by_shape_ &&
        in_all([&](const JointPositions& pose) { return straightest_leg(pose) < kAlwaysBent; })) {
      return "the legs are never straight";
    }
    if (in_all([&](const JointPositions& pose) { return is_on_hands(pose); })) {
      return "the hands are always on the ground";
    }
    const int further = further_limb();
    return further < 0 ? "" : "there are more limbs, such as " + quoted(further);
  }

 private:
  int at(HumanJoint joint) const { return joint_of_[index(joint)]; }
  std::string quoted(int joint) const { return "'" + skeleton_.joints[joint].name + "'"; }

  Vec3 middle(const JointPositions& pose, HumanJoint left, HumanJoint right) const {
    return (pose[at(left)] + pose[at(right)]) * 0.5f;
  }
  Vec3 trunk(const JointPositions& pose) const {
    return middle(pose, left_upper_arm, right_upper_arm) -
           middle(pose, left_upper_leg, right_upper_leg);
  }
  float straightest_leg(const JointPositions& pose) const {
    float max = 0;
    for (const auto& [hip, knee, foot] :
         {std::array{left_upper_leg, left_lower_leg, left_foot},
          std::array{right_upper_leg, right_lower_leg, right_foot}}) {
      const float whole =
          length(pose[at(hip)] - pose[at(knee)]) + length(pose[at(knee)] - pose[at(foot)]);
      max = std::max(max, length(pose[at(hip)] - pose[at(foot)]) / std::max(whole, 1e-9f));
    }
    return max;
  }
  // Up is from the feet to the hips.
  bool is_on_hands(const JointPositions& pose) const {
    if (at(left_hand) < 0 || at(right_hand) < 0) return false;
    const Vec3 feet = middle(pose, left_foot, right_foot);
    const Vec3 up = middle(pose, left_upper_leg, right_upper_leg) - feet;
    const float height = length(up);
    const auto above = [&](HumanJoint hand) { return dot(pose[at(hand)] - feet, up) / height; };
    return std::abs(above(left_hand)) < kHandsOnGround * height &&
           std::abs(above(right_hand)) < kHandsOnGround * height;
  }

  bool is_mapped_limb(int joint) const {
    for (int j = index(left_shoulder); j <= index(right_toes); ++j) {
      if (joint_of_[j] == joint) return true;
    }
    return false;
  }
  // Whether the joint is above a limb of the body, or its head.
  bool is_trunk(int joint) const {
    for (const int tip : joint_of_) {
      if (tip >= 0 && tree_.is_above(joint, tip)) return true;
    }
    return false;
  }

  // How far the tip of the chain below a joint is from the axis of the trunk, at rest.
  float beside_body(int joint) const {
    const JointPositions& pose = poses_.front();
    const Vec3 tip = pose[farthest_tip(joint)] - middle(pose, left_upper_leg, right_upper_leg);
    const Vec3 up = normalized(trunk(pose));
    return length(tip - up * dot(tip, up));
  }
  int farthest_tip(int joint) const {
    int tip = joint;
    for (bool more = true; more;) {
      more = false;
      for (const int child : tree_.children(tip)) {
        if (tree_.distance(tip, child) + tree_.reach(child) < 0.999f * tree_.reach(tip)) continue;
        tip = child;
        more = true;
        break;
      }
    }
    return tip;
  }

  // A joint of the trunk with two long, even chains of joints that no limb of the mapping has and
  // whose tips are far out; where names tell the limbs, they must be named as limbs. A skirt, hair
  // and a cape are near the body. -1 if there is none.
  int further_limb() const {
    for (int joint = 0; joint < tree_.count(); ++joint) {
      if (!is_trunk(joint) || is_mapped_limb(joint)) continue;
      std::vector<std::pair<float, int>> chains;
      for (const int child : tree_.children(joint)) {
        if (is_trunk(child) || tree_.children(child).empty()) continue;
        if (!by_shape_ && !names_limb(child)) continue;
        const float reach = tree_.distance(joint, child) + tree_.reach(child);
        if (reach > kLongLimb * leg_ && beside_body(child) > kFarTip * leg_) {
          chains.emplace_back(reach, child);
        }
      }
      std::sort(chains.begin(), chains.end());
      for (size_t i = 1; i < chains.size(); ++i) {
        if (chains[i - 1].first > (1 - kLimbsAlike) * chains[i].first) return chains[i].second;
      }
    }
    return -1;
  }
  bool names_limb(int joint) const {
    return is_limb(names_[joint]) && !is_near(names_[joint]) && !is_twist(names_[joint]) &&
           names_[joint].side != Side::none && !names_[joint].has("wing") &&
           !names_[joint].has("wings");
  }

  const Skeleton& skeleton_;
  std::span<const JointPositions> poses_;
  JointTree tree_;
  const std::array<int, kHumanJoints>& joint_of_;
  float leg_;
  std::vector<JointName> names_;
  bool by_shape_ = false;
};

}  // namespace

std::optional<Error> find_other_creature(const Skeleton& skeleton,
                                         std::span<const JointPositions> poses,
                                         const Mapping& mapping, const KnownJoints& known) {
  if (!known.empty()) return std::nullopt;
  const std::string oddity = Creature(skeleton, poses, mapping).oddity();
  if (oddity.empty()) return std::nullopt;
  return Error{"no person: " + oddity +
               "; expected a person's skeleton, with two arms above two legs, or a map that names "
               "the hips"};
}

}  // namespace panache
