#include "rig/mapping.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string_view>

#include "rig/joint_name.h"

namespace panache {
namespace {

// Words that make a joint something near a hand, a foot or a head, but not it.
constexpr std::string_view kNear[] = {
    "thumb",  "index", "middle", "mid",      "ring",       "pinky", "little", "finger", "fingers",
    "carpal", "meta",  "end",    "nub",      "tip",        "top",   "site",   "ik",     "target",
    "pole",   "twist", "roll",   "effector", "metacarpal", "heel",  "weapon", "prop"};

bool is_near(const JointName& name) {
  return std::any_of(std::begin(kNear), std::end(kNear),
                     [&](std::string_view word) { return name.has(word); });
}

bool is_hand(const JointName& name) { return name.has("hand") || name.has("wrist"); }
bool is_toe(const JointName& name) {
  return name.has("toe") || name.has("toes") || name.has("toebase") || name.has("ball") ||
         name.has("forefoot") || (name.has("fore") && name.has("foot"));
}
bool is_foot(const JointName& name) {
  return (name.has("foot") || name.has("ankle")) && !is_toe(name);
}
bool is_head(const JointName& name) { return name.has("head"); }
bool is_neck(const JointName& name) { return name.has("neck"); }
bool is_twist(const JointName& name) { return name.has("twist") || name.has("roll"); }

// A limb between its end (hand, foot) and the trunk.
struct Limb {
  int lower = -1, upper = -1;
};

class NameMapper {
 public:
  NameMapper(const Skeleton& skeleton, std::span<const Vec3> positions)
      : joints_(skeleton.joints), positions_(positions) {
    for (const Joint& joint : joints_) names_.push_back(parse_joint_name(joint.name));
    // Joints that are nearer than this sit on one another: half a percent of the body's size.
    Vec3 low = positions.empty() ? Vec3{} : positions[0], high = low;
    for (const Vec3& p : positions) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    nearness_ = 0.005f * length(high - low);
    map_.joint_of.fill(-1);
    map_.reasons.fill("missing");
  }

  Result<Mapping> run() {
    find_ends();
    find_limbs();
    if (!missing_.empty()) return refusal();
    find_trunk();
    find_head();
    find_spine();
    find_shoulders();
    find_toes();
    for (int j = 0; j < kHumanJoints; ++j) {
      if (map_.joint_of[j] < 0) {
        map_.notes.push_back(std::string(human_joint_name(j)) + " is missing");
      }
    }
    return std::move(map_);
  }

 private:
  int parent(int joint) const { return joints_[joint].parent; }
  int at(HumanJoint joint) const { return map_.joint_of[index(joint)]; }
  void put(HumanJoint joint, int found, std::string reason) {
    if (found < 0) return;
    map_.joint_of[index(joint)] = found;
    map_.reasons[index(joint)] = std::move(reason);
  }
  float distance(int a, int b) const { return length(positions_[a] - positions_[b]); }
  bool apart(int a, int b) const { return distance(a, b) >= nearness_; }
  // Whether `above` is `joint` or one of its ancestors.
  bool is_above(int above, int joint) const {
    while (joint > above) joint = parent(joint);
    return joint == above && joint >= 0;
  }
  int depth(int joint) const {
    int n = 0;
    while (joint >= 0) joint = parent(joint), ++n;
    return n;
  }
  int meeting(int a, int b) const {
    while (a != b && a >= 0 && b >= 0) (a > b ? a : b) = parent(a > b ? a : b);
    return a == b ? a : -1;
  }

  // The plainest name that `is` accepts: fewest words besides, then nearest to the root, then
  // first.
  template <class Is, class Where>
  int find(Side side, Is is, Where where) const {
    int best = -1;
    std::pair<size_t, int> best_rank;
    for (int j = 0; j < static_cast<int>(joints_.size()); ++j) {
      if (names_[j].side != side || !is(names_[j]) || is_near(names_[j]) || !where(j)) continue;
      const std::pair<size_t, int> rank = {names_[j].words.size(), depth(j)};
      if (best < 0 || rank < best_rank) best = j, best_rank = rank;
    }
    return best;
  }
  template <class Is>
  int find(Side side, Is is) const {
    return find(side, is, [](int) { return true; });
  }

  void find_ends() {
    const auto end = [&](HumanJoint joint, Side side, auto is) {
      const int found = find(side, is);
      put(joint, found, "by its name");
      if (found < 0) missing_.push_back(joint);
    };
    end(HumanJoint::left_hand, Side::left, is_hand);
    end(HumanJoint::right_hand, Side::right, is_hand);
    end(HumanJoint::left_foot, Side::left, is_foot);
    end(HumanJoint::right_foot, Side::right, is_foot);
    if (!missing_.empty() && find(Side::none, is_head) < 0) missing_.push_back(HumanJoint::head);
  }

