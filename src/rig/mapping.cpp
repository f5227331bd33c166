#include "rig/mapping.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "rig/joint_name.h"
#include "rig/limbs.h"
#include "rig/name_preferences.h"

namespace panache {
namespace {

using enum HumanJoint;

constexpr float kByTree = 0.95f, kByPosition = 0.7f, kByShape = 0.8f;

// Advice for feet that are not below a leg, as in game characters whose legs follow IK targets;
// empty if all feet are below a shin.
std::string feet_advice(const std::vector<Joint>& joints, const Limbs& limbs,
                        const std::vector<HumanJoint>& missing) {
  for (size_t side : {0, 1}) {
    const int foot = limbs.legs[side].end;
    const auto lacks = std::find(missing.begin(), missing.end(), kLimbNames[1][side].lower);
    if (foot < 0 || lacks == missing.end()) continue;
    const int above = joints[foot].parent;
    return "; the foot '" + joints[foot].name + "' hangs on " +
           (above < 0 ? std::string("nothing") : "'" + joints[above].name + "'") +
           ", not on a shin, as in rigs whose legs follow targets (IK); bake the motion onto a "
           "skeleton of hips, thighs, shins and feet that are one below the other, and export that";
  }
  return "";
}

// The message for a skeleton that lacks `missing`.
Error rejection(const std::vector<Joint>& joints, const std::vector<HumanJoint>& missing,
                const std::string& advice = "") {
  constexpr size_t kNamed = 12;
  std::string text = "no humanoid found: ";
  for (size_t i = 0; i < missing.size(); ++i) {
    text += (i ? ", " : "") + name_of(missing[i]);
  }
  text += missing.size() == 1 ? " is missing" : " are missing";
  for (size_t i = 0; i < std::min(joints.size(), kNamed); ++i) {
    text += (i ? ", '" : " among '") + joints[i].name + "'";
  }
  if (joints.size() > kNamed) text += ", ...";
  // Hips, and of each limb the joints down to the foot or forearm.
  constexpr size_t kFewest = 11;
  text += " (" + std::to_string(joints.size()) + (joints.size() == 1 ? " joint)" : " joints)");
  if (!advice.empty()) {
    text += advice;
  } else if (joints.size() < kFewest) {
    text +=
        "; expected a person's joints: hips, two legs down to the feet and two arms down to the "
        "forearms";
  } else {
    text +=
        "; expected names such as LeftHand or hand_L, the shape of a person, or a map that says "
        "which joint is which";
  }
  return {text, ErrorKind::not_humanoid};
}

class Mapper {
 public:
  Mapper(const Skeleton& skeleton, const JointTree& tree, const std::vector<JointName>& names,
         const KnownJoints& known)
      : draft_(skeleton.joints, tree, names, known) {}

  // limbs: all four, complete.
  Result<Mapping> run(const Limbs& limbs, bool by_shape) {
    draft_.by_shape = by_shape;
    for (size_t side : {0, 1}) {
      take(limbs.arms[side], kLimbNames[0][side], limbs);
      take(limbs.legs[side], kLimbNames[1][side], limbs);
      draft_.arm_tips[side] = lowest_joint(limbs.arms[side]);
    }
    if (by_shape) {
      map_.notes.push_back("the names of the joints are not conclusive: mapped by shape");
    }
    if (by_shape && limbs.side_confidence < 0.3f) {
      map_.notes.push_back("left and right are guessed: nothing shows which way the body faces");
    }
    for (size_t side : {0, 1}) prefer_.limbs(side);
    find_torso();
    if (!missing_.empty()) return rejection(joints_, missing_);
    prefer_.torso();
    find_head();
    prefer_.neck();
    find_spine();
    prefer_.spine();
    for (size_t side : {0, 1}) {
      find_shoulder(side ? right_shoulder : left_shoulder, side);
      prefer_.shoulder(side);
      find_toes(side ? right_toes : left_toes, kLimbNames[1][side].end);
    }
    prefer_.note_ends();
    if (const auto done = apply_overrides(); !done) return done.error();
    for (int j = 0; j < kHumanJoints; ++j) {
      if (map_.joint_of[j] < 0) {
        map_.notes.push_back(std::string(human_joint_name(j)) + " is missing");
      }
    }
    return std::move(map_);
  }

