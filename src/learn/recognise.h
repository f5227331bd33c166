#pragma once
// Which styles a motion shows, told by a remover: its trunk has learnt what styles are made of.

#include <span>
#include <vector>

#include "base/result.h"
#include "clip/clip.h"
#include "learn/take.h"
#include "rig/rig.h"
#include "style/networks.h"

namespace panache {

inline constexpr int kRecognisedFrames = 60;  // Of a window, at kTakeRate; or a shorter take's all,
inline constexpr int kRecognisedHop = 15;     // and from one to the next.

// Deviations from its mean that a statistic counts at the most.
inline constexpr float kFarthestStatistic = 4;

// The first frames of the windows of a take of so many frames; at least one.
std::vector<int> recognised_windows(int frames);

// Means and deviations, over the window of the take (numbers in the model's layout) that begins at
// `first`, of the activations of the pose trunk and of the pose features. `mirrored`: of the motion
// left for right. out[Model::recognition_count()]
void write_statistics(const StyleNetworks& networks, const Take& take, int first, bool mirrored,
                      std::span<float> out);

struct StyleShare {
  int style = -1;  // Of the remover; -1 is neutral.
  float share = 0;
};
// How much of the motion shows each style of the remover but kAnyStyle, and neutral, the largest
// first; together 1. Fails where the model recognises no styles.
Result<std::vector<StyleShare>> recognise_styles(const std::shared_ptr<const Model>& remover,
                                                 const Clip& clip, const Rig& rig);
// The same of a take with numbers in the model's layout.
Result<std::vector<StyleShare>> recognise_styles(const std::shared_ptr<const Model>& remover,
                                                 const Take& take);

// Writes the shares in the order of the remover's styles, then that of neutral; 0 where there is
// none. out.size() = styles + 1
void write_shares(std::span<const StyleShare> shares, std::span<float> out) noexcept;

}  // namespace panache
