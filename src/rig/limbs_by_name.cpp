#include "rig/limbs.h"

#include <algorithm>
#include <cmath>

#include "rig/joint_name.h"

namespace panache {
namespace {

constexpr Side kSides[] = {Side::left, Side::right};
// Weights against odd lengths, in the units of limb_oddity(): of the plain order of the joints, of
// the same with numbered pieces counted as joints, of a name such as "knee", and of two joints with
// standard names.
constexpr float kPlainOrder = 12, kAllPieces = 8, kNamedLimb = 20, kOwnNames = 40;

bool is_plain_forearm(const JointName& name) { return is_forearm(name) && !is_twist(name); }

class LimbFinder {
 public:
  LimbFinder(const JointTree& tree, std::span<const JointName> names)
      : tree_(tree), names_(names) {}

  // Finds the most plausible limb among the joints above the end.
  Limb find(const LimbNames& human, const Limb& known, int other_tip) const {
    const LimbKind kind = human.kind;
    const int branch = tree_.meeting(lowest_joint(known), other_tip);
    Limb best{-1, -1, known.end};
    float min = INFINITY;
    const auto consider = [&](const Limb& limb, float trust) {
      if (limb.upper < 0 || limb.lower < 0) return;
      const JointName& lower = names_[limb.lower];
      const bool named = kind == LimbKind::arm ? is_forearm(lower) : is_shin(lower);
      const float odd =
          limb_oddity(tree_, kind, std::max(branch, 0), limb) - trust - (named ? kNamedLimb : 0);
      if (odd < min) min = odd, best = limb;
    };
    for (const bool skip_pieces : {true, false}) {
      const int lower = known.end < 0 ? known.lower : above(known.end, other_tip, skip_pieces);
      consider({above(lower, other_tip, skip_pieces), lower, known.end},
               skip_pieces ? kPlainOrder : kAllPieces);
    }
    const int own_lower = known.end < 0 ? known.lower : own_above(known.end, human.lower);
    const int own_upper = own_lower < 0 ? -1 : own_above(own_lower, human.upper);
    if (own_upper >= 0 && !tree_.is_above(own_upper, other_tip)) {
      consider({own_upper, own_lower, known.end}, kOwnNames);
    }
    if (known.end >= 0 && branch >= 0) {
      const std::vector<int> chain = limb_chain(tree_, branch, known.end);
      consider(usual_limb(tree_, kind, branch, chain, known.end), 0);
    }
    return best;
  }

 private:
  // The nearest joint above with a standard name of `human`; -1 if there is none.
  int own_above(int joint, HumanJoint human) const {
    int q = tree_.parent(joint);
    while (q >= 0 && !is_standard_name_of(names_[q], human)) q = tree_.parent(q);
    return q;
  }
  // Whether `joint` is a later piece of its parent's limb: "forearm.001" below "forearm".
  bool is_piece(int joint) const {
    const int above = tree_.parent(joint);
    if (above < 0 || names_[joint].side != names_[above].side) return false;
    const auto stem = without_number(names_[joint].words);
    return stem.size() < names_[joint].words.size() && stem == without_number(names_[above].words);
  }
  // The next joint above at another position that is not a twist joint (or a piece of a limb); -1
  // if it belongs to the other limb, too.
  int above(int joint, int other_tip, bool skip_pieces) const {
    int q = joint < 0 ? -1 : tree_.parent(joint);
    while (q >= 0 &&
           (!tree_.apart(q, joint) || is_twist(names_[q]) || (skip_pieces && is_piece(q)))) {
      q = tree_.parent(q);
    }
    return q >= 0 && tree_.is_above(q, other_tip) ? -1 : q;
  }

