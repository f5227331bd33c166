#pragma once
// Motion that was never captured in a style, as the networks meet it at run time. They are also
// trained on it if a guide can tell what a style looks like.

#include <span>
#include <vector>

#include "base/random.h"
#include "learn/take.h"
#include "train/classifier.h"

namespace panache {

// A sequence spans one window of the classifier: its instants in order of time, each with its own
// window of network inputs.
inline constexpr int kSequenceInstants = kClassifiedPoses;
inline constexpr int kSequenceNumbers =
    kSequenceInstants * kWindowPoses * pose_feature_count(PoseLayout::positions);

class UnlabelledMotion {
 public:
  // `takes`: the motion itself. Takes of `neutral` (features in layout positions) listed in
  // `spliced` exchange arms or upper bodies with it.
  UnlabelledMotion(const std::vector<Take>& takes, const std::vector<Take>& neutral,
                   const std::vector<int>& spliced);

  // A sequence of a random take, half of them mirrored. A share of the sequences combines this
  // motion with a neutral take: one provides one or both arms, as they hang on its chest, or
  // everything above its hips, the other the rest. This makes actions that were never captured.
  // out[instants][kWindowPoses][features of a pose]
  void draw(float spliced_share, Random& random, std::span<float, kSequenceNumbers> out) const;

  bool empty() const { return takes_.takes.empty(); }

 private:
  struct Choice {
    std::vector<const Take*> takes;
    std::vector<float> share;  // Cumulative, including this take; long takes are capped.
    void add(const Take& take);
    const Take& draw(Random& random) const;
  };
  Choice takes_, neutral_;
};

}  // namespace panache
