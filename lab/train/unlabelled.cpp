#include "train/unlabelled.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "learn/samples.h"
#include "pose/features.h"

namespace panache {
namespace {

constexpr int kNumbers = pose_feature_count(PoseLayout::positions);
constexpr int kWindowNumbers = kWindowPoses * kNumbers;
constexpr float kTempo = 0.1f;    // Standard deviation of the logarithm of the playback speed.
constexpr float kLongTake = 400;  // Frames; longer takes are drawn no more often.
// Share of the spliced sequences that take the whole upper body, and of those that take arms, the
// share that take both.
constexpr float kUpperBody = 0.5f, kBothArms = 0.6f;

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

// Replaces the body's joints from `first` to `last` with the other's, relative to a parent joint.
void splice(const Sequence& from, HumanJoint carrier, HumanJoint first, HumanJoint last,
            std::span<float, kSequenceNumbers> to) {
  for (size_t at = 0; at < to.size(); at += kNumbers) {
    const float* carried = &to[at] + 3 * index(carrier);
    const float* other = &from[at] + 3 * index(carrier);
    for (int n = 3 * index(first); n < 3 * (index(last) + 1); ++n) {
      to[at + n] = from[at + n] + carried[n % 3] - other[n % 3];
    }
  }
}

}  // namespace

void UnlabelledMotion::Choice::add(const Take& take) {
  // Shorter takes do not fill one second.
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
  using enum HumanJoint;
  if (random.uniform() < kUpperBody) {
    splice(other, hips, spine, right_hand, out);
    return;
  }
  const bool both = random.uniform() < kBothArms, first = random.bits() & 1;
  if (both || first) splice(other, chest, left_shoulder, left_hand, out);
  if (both || !first) splice(other, chest, right_shoulder, right_hand, out);
}

}  // namespace panache