  // Whether `joint` is a later piece of its parent's limb: "forearm.001" below "forearm".
  bool is_piece(int joint) const {
    const int above = parent(joint);
    if (above < 0 || names_[joint].side != names_[above].side) return false;
    const auto stem = without_number(names_[joint].words);
    return stem.size() < names_[joint].words.size() && stem == without_number(names_[above].words);
  }
  // The next joint above that stands elsewhere and is no twist joint (nor a piece of a limb).
  int above(int joint, bool skip_pieces) const {
    int q = joint < 0 ? -1 : parent(joint);
    while (q >= 0 && (!apart(q, joint) || is_twist(names_[q]) || (skip_pieces && is_piece(q)))) {
      q = parent(q);
    }
    return q;
  }
  Limb limb(int end, int other_end, bool skip_pieces) const {
    Limb out;
    out.lower = above(end, skip_pieces);
    if (out.lower >= 0 && is_above(out.lower, other_end)) out.lower = -1;
    out.upper = above(out.lower, skip_pieces);
    if (out.upper >= 0 && is_above(out.upper, other_end)) out.upper = -1;
    return out;
  }
  void find_limb(HumanJoint end, HumanJoint other, HumanJoint lower, HumanJoint upper) {
    if (at(end) < 0 || at(other) < 0) return;
    Limb found = limb(at(end), at(other), true);
    // Numbers may also count the joints of an arm (arm1, arm2): then "upper" would be no limb's
    // half.
    bool plausible = found.lower >= 0 && found.upper >= 0;
    if (plausible) {
      const float ratio =
          distance(found.upper, found.lower) / std::max(distance(found.lower, at(end)), 1e-9f);
      plausible = ratio > 0.5f && ratio < 2.0f;
    }
    if (!plausible) {
      const Limb all = limb(at(end), at(other), false);
      if (all.lower >= 0 && all.upper >= 0) found = all;
    }
    const auto reason = [&](HumanJoint below) {
      return "next joint above " + std::string(human_joint_name(index(below)));
    };
    put(lower, found.lower, reason(end));
    put(upper, found.upper, reason(lower));
    if (found.lower < 0) missing_.push_back(lower);
    if (found.upper < 0) missing_.push_back(upper);
  }
  void find_limbs() {
    using enum HumanJoint;
    find_limb(left_hand, right_hand, left_lower_arm, left_upper_arm);
    find_limb(right_hand, left_hand, right_lower_arm, right_upper_arm);
    find_limb(left_foot, right_foot, left_lower_leg, left_upper_leg);
    find_limb(right_foot, left_foot, right_lower_leg, right_upper_leg);
    if (!missing_.empty()) return;
    if (meeting(at(left_hand), at(right_hand)) < 0) missing_.push_back(chest);
    if (meeting(meeting(at(left_foot), at(right_foot)), at(left_hand)) < 0)
      missing_.push_back(hips);
  }

  void find_trunk() {
    int chest = meeting(at(HumanJoint::left_hand), at(HumanJoint::right_hand));
    int hips = meeting(at(HumanJoint::left_foot), at(HumanJoint::right_foot));
    std::string reason = "where the legs meet";
    if (!is_above(hips, chest)) {
      hips = meeting(hips, chest);
      reason = "where legs and arms meet";
    }
    put(HumanJoint::hips, hips, reason);
    // Some rigs hang the arms on the neck: then the chest is the joint below it.
    int below_neck = chest;
    while (below_neck != hips && is_neck(names_[below_neck])) below_neck = parent(below_neck);
    if (below_neck != hips && below_neck != chest) {
      put(HumanJoint::neck, chest, "where the arms meet, and named so");
      put(HumanJoint::chest, below_neck, "below the neck");
    } else if (chest != hips) {
      put(HumanJoint::chest, chest, "where the arms meet");
    }
  }
  // The trunk's highest joint, below which a head may hang.
  int trunk_top() const {
    if (at(HumanJoint::neck) >= 0) return at(HumanJoint::neck);
    return at(HumanJoint::chest) >= 0 ? at(HumanJoint::chest) : at(HumanJoint::hips);
  }