 private:
  int parent(int joint) const { return tree_.parent(joint); }
  int at(HumanJoint joint) const { return draft_.at(joint); }
  void put(HumanJoint joint, int found, std::string reason, float confidence) {
    draft_.put(joint, found, std::move(reason), confidence);
  }
  void take(const Limb& limb, const LimbNames& names, const Limbs& limbs) {
    const float sure = limbs.confidence * std::min(1.0f, 0.3f + limbs.side_confidence);
    if (draft_.by_shape) {
      const std::string reason = "by the skeleton's shape, its side " + limbs.side_reason;
      put(names.upper, limb.upper, reason, sure);
      put(names.lower, limb.lower, reason, sure);
      put(names.end, limb.end, reason, sure);
      return;
    }
    const auto above = [](HumanJoint joint) { return "next joint above " + name_of(joint); };
    put(names.end, limb.end, "by its name", sure);
    put(names.lower, limb.lower, limb.end < 0 ? "by its name" : above(names.end), kByTree);
    put(names.upper, limb.upper, above(names.lower), kByTree);
  }

  template <class Where>
  int find(HumanJoint joint, Side side, bool (*is)(const JointName&), Where where) const {
    return find_own_named(tree_, names_, joint, side, is, where);
  }

  void find_torso() {
    const int feet = tree_.meeting(at(left_foot), at(right_foot));
    const int arms = tree_.meeting(draft_.arm_tips[0], draft_.arm_tips[1]);
    int low = feet;
    std::string reason = "where the legs meet";
    if (!tree_.is_above(low, arms)) {
      low = tree_.meeting(low, arms);
      reason = "where legs and arms meet";
    }
    if (arms < 0) missing_.push_back(chest);
    if (low < 0) missing_.push_back(hips);
    if (!missing_.empty()) return;
    // In some rigs the legs are children of the first joint of the spine, inside the pelvis.
    const int over = parent(low);
    if (is_spine(names_[low]) && over >= 0 && is_pelvis(names_[over])) {
      low = over;
      reason = "above where the legs meet, and named so";
    }
    put(hips, low, reason, kByTree);
    // In some rigs the arms are children of the neck: then the chest is the joint below it.
    int below_neck = arms;
    while (below_neck != low && is_neck(names_[below_neck])) below_neck = parent(below_neck);
    if (below_neck != low && below_neck != arms) {
      put(neck, arms, "where the arms meet, and named so", kByTree);
      put(chest, below_neck, "below the neck", kByTree);
    } else if (arms != low) {
      put(chest, arms, "where the arms meet", kByTree);
    }
  }
  // The torso's highest joint, below which a head may hang.
  int torso_top() const { return at(neck) >= 0 ? at(neck) : at(chest) >= 0 ? at(chest) : at(hips); }

