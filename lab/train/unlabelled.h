#pragma once
// Motion that nobody captured in any style: what the networks meet at run time, and are also
// trained on where there is a guide to tell them what a style looks like.

#include <span>
#include <vector>

#include "base/random.h"
#include "learn/take.h"
#include "train/classifier.h"

namespace panache {

// A sequence is what a classifier sees as one window: its instants in order of time, and for each
// of them the window that the networks see.
inline constexpr int kSequenceInstants = kClassifiedPoses;
inline constexpr int kSequenceNumbers =
    kSequenceInstants * kWindowPoses * pose_feature_count(PoseLayout::positions);

class UnlabelledMotion {
 public:
  // `takes`: the motion itself. `neutral`: of these takes (numbers in layout positions) those
  // listed in `spliced` lend it arms or upper bodies, and themselves borrow its.
  UnlabelledMotion(const std::vector<Take>& takes, const std::vector<Take>& neutral,
                   const std::vector<int>& spliced);

  // A sequence of any take, half of them mirrored. A share of the sequences is put together from
  // this motion and a neutral take, one giving the arms (or one arm) as they hang on its chest, or
  // all above its hips, the other everything else: actions that no one captured.
  // out[instants][kWindowPoses][numbers of a pose]
  void draw(float spliced_share, Random& random, std::span<float, kSequenceNumbers> out) const;

  bool empty() const { return takes_.takes.empty(); }

 private:
  struct Choice {
    std::vector<const Take*> takes;
    std::vector<float> share;  // Of this take and those before it: long ones count up to a limit.
    void add(const Take& take);
    const Take& draw(Random& random) const;
  };
  Choice takes_, neutral_;
};

}  // namespace panache