  void find_head() {
    const int top = trunk_top(), hips = at(HumanJoint::hips);
    const auto below = [&](int root) {
      return [this, root](int j) { return j != root && is_above(root, j); };
    };
    int head = find(Side::none, is_head, below(top));
    if (head < 0) head = find(Side::none, is_head, below(hips));
    put(HumanJoint::head, head, "by its name");
    if (head < 0) find_head_by_place(top);
    if (at(HumanJoint::head) >= 0 && at(HumanJoint::neck) < 0) find_neck();
  }
  // The head is the end of the one unsided chain that leaves the chest upwards.
  void find_head_by_place(int top) {
    int head = top;
    for (int next = top; next >= 0;) {
      int only = -1, count = 0;
      for (int j = next + 1; j < static_cast<int>(joints_.size()); ++j) {
        if (parent(j) != next || names_[j].side != Side::none || is_near(names_[j])) continue;
        if (is_above(j, at(HumanJoint::left_hand)) || is_above(j, at(HumanJoint::left_foot)))
          continue;
        only = j, ++count;
      }
      next = count == 1 ? only : -1;
      if (next >= 0 && apart(next, head)) head = next;
    }
    if (head == top) return;
    const bool neck = is_neck(names_[head]);
    put(neck ? HumanJoint::neck : HumanJoint::head, head, "end of the chain above the chest");
  }
  void find_neck() {
    const int head = at(HumanJoint::head), top = trunk_top();
    if (!is_above(top, head)) return;
    int neck = -1, count = 0;
    for (int q = parent(head); q != top; q = parent(q), ++count) {
      if (neck < 0 && apart(q, head)) neck = q;
    }
    put(HumanJoint::neck, neck, "next joint below the head");
    if (count > 1) map_.notes.push_back(std::to_string(count) + " joints between chest and head");
  }

  // Of the joints between hips and chest the one nearest to 64 % of the way, where the canonical
  // spine is.
  void find_spine() {
    const int hips = at(HumanJoint::hips), chest = at(HumanJoint::chest);
    if (chest < 0) return;
    float total = 0;
    int count = -1;
    for (int q = chest; q != hips; q = parent(q), ++count) total += distance(q, parent(q));
    float walked = 0, best = 2;
    int spine = -1;
    for (int q = chest; parent(q) != hips;) {
      walked += distance(q, parent(q));
      q = parent(q);
      const float off = std::abs(1 - walked / std::max(total, 1e-9f) - 0.64f);
      if (apart(q, chest) && off < best) spine = q, best = off;
    }
    put(HumanJoint::spine, spine, "nearest to 64 % of the way from hips to chest");
    if (count > 1) map_.notes.push_back(std::to_string(count) + " joints between hips and chest");
  }

  void find_shoulders() {
    const auto shoulder = [&](HumanJoint joint, HumanJoint arm, HumanJoint other_hand) {
      int q = parent(at(arm));
      while (q >= 0 && is_twist(names_[q])) q = parent(q);
      if (q < 0 || is_above(q, at(other_hand))) return;
      put(joint, q, "parent of " + std::string(human_joint_name(index(arm))));
    };
    using enum HumanJoint;
    shoulder(left_shoulder, left_upper_arm, right_hand);
    shoulder(right_shoulder, right_upper_arm, left_hand);
  }

  void find_toes() {
    const auto toes = [&](HumanJoint joint, HumanJoint foot) {
      const auto below = [&, f = at(foot)](int j) { return j != f && is_above(f, j); };
      int found = find(Side::left, is_toe, below);
      if (const int right = find(Side::right, is_toe, below); found < 0) found = right;
      if (const int unsided = find(Side::none, is_toe, below); found < 0) found = unsided;
      put(joint, found, "by its name");
    };
    toes(HumanJoint::left_toes, HumanJoint::left_foot);
    toes(HumanJoint::right_toes, HumanJoint::right_foot);
  }

  Error refusal() const {
    constexpr size_t kNamed = 12;
    std::string text = "no humanoid found: ";
    for (size_t i = 0; i < missing_.size(); ++i) {
      text += (i ? ", " : "") + std::string(human_joint_name(index(missing_[i])));
    }
    text += missing_.size() == 1 ? " is missing" : " are missing";
    for (size_t i = 0; i < std::min(joints_.size(), kNamed); ++i) {
      text += (i ? ", '" : " among '") + joints_[i].name + "'";
    }
    if (joints_.size() > kNamed) text += ", ...";
    text += " (" + std::to_string(joints_.size()) + (joints_.size() == 1 ? " joint)" : " joints)");
    return {text + "; expected names such as LeftHand or hand_L"};
  }

  const std::vector<Joint>& joints_;
  std::span<const Vec3> positions_;
  std::vector<JointName> names_;
  float nearness_ = 0;
  std::vector<HumanJoint> missing_;
  Mapping map_;
};

}  // namespace

Result<Mapping> map_by_names(const Skeleton& skeleton, std::span<const Vec3> positions) {
  return NameMapper(skeleton, positions).run();
}

}  // namespace panache
