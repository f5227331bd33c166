#include "rig/limbs.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace panache {
namespace {

// Limbs of a pair may differ by this share of their length; they are at least that share of the
// longest path down from the root.
constexpr float kUneven = 0.12f;
constexpr float kShortest = 0.2f;
// Limbs with a larger mean oddity are not a pair.
constexpr float kOddest = 14;
// The cosine between legs and torso of a body that stands.
constexpr float kUpright = 0.5f;

// If there are more pairs, only the longest count.
constexpr size_t kMaxPairs = 256;

// Two limbs of one length that leave the torso at one joint.
struct Pair {
  int branch = -1;
  std::array<int, 2> tops;  // Children of the branch.
  float reach = 0;          // Of the shorter one, file units.
  std::array<Limb, 2> arms, legs;
  float arm_oddity = INFINITY, leg_oddity = INFINITY;
};

float square(float x) { return x * x; }

float upper_length(const JointTree& tree, const Limb& limb) {
  return tree.distance(limb.upper, limb.lower);
}
float lower_length(const JointTree& tree, const Limb& limb) {
  return limb.end < 0 ? tree.end_length(limb.lower) : tree.distance(limb.lower, limb.end);
}

// How much the limbs of both sides differ, in the units of their oddity.
float unevenness(const JointTree& tree, const std::array<Limb, 2>& limbs) {
  constexpr float kDeviation = 0.06f;
  const auto apart = [](float a, float b) { return square(std::log(a / b) / kDeviation); };
  return apart(upper_length(tree, limbs[0]), upper_length(tree, limbs[1])) +
         apart(lower_length(tree, limbs[0]), lower_length(tree, limbs[1]));
}

// Whether two joints keep their distance in all poses, to a percent.
bool are_rigid(const JointTree& tree, int a, int b) {
  const float mean = tree.distance(a, b);
  return std::all_of(tree.poses().begin(), tree.poses().end(), [&](const JointPositions& pose) {
    return std::abs(length(pose[a] - pose[b]) - mean) <= 0.01f * mean;
  });
}

// The legs begin at their lowest joints that stay rigid to each other in all poses: joints above
// them belong to the pelvis.
void lower_hips(const JointTree& tree, const std::array<std::vector<int>, 2>& chains,
                std::array<Limb, 2>& legs) {
  for (;;) {
    std::array<int, 2> next;
    for (size_t side : {0, 1}) {
      const auto at = std::find(chains[side].begin(), chains[side].end(), legs[side].upper);
      next[side] = *(at + 1);  // The lower joint follows at the latest.
      if (next[side] == legs[side].lower) return;
    }
    if (!are_rigid(tree, next[0], next[1])) return;
    for (size_t side : {0, 1}) legs[side].upper = next[side];
  }
}

float fit(const JointTree& tree, LimbKind kind, Pair& pair, std::array<Limb, 2>& limbs) {
  std::array<std::vector<int>, 2> chains;
  for (size_t side : {0, 1}) {
    chains[side] = limb_chain(tree, pair.branch, farthest_below(tree, pair.tops[side]));
    limbs[side] = usual_limb(tree, kind, pair.branch, chains[side]);
    if (limbs[side].upper < 0) return INFINITY;
  }
  if (kind == LimbKind::leg && tree.poses().size() > 2) lower_hips(tree, chains, limbs);
  float odd = 0;
  for (const Limb& limb : limbs) odd += limb_oddity(tree, kind, pair.branch, limb);
  return odd + unevenness(tree, limbs);
}

std::vector<Pair> find_pairs(const JointTree& tree) {
  // Measured from a branching joint: a root may be anywhere.
  float longest = 0;
  for (int j = 0; j < tree.count(); ++j) {
    if (tree.children(j).size() > 1) longest = std::max(longest, tree.reach(j));
  }
  std::vector<Pair> pairs;
  for (int j = 0; j < tree.count(); ++j) {
    std::vector<std::pair<float, int>> reaches;
    for (const int child : tree.children(j)) {
      const float reach = tree.distance(j, child) + tree.reach(child);
      if (reach > kShortest * longest) reaches.emplace_back(reach, child);
    }
    std::sort(reaches.rbegin(), reaches.rend());
    for (size_t a = 0; a < reaches.size(); ++a) {
      // Four are enough: no human joint has more limbs of one length.
      for (size_t b = a + 1; b < std::min(reaches.size(), a + 4); ++b) {
        if (reaches[b].first < (1 - kUneven) * reaches[a].first) break;
        pairs.push_back({j, {reaches[a].second, reaches[b].second}, reaches[b].first, {}, {}});
      }
    }
  }
  if (pairs.size() > kMaxPairs) {
    std::stable_sort(pairs.begin(), pairs.end(),
                     [](const Pair& a, const Pair& b) { return a.reach > b.reach; });
    pairs.resize(kMaxPairs);
  }
  for (Pair& pair : pairs) {
    pair.arm_oddity = fit(tree, LimbKind::arm, pair, pair.arms);
    pair.leg_oddity = fit(tree, LimbKind::leg, pair, pair.legs);
  }
  return pairs;
}

Vec3 end_of(const JointPositions& pose, const Limb& limb) {
  return pose[limb.end < 0 ? limb.lower : limb.end];
}
Vec3 middle(Vec3 a, Vec3 b) { return (a + b) * 0.5f; }

// From the middle of the hip joints to the middle of the shoulder joints.
Vec3 torso(const JointPositions& pose, const std::array<Limb, 2>& arms,
           const std::array<Limb, 2>& legs) {
  return middle(pose[arms[0].upper], pose[arms[1].upper]) -
         middle(pose[legs[0].upper], pose[legs[1].upper]);
}

// Whether one pair branches off a limb of the other.
bool entangled(const JointTree& tree, const Pair& a, const Pair& b) {
  for (const int top : a.tops) {
    if (tree.is_above(top, b.branch)) return true;
  }
  for (const int top : b.tops) {
    if (tree.is_above(top, a.branch)) return true;
  }
  return a.branch == b.branch && (a.tops[0] == b.tops[0] || a.tops[0] == b.tops[1] ||
                                  a.tops[1] == b.tops[0] || a.tops[1] == b.tops[1]);
}

// Evidence from toes, knees and elbows that the first limbs are the left ones: -1 to 1. Toes and
// knees point ahead; elbows mostly point back, and count only without toes.
float leftness(const JointTree& tree, const std::array<Limb, 2>& arms,
               const std::array<Limb, 2>& legs) {
  float sum = 0;
  for (const JointPositions& pose : tree.poses()) {
    const Vec3 up = normalized(torso(pose, arms, legs));
    Vec3 ahead;
    bool toes = false;
    for (const Limb& leg : legs) {
      const Vec3 foot = end_of(pose, leg);
      ahead += pose[leg.lower] - middle(pose[leg.upper], foot);
      if (leg.end < 0) continue;
      const int tip = farthest_below(tree, leg.end);
      ahead += (pose[tip] - foot) * 2.0f;
      toes |= tip != leg.end;
    }
    for (const Limb& arm : arms) {
      if (!toes && arm.end >= 0) ahead += middle(pose[arm.upper], pose[arm.end]) - pose[arm.lower];
    }
    const Vec3 left = normalized(cross(up, ahead - up * dot(up, ahead)));
    const Vec3 across = pose[legs[0].upper] - pose[legs[1].upper];
    sum += dot(left, normalized(across));
  }
  return sum / static_cast<float>(tree.poses().size());
}

// Which side is left by the names below both tops: 1 the first, -1 the second, 0 unknown.
int named_left(const JointTree& tree, std::span<const JointName> names,
               const std::array<int, 2>& tops) {
  int votes = 0;
  for (int j = 0; j < tree.count(); ++j) {
    if (names[j].side == Side::none) continue;
    for (size_t side : {0, 1}) {
      if (!tree.is_above(tops[side], j)) continue;
      votes += (names[j].side == Side::left) == (side == 0) ? 1 : -1;
    }
  }
  return votes > 1 ? 1 : votes < -1 ? -1 : 0;
}

}  // namespace