  void find_head() {
    const int top = torso_top();
    const auto below = [&](int root) {
      return [this, root](int j) { return j != root && tree_.is_above(root, j); };
    };
    int found = find(head, Side::none, is_head, below(top));
    if (found < 0) {  // Next to the neck, but not the torso, whatever its name.
      found = find(head, Side::none, is_head,
                   [&](int j) { return tree_.is_above(at(hips), j) && !tree_.is_above(j, top); });
    }
    put(head, found, "by its name", kCertain);
    if (found < 0) find_head_by_position(top);
    if (at(head) >= 0 && at(neck) < 0) find_neck();
  }
  // The child that leads farthest up in the middle between the arms; -1 if none does. `most_off`:
  // the maximum distance from the middle.
  int middle_child(int joint, float max_off) const {
    int middle = -1;
    float max = 0;
    for (const int j : tree_.children(joint)) {
      if (names_[j].side != Side::none || is_near(names_[j]) || is_on_head(names_[j])) continue;
      if (!(off_centre(j) < max_off)) continue;
      if (tree_.is_above(j, draft_.arm_tips[0]) || tree_.is_above(j, draft_.arm_tips[1])) continue;
      if (tree_.is_above(j, at(left_foot)) || tree_.is_above(j, at(right_foot))) continue;
      const float reach = tree_.distance(joint, j) + tree_.reach(j);
      if (reach > max) max = reach, middle = j;
    }
    return middle;
  }
  // The chain from the top of the torso in the middle between the arms.
  std::vector<int> chain_above(int top) const {
    // In leaning poses, and with one shoulder forward, a neck may be this far off; a joint for a
    // breast would be at 0.45.
    constexpr float kStraight = 0.2f, kLeaning = 0.35f;
    std::vector<int> chain;
    const bool leans = middle_child(top, kStraight) < 0;
    for (int next = top; next >= 0;) {
      next = middle_child(next, leans ? kLeaning : kStraight);
      if (next >= 0 && tree_.apart(next, chain.empty() ? top : chain.back())) chain.push_back(next);
    }
    return chain;
  }
  // Difference of a joint's distances from both shoulders, relative to the distance of the
  // shoulders.
  float off_centre(int joint) const {
    const float left = tree_.distance(joint, at(left_upper_arm));
    const float right = tree_.distance(joint, at(right_upper_arm));
    return std::abs(left - right) / tree_.distance(at(left_upper_arm), at(right_upper_arm));
  }
  // The joint of a chain whose distance is nearest to that in a body with legs of this length; -1
  // if there is none.
  template <class Distance>
  int usual_joint(const std::vector<int>& chain, float usual, Distance distance) const {
    const float leg = tree_.distance(at(left_upper_leg), at(left_lower_leg)) +
                      tree_.distance(at(left_lower_leg), at(left_foot));
    int best = -1;
    float min = INFINITY;
    for (const int joint : chain) {
      const float off = std::abs(distance(joint) / leg - usual / kProportions.leg);
      if (off < min) min = off, best = joint;
    }
    return best;
  }
  void find_head_by_position(int top) {
    // Most rigs have it slightly higher than the canonical body, metres.
    constexpr float kUsual = 0.15f;
    const auto above_shoulders = [&](int joint) {
      float sum = 0;
      for (const JointPositions& pose : tree_.poses()) {
        const Vec3 arms = pose[at(left_upper_arm)] + pose[at(right_upper_arm)];
        sum += length(pose[joint] - arms * 0.5f);
      }
      return sum / static_cast<float>(tree_.poses().size());
    };
    const int found = usual_joint(chain_above(top), kUsual, above_shoulders);
    if (found < 0) return;
    put(is_neck(names_[found]) ? neck : head, found, "in the chain above the chest", kByPosition);
  }
  void find_neck() {
    const int top = torso_top();
    if (!tree_.is_above(top, at(head))) return;
    int found = -1, count = 0;
    for (int q = parent(at(head)); q != top; q = parent(q), ++count) {
      if (found < 0 && tree_.apart(q, at(head))) found = q;
    }
    put(neck, found, "next joint below the head", map_.confidence[index(head)] * kByTree);
    if (count > 1) map_.notes.push_back(std::to_string(count) + " joints between chest and head");
  }

  // The joint nearest to 64 % of the way from hips to chest, where the canonical spine is.
  void find_spine() {
    if (at(chest) < 0) return;
    float total = 0;
    int count = -1;
    for (int q = at(chest); q != at(hips); q = parent(q), ++count) {
      total += tree_.distance(q, parent(q));
    }
    // Pieces without a standard name, such as a group, come after those with one.
    constexpr float kNoPiece = 2;
    float walked = 0, best = 2 * kNoPiece;
    int found = -1;
    for (int q = at(chest); parent(q) != at(hips);) {
      walked += tree_.distance(q, parent(q));
      q = parent(q);
      const bool is_piece =
          is_standard_name(names_[q]) && (tree_.moves_mesh(q) || !tree_.moves_mesh(at(chest)));
      const float off = std::abs(1 - walked / std::max(total, 1e-9f) - 0.64f) +
                        (draft_.by_shape || is_piece ? 0 : kNoPiece);
      if (tree_.apart(q, at(chest)) && off < best) found = q, best = off;
    }
    put(spine, found, "nearest to 64 % of the way from hips to chest", count > 1 ? 0.9f : kByTree);
    if (count > 1) map_.notes.push_back(std::to_string(count) + " joints between hips and chest");
  }

  void find_shoulder(HumanJoint joint, size_t side) {
    const HumanJoint arm = kLimbNames[0][side].upper;
    int q = parent(at(arm));
    while (q >= 0 && is_twist(names_[q])) q = parent(q);
    if (q < 0 || tree_.is_above(q, draft_.arm_tips[1 - side])) return;
    put(joint, q, "parent of " + name_of(arm), draft_.by_shape ? kByShape : kByTree);
  }

  void find_toes(HumanJoint joint, HumanJoint foot_joint) {
    const int foot = at(foot_joint);
    const auto below = [&](int j) { return j != foot && tree_.is_above(foot, j); };
    for (const Side side : {Side::left, Side::right, Side::none}) {
      const int found = find(joint, side, is_toe, below);
      put(joint, found, "by its name", kCertain);
      if (found >= 0) return;
    }
    // If the foot is named ankle, a joint named foot is the front of it.
    const Side side = names_[foot].side;
    const int front = !is_ankle(names_[foot]) ? -1 : find(joint, side, is_foot, below);
    put(joint, front, "next joint below an ankle", kByTree);
    if (front >= 0 || !draft_.by_shape) return;
    const std::vector<int> chain = limb_chain(tree_, foot, farthest_below(tree_, foot));
    const int found = usual_joint(chain, kProportions.length[index(left_toes)],
                                  [&](int below_it) { return tree_.distance(foot, below_it); });
    put(joint, found, "in the chain below " + name_of(foot_joint), kByPosition);
  }