  const JointTree& tree_;
  std::span<const JointName> names_;
};

// Whether a joint named hand or foot, below a wrist or an ankle, is only the palm or the front of
// the foot: a hand without thumb or index finger or with a forearm of another name, or a foot
// without toes.
bool is_front(const JointTree& tree, std::span<const JointName> names, const LimbNames& limb,
              int joint) {
  const auto carries = [&](auto is) {
    for (int j = joint + 1; j < tree.count(); ++j) {
      if (is(names[j]) && tree.is_above(joint, j)) return true;
    }
    return false;
  };
  if (limb.kind == LimbKind::leg) return !carries(is_toe);
  if (!carries([](const JointName& n) { return n.has("thumb") || n.has("index"); })) return true;
  for (int q = tree.parent(joint); q >= 0; q = tree.parent(q)) {
    if (is_standard_name_of(names[q], limb.lower)) return false;
  }
  return true;
}

// The end of a limb: the joint with the plainest name, or another in line with it that has a
// standard name.
int find_end(const JointTree& tree, std::span<const JointName> names, const LimbNames& limb,
             Side side) {
  const auto is = limb.kind == LimbKind::arm ? is_hand : is_foot;
  const int plainest = find_named(tree, names, side, is);
  if (plainest < 0) return -1;
  return find_own_named(tree, names, limb.end, side, is, [&](int j) {
    if (j == plainest || tree.is_above(j, plainest)) return true;
    return tree.is_above(plainest, j) && !is_front(tree, names, limb, j);
  });
}

}  // namespace

int find_named(const JointTree& tree, std::span<const JointName> names, Side side,
               bool (*is)(const JointName&), const std::function<bool(int)>& where) {
  int best = -1;
  std::pair<size_t, int> best_rank;
  for (int j = 0; j < tree.count(); ++j) {
    if (names[j].side != side || !is(names[j]) || is_near(names[j]) || !where(j)) continue;
    const std::pair<size_t, int> rank = {word_count(names[j]), tree.depth(j)};
    if (best < 0 || rank < best_rank) best = j, best_rank = rank;
  }
  return best;
}

int find_own_named(const JointTree& tree, std::span<const JointName> names, HumanJoint joint,
                   Side side, bool (*is)(const JointName&), const std::function<bool(int)>& where) {
  const int plainest = find_named(tree, names, side, is, where);
  if (plainest < 0 || is_standard_name_of(names[plainest], joint)) return plainest;
  const int own = find_named(tree, names, side, is, [&](int j) {
    return is_standard_name_of(names[j], joint) && where(j) &&
           (tree.moves_mesh(j) || !tree.moves_mesh(plainest));
  });
  return own < 0 ? plainest : own;
}

Limbs find_limbs_by_name(const JointTree& tree, std::span<const JointName> names,
                         const std::map<int, int>& known, std::vector<HumanJoint>& missing) {
  const auto find_known = [&](HumanJoint joint, auto otherwise) {
    const auto found = known.find(index(joint));
    return found != known.end() ? found->second : otherwise();
  };
  const auto find_end_of = [&](const LimbNames& limb, size_t side) {
    return find_known(limb.end, [&] { return find_end(tree, names, limb, kSides[side]); });
  };
  Limbs out;
  out.confidence = out.side_confidence = 1;
  for (size_t side : {0, 1}) {
    const LimbNames& arm = kLimbNames[0][side];
    out.arms[side].end = find_end_of(arm, side);
    if (out.arms[side].end >= 0) continue;
    out.arms[side].lower = find_known(
        arm.lower, [&] { return find_named(tree, names, kSides[side], is_plain_forearm); });
    if (out.arms[side].lower < 0) missing.push_back(arm.end);
  }
  for (size_t side : {0, 1}) {
    const LimbNames& leg = kLimbNames[1][side];
    out.legs[side].end = find_end_of(leg, side);
    if (out.legs[side].end < 0) missing.push_back(leg.end);
  }
  if (!missing.empty()) {
    if (find_named(tree, names, Side::none, is_head) < 0) missing.push_back(HumanJoint::head);
    return out;
  }
  const LimbFinder finder(tree, names);
  for (size_t kind : {0, 1}) {
    std::array<Limb, 2>& limbs = kind ? out.legs : out.arms;
    const std::array<int, 2> tips = {lowest_joint(limbs[0]), lowest_joint(limbs[1])};
    for (size_t side : {0, 1}) {
      const LimbNames& limb = kLimbNames[kind][side];
      limbs[side] = finder.find(limb, limbs[side], tips[1 - side]);
      if (limbs[side].lower < 0) missing.push_back(limb.lower);
      if (limbs[side].upper < 0) missing.push_back(limb.upper);
    }
  }
  return out;
}

}  // namespace panache