float uprightness(const JointTree& tree, const std::array<Limb, 2>& arms,
                  const std::array<Limb, 2>& legs) {
  float max = -1;
  for (const JointPositions& pose : tree.poses()) {
    const Vec3 leg = middle(pose[legs[0].upper], pose[legs[1].upper]) -
                     middle(end_of(pose, legs[0]), end_of(pose, legs[1]));
    max = std::max(max, dot(normalized(leg), normalized(torso(pose, arms, legs))));
  }
  return max;
}

std::optional<Limbs> find_limbs_by_shape(const JointTree& tree, std::span<const JointName> names) {
  const std::vector<Pair> pairs = find_pairs(tree);
  const Pair *arms = nullptr, *legs = nullptr;
  float min = INFINITY;
  for (const Pair& leg : pairs) {
    if (!(leg.leg_oddity < 2 * kOddest)) continue;
    for (const Pair& arm : pairs) {
      if (!(arm.arm_oddity < 2 * kOddest) || entangled(tree, arm, leg)) continue;
      const float upright = uprightness(tree, arm.arms, leg.legs);
      if (upright < kUpright) continue;
      const float leg_length = upper_length(tree, leg.legs[0]) + lower_length(tree, leg.legs[0]);
      const float arm_length = upper_length(tree, arm.arms[0]) + lower_length(tree, arm.arms[0]);
      const float longer = leg_length / std::max(arm_length, 1e-9f);
      const float odd = arm.arm_oddity + leg.leg_oddity + square(std::log(longer / 1.5f) / 0.3f) +
                        10 * (1 - upright);
      if (odd < min) min = odd, arms = &arm, legs = &leg;
    }
  }
  if (!arms) return std::nullopt;

  Limbs out{arms->arms, legs->legs, "", 0.8f, 1};
  int first = named_left(tree, names, legs->tops);
  int first_arm = named_left(tree, names, arms->tops);
  out.side_reason = "by the sides in the names";
  if (first == 0 || first_arm == 0) {
    const float left = leftness(tree, out.arms, out.legs);
    out.side_reason = "by where toes, knees and elbows point";
    out.side_confidence = std::min(1.0f, std::abs(left));
    first = left >= 0 ? 1 : -1;
    float same = 0;
    for (const JointPositions& pose : tree.poses()) {
      same += dot(pose[legs->legs[0].upper] - pose[legs->legs[1].upper],
                  pose[arms->arms[0].upper] - pose[arms->arms[1].upper]);
    }
    first_arm = same >= 0 ? first : -first;
  }
  if (first < 0) std::swap(out.legs[0], out.legs[1]);
  if (first_arm < 0) std::swap(out.arms[0], out.arms[1]);
  return out;
}

}  // namespace panache