  // Replaces detected joints by given ones.
  Result<void> apply_overrides() {
    for (const auto& [human, joint] : draft_.known) {
      for (int j = 0; j < kHumanJoints; ++j) {
        if (joint >= 0 && map_.joint_of[j] == joint) clear(j);
      }
      clear(human);
      if (joint >= 0) put(HumanJoint{human}, joint, "as given", 1);
    }
    for (const auto& limbs : kLimbNames) {
      for (const LimbNames& limb : limbs) {
        for (const HumanJoint joint : {limb.upper, limb.lower, limb.end}) {
          if (at(joint) < 0 && (joint != limb.end || limb.kind == LimbKind::leg)) {
            missing_.push_back(joint);
          }
        }
      }
    }
    if (at(hips) < 0) missing_.push_back(hips);
    if (!missing_.empty()) return rejection(joints_, missing_);
    for (const auto& [human, joint] : draft_.known) {
      int above = kHumanParent[human];
      while (above >= 0 && map_.joint_of[above] < 0) above = kHumanParent[above];
      if (joint < 0 || above < 0 || tree_.is_above(map_.joint_of[above], joint)) continue;
      return Error{"'" + joints_[joint].name + "' cannot be " +
                   std::string(human_joint_name(human)) + ": expected a joint below " +
                   std::string(human_joint_name(above)) + " '" +
                   joints_[map_.joint_of[above]].name + "'"};
    }
    return {};
  }
  void clear(int human) {
    map_.joint_of[human] = -1;
    map_.reasons[human] = "missing";
    map_.confidence[human] = 0;
  }

  MappingDraft draft_;
  const std::vector<Joint>& joints_ = draft_.joints;
  const JointTree& tree_ = draft_.tree;
  const std::vector<JointName>& names_ = draft_.names;
  Mapping& map_ = draft_.map;
  NamePreferences prefer_{draft_};
  std::vector<HumanJoint> missing_;
};

// Roles in the file take precedence over names.
std::vector<JointName> read_names(const Skeleton& skeleton) {
  const bool roles = std::any_of(skeleton.joints.begin(), skeleton.joints.end(),
                                 [](const Joint& joint) { return !joint.role.empty(); });
  std::vector<JointName> names;
  names.reserve(skeleton.joints.size());
  for (const Joint& joint : skeleton.joints) {
    names.push_back(parse_joint_name(roles ? joint.role : joint.name));
  }
  return names;
}

// Whether arms and legs look human: not folded the wrong way, left about as long as right, upper
// and lower part in proportion.
bool is_plausible(const JointTree& tree, const Limbs& limbs) {
  for (const auto& pair : {limbs.arms, limbs.legs}) {
    std::array<float, 2> lengths;
    for (size_t side : {0, 1}) {
      const Limb& limb = pair[side];
      const float upper = tree.distance(limb.upper, limb.lower);
      const float lower = limb.end < 0 ? upper : tree.distance(limb.lower, limb.end);
      if (!(upper > 0.3f * lower && lower > 0.3f * upper)) return false;
      lengths[side] = upper + lower;
    }
    if (lengths[0] > 1.5f * lengths[1] || lengths[1] > 1.5f * lengths[0]) return false;
  }
  return uprightness(tree, limbs.arms, limbs.legs) > -0.3f;
}

}  // namespace

Result<Mapping> map_humanoid(const Skeleton& skeleton, std::span<const JointPositions> poses,
                             const KnownJoints& known) {
  const JointTree tree(skeleton, poses);
  const std::vector<JointName> names = read_names(skeleton);
  std::vector<HumanJoint> missing;
  const Limbs limbs = find_limbs_by_name(tree, names, known, missing);
  Result<Mapping> named =
      missing.empty() ? Mapper(skeleton, tree, names, known).run(limbs, false)
                      : Result<Mapping>(rejection(skeleton.joints, missing,
                                                  feet_advice(skeleton.joints, limbs, missing)));
  if (named && is_plausible(tree, limbs)) return named;
  if (const std::optional<Limbs> shaped = find_limbs_by_shape(tree, names)) {
    return Mapper(skeleton, tree, names, known).run(*shaped, true);
  }
  if (named) named->notes.push_back("the limbs that the names tell have unusual lengths");
  return named;
}

}  // namespace panache
