#include "rig/limbs.h"

#include <algorithm>
#include <cmath>

namespace panache {
namespace {

// Usual proportions, from a dozen rigs and two of our actors: means and deviations.
struct Usual {
  float upper_over_lower;          // Ratio of lengths; its logarithm deviates by kRatioDeviation.
  float offset, offset_deviation;  // From branch to upper joint, in lengths of the limb.
  float beyond, beyond_deviation;  // From end to fingertip or toe, in lower lengths; logarithm.
  float nothing_beyond;            // The deviation of a limb that stops at its end.
};
constexpr float kRatioDeviation = 0.2f;
constexpr float kBeyondFork = 9;
// No human limb has more joints, fingers and twists included. All choices of three of them are
// tried.
constexpr size_t kLongestLimb = 32;
constexpr Usual kArm = {1.1f, 0.42f, 0.2f, 0.55f, 0.55f, 1.4f};
constexpr Usual kLeg = {1.0f, 0.13f, 0.12f, 0.45f, 0.6f, 1.2f};

// The square of a deviation; linear beyond three deviations, since the positions of wrists and
// knees differ between tools.
float odd_of(float deviations) {
  const float size = std::abs(deviations);
  return size < 3 ? size * size : 6 * size - 9;
}

}  // namespace

float limb_oddity(const JointTree& tree, LimbKind kind, int branch, const Limb& limb) {
  const Usual& usual = kind == LimbKind::arm ? kArm : kLeg;
  constexpr float kTiny = 1e-9f;
  const float upper = std::max(tree.distance(limb.upper, limb.lower), kTiny);
  const float lower = std::max(
      limb.end < 0 ? tree.end_length(limb.lower) : tree.distance(limb.lower, limb.end), kTiny);
  const float offset = tree.distance(branch, limb.upper) / (upper + lower);
  const float beyond = limb.end < 0 ? 0 : tree.reach(limb.end) / lower;
  float odd = odd_of(std::log(upper / lower / usual.upper_over_lower) / kRatioDeviation);
  odd += odd_of((offset - usual.offset) / usual.offset_deviation);
  // The part beyond the end may be short or missing.
  odd += beyond < 0.02f ? odd_of(usual.nothing_beyond)
                        : odd_of(std::log(beyond / usual.beyond) / usual.beyond_deviation);
  // Fingers branch off at the hand; the hand is not one of them.
  if (limb.end >= 0) {
    const int passed = tree.forks(tree.parent(limb.end)) - tree.forks(limb.lower);
    odd += kBeyondFork * static_cast<float>(passed);
  }
  return odd;
}

int farthest_below(const JointTree& tree, int joint) {
  for (;;) {
    int longest = -1;
    float max = tree.end_length(joint);
    for (const int child : tree.children(joint)) {
      const float reach = tree.distance(joint, child) + tree.reach(child);
      if (reach > max) max = reach, longest = child;
    }
    if (longest < 0) return joint;
    joint = longest;
  }
}

std::vector<int> limb_chain(const JointTree& tree, int branch, int tip) {
  std::vector<int> upwards;
  for (int j = tip; j >= 0 && j != branch; j = tree.parent(j)) upwards.push_back(j);
  std::vector<int> chain;
  for (auto j = upwards.rbegin(); j != upwards.rend(); ++j) {
    if (tree.apart(chain.empty() ? branch : chain.back(), *j)) chain.push_back(*j);
  }
  return chain;
}

Limb usual_limb(const JointTree& tree, LimbKind kind, int branch, const std::vector<int>& chain,
                int end) {
  Limb best;
  float min = INFINITY;
  const auto consider = [&](const Limb& limb) {
    const float odd = limb_oddity(tree, kind, branch, limb);
    if (odd < min) min = odd, best = limb;
  };
  const size_t n = chain.size();
  if (end < 0 && n > kLongestLimb) return best;
  for (size_t u = 0; u < n; ++u) {
    for (size_t l = u + 1; l < n; ++l) {
      if (end >= 0) {
        if (l + 1 < n) consider({chain[u], chain[l], end});
        continue;
      }
      for (size_t e = l + 1; e < n; ++e) consider({chain[u], chain[l], chain[e]});
      if (l + 1 == n && tree.end_length(chain[l]) > 0) consider({chain[u], chain[l], -1});
    }
  }
  return best;
}

}  // namespace panache
