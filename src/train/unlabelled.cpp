#include "train/unlabelled.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "learn/samples.h"
#include "pose/mirror.h"

namespace panache {
namespace {

constexpr int kNumbers = pose_feature_count(PoseLayout::positions);
constexpr int kWindowNumbers = kWindowPoses * kNumbers;
constexpr float kTempo = 0.1f;     // Deviation of the logarithm of how fast a sequence is played.
constexpr float kLongTake = 400;   // Frames; a longer take is drawn as often as this one.
constexpr float kBothArms = 0.6f;  // Share of the spliced sequences that take both.

using Sequence = std::array<float, kSequenceNumbers>;

void draw_sequence(const Take& take, Random& random, std::span<float, kSequenceNumbers> out) {
  const float spacing = kClassifiedSpacing * std::exp(kTempo * random.normal());
  const float window = static_cast<float>((kWindowPoses - 1) * kWindowSpacing * kTakeRate);
  const float span = (kSequenceInstants - 1) * spacing + window;
  const float end = static_cast<float>(take.frames() - 1), first = std::min(span, end);
  const float last = first + (end - first) * random.uniform();
  for (int i = 0; i < kSequenceInstants; ++i) {
    take_window(take, last - static_cast<float>(kSequenceInstants - 1 - i) * spacing, kNumbers,
                out.subspan(size_t(i) * kWindowNumbers, kWindowNumbers));
  }
  if (random.bits() & 1) mirror_poses(PoseLayout::positions, out);
}

// Puts the arm that begins with this shoulder on the body in its place, carried by the chest.
void splice_arm(const Sequence& from, int shoulder, std::span<float, kSequenceNumbers> to) {
  constexpr int kArmJoints = 4;
  for (size_t at = 0; at < to.size(); at += kNumbers) {
    const float* chest = &to[at] + 3 * index(HumanJoint::chest);
    const float* other_chest = &from[at] + 3 * index(HumanJoint::chest);
    for (int n = 3 * shoulder; n < 3 * (shoulder + kArmJoints); ++n) {
      to[at + n] = from[at + n] + chest[n % 3] - other_chest[n % 3];
    }
  }
}

}  // namespace

void UnlabelledMotion::Choice::add(const Take& take) {
  // Shorter ones hold no second of motion.
  if (take.frames() <= static_cast<int>(1.5 * kTakeRate)) return;
  takes.push_back(&take);
  share.push_back((share.empty() ? 0 : share.back()) +
                  std::min(static_cast<float>(take.frames()), kLongTake));
}

const Take& UnlabelledMotion::Choice::draw(Random& random) const {
  const float at = random.uniform() * share.back();
  const auto found = std::upper_bound(share.begin(), share.end() - 1, at);
  return *takes[found - share.begin()];
}

UnlabelledMotion::UnlabelledMotion(const std::vector<Take>& takes, const std::vector<Take>& neutral,
                                   const std::vector<int>& spliced) {
  for (const Take& take : takes) takes_.add(take);
  for (const int t : spliced) neutral_.add(neutral[t]);
}

void UnlabelledMotion::draw(float spliced_share, Random& random,
                            std::span<float, kSequenceNumbers> out) const {
  draw_sequence(takes_.draw(random), random, out);
  if (neutral_.takes.empty() || random.uniform() >= spliced_share) return;
  Sequence other;
  draw_sequence(neutral_.draw(random), random, other);
  if (random.bits() & 1) std::swap_ranges(other.begin(), other.end(), out.begin());
  const int left = index(HumanJoint::left_shoulder), right = index(HumanJoint::right_shoulder);
  const bool both = random.uniform() < kBothArms, first = random.bits() & 1;
  if (both || first) splice_arm(other, left, out);
  if (both || !first) splice_arm(other, right, out);
}

}  // namespace panache
