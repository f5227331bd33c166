#include "rig/doubtful.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "base/vec.h"
#include "rig/joint_name.h"

namespace panache {
namespace {

using enum HumanJoint;

constexpr const char* kCure =
    "; expected the joints that deform the mesh in one hierarchy, a map that says which these are, "
    "or the motion styled where its controls are";

// Blender's name for joints that carry a mesh.
bool deforms(const Skeleton& skeleton, int joint) {
  const JointName name = parse_joint_name(skeleton.joints[joint].name);
  return !name.words.empty() && name.words.front() == "def";
}

std::string quoted_name(const Skeleton& skeleton, int joint) {
  return "'" + skeleton.joints[joint].name + "'";
}

// From a joint up to before `end`.
std::vector<int> path_up(const Skeleton& skeleton, int joint, int end) {
  std::vector<int> path;
  for (int up = joint; up >= 0 && up != end; up = skeleton.joints[up].parent) {
    path.push_back(up);
  }
  return path;
}

bool is_at_or_below(const Skeleton& skeleton, int above, int joint) {
  while (joint > above) joint = skeleton.joints[joint].parent;
  return joint == above;
}

// Detects arms whose skin is also moved by joints that do not follow the hips: it would tear.
std::optional<Error> find_tear(const Skeleton& skeleton, int hips_joint, int arm) {
  constexpr float kMaxLeft = 0.25f;  // Share of the skin: a prop, a hem that follows the root.
  const std::vector<Joint>& joints = skeleton.joints;
  int skin = -1;
  for (size_t j = 0; j < joints.size() && skin < 0; ++j) {
    if (is_at_or_below(skeleton, arm, static_cast<int>(j))) skin = joints[j].skin;
  }
  if (skin < 0) return std::nullopt;
  float all = 0, left = 0;
  int max = -1;
  for (size_t j = 0; j < joints.size(); ++j) {
    if (joints[j].skin != skin) continue;
    all += joints[j].skin_weight;
    if (is_at_or_below(skeleton, hips_joint, static_cast<int>(j))) continue;
    left += joints[j].skin_weight;
    if (max < 0 || joints[j].skin_weight > joints[max].skin_weight) {
      max = static_cast<int>(j);
    }
  }
  if (!(left > kMaxLeft * all)) return std::nullopt;
  const auto percent = static_cast<int>(std::lround(100 * left / all));
  return Error{"doubtful: hips would be " + quoted_name(skeleton, hips_joint) +
               ", which does not move " + std::to_string(percent) +
               " % of the mesh of leftUpperArm " + quoted_name(skeleton, arm) +
               ", such as what follows " + quoted_name(skeleton, max) + kCure};
}

// Detects meshes that follow another skeleton of the file: the style would be invisible.
std::optional<Error> find_bare(const Skeleton& skeleton, int hips_joint) {
  constexpr std::ptrdiff_t kFewest = 11;  // Joints of a person; fewer carry a prop.
  const std::vector<Joint>& joints = skeleton.joints;
  const auto carries = [](const Joint& joint) { return joint.skin >= 0; };
  if (std::count_if(joints.begin(), joints.end(), carries) < kFewest) return std::nullopt;
  for (size_t j = 0; j < joints.size(); ++j) {
    const bool above = is_at_or_below(skeleton, static_cast<int>(j), hips_joint);
    const bool below = is_at_or_below(skeleton, hips_joint, static_cast<int>(j));
    if (carries(joints[j]) && (above || below)) return std::nullopt;
  }
  const auto first = std::find_if(joints.begin(), joints.end(), carries) - joints.begin();
  return Error{"doubtful: hips would be " + quoted_name(skeleton, hips_joint) +
               ", which moves no mesh; the mesh follows other joints, such as " +
               quoted_name(skeleton, static_cast<int>(first)) +
               "; expected a file without the skeleton that moves none, or a map"};
}

// Cosines between the directions of a body's parts, means of both sides.
struct Stance {
  float arms_legs = 0, trunk_arms = 0, trunk_legs = 0;
};
Stance stance_of(const JointPositions& at, const Mapping& mapping) {
  const auto position = [&](HumanJoint human) { return at[mapping.joint_of[index(human)]]; };
  const auto cosine = [](Vec3 a, Vec3 b) {
    const float product = length(a) * length(b);
    return product > 0 ? dot(a, b) / product : 0.0f;
  };
  const Vec3 trunk = position(left_upper_arm) + position(right_upper_arm) -
                     position(left_upper_leg) - position(right_upper_leg);
  constexpr HumanJoint kLimbs[2][5] = {
      {left_upper_arm, left_lower_arm, left_hand, left_upper_leg, left_foot},
      {right_upper_arm, right_lower_arm, right_hand, right_upper_leg, right_foot}};
  Stance stance;
  for (const auto& [upper_arm, lower_arm, hand, upper_leg, foot] : kLimbs) {
    const HumanJoint end = mapping.joint_of[index(hand)] >= 0 ? hand : lower_arm;
    const Vec3 arm = position(end) - position(upper_arm),
               leg = position(foot) - position(upper_leg);
    stance.arms_legs += cosine(arm, leg) / 2;
    stance.trunk_arms += cosine(trunk, arm) / 2;
    stance.trunk_legs += cosine(trunk, leg) / 2;
  }
  return stance;
}
// Whether arms and legs are parallel, at right angles to the torso.
bool is_on_four_legs(const Stance& stance, float min_cosine) {
  constexpr float kAcross = 0.6f;
  return stance.arms_legs > min_cosine && std::abs(stance.trunk_arms) < kAcross &&
         std::abs(stance.trunk_legs) < kAcross;
}

}  // namespace

std::optional<Error> find_animal(const Skeleton& skeleton, std::span<const JointPositions> poses,
                                 const Mapping& mapping, const KnownJoints& known) {
  // At rest, and on average in motion: in a gallop, front and hind legs swing far apart.
  constexpr float kAtRest = 0.7f, kInMotion = 0.4f;
  if (known.contains(index(hips)) || !is_on_four_legs(stance_of(poses.front(), mapping), kAtRest)) {
    return std::nullopt;
  }
  Stance mean;
  const float share = 1 / static_cast<float>(poses.size());
  for (const JointPositions& at : poses) {
    const Stance stance = stance_of(at, mapping);
    mean.arms_legs += share * stance.arms_legs;
    mean.trunk_arms += share * stance.trunk_arms;
    mean.trunk_legs += share * stance.trunk_legs;
  }
  if (!is_on_four_legs(mean, kInMotion)) return std::nullopt;
  return Error{"no person: leftUpperArm would be " +
               quoted_name(skeleton, mapping.joint_of[index(left_upper_arm)]) +
               " and leftUpperLeg " +
               quoted_name(skeleton, mapping.joint_of[index(left_upper_leg)]) +
               ", and both stand side by side under a level trunk, at rest and in the motion, as "
               "an animal's legs do; expected a person's skeleton, or a map that names the hips"};
}

std::optional<Error> find_doubt(const Skeleton& skeleton, const Mapping& mapping,
                                const KnownJoints& known) {
  const auto joint = [&](HumanJoint human) { return mapping.joint_of[index(human)]; };
  if (known.contains(index(hips))) return std::nullopt;
  const int arm = joint(left_upper_arm);
  if (deforms(skeleton, arm) && deforms(skeleton, joint(left_upper_leg)) &&
      !deforms(skeleton, joint(hips)) && joint(spine) >= 0 && !deforms(skeleton, joint(spine))) {
    return Error{"doubtful: hips would be " + quoted_name(skeleton, joint(hips)) +
                 ", a control, and leftUpperArm " + quoted_name(skeleton, arm) +
                 ", which deforms the mesh and does not follow it in the file" + kCure};
  }
  if (auto tear = find_tear(skeleton, joint(hips), arm)) return tear;
  if (auto bare = find_bare(skeleton, joint(hips))) return bare;
  // A spine of at least so many joints above the arms is not a neck.
  constexpr size_t kSpineJoints = 4;
  const int top = joint(head) >= 0 ? joint(head) : joint(neck);
  if (top < 0 || joint(chest) >= 0 || joint(spine) >= 0) return std::nullopt;
  const std::vector<int> torso = path_up(skeleton, top, joint(hips));
  const std::vector<int> shoulder = path_up(skeleton, arm, joint(hips));
  const bool shared = std::any_of(shoulder.begin(), shoulder.end(), [&](int up) {
    return std::find(torso.begin(), torso.end(), up) != torso.end();
  });
  if (torso.size() < kSpineJoints || shared) return std::nullopt;
  return Error{"doubtful: leftUpperArm " + quoted_name(skeleton, arm) +
               " does not hang on the spine " + quoted_name(skeleton, torso.back()) +
               ", but beside it on " + quoted_name(skeleton, joint(hips)) + kCure};
}

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
