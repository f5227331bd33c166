#pragma once
// Recognises the styles of a motion with a remover, whose trunk has learnt features of styles.

#include <span>
#include <vector>

#include "base/result.h"
#include "clip/clip.h"
#include "learn/take.h"
#include "rig/rig.h"
#include "style/networks/networks.h"

namespace panache {

inline constexpr int kRecognisedFrames = 60;  // Window length, at kTakeRate, at most the take's,
inline constexpr int kRecognisedHop = 15;     // and the step from one to the next.

// Statistics are clamped to this many deviations from their mean.
inline constexpr float kFarthestStatistic = 4;

// The first frames of the windows of a take with `frames` frames; at least one.
std::vector<int> recognised_windows(int frames);

// Means and deviations of the activations of the pose trunk and of the pose features, over the
// window that begins at `first` of the take (features in the model's layout). `mirrored`: of the
// mirrored motion. out[Model::recognition_count()]
void write_statistics(const StyleNetworks& networks, const Take& take, int first, bool mirrored,
                      std::span<float> out);

struct StyleShare {
  int style = -1;  // Index in the remover; -1 is neutral.
  float share = 0;
};
// The share of each style of the remover except kAnyStyle, and of neutral, largest first; they sum
// to 1. Fails if the model cannot recognise styles.
Result<std::vector<StyleShare>> recognise_styles(const std::shared_ptr<const Model>& remover,
                                                 const Clip& clip, const Rig& rig);
// The same for a take with features in the model's layout.
Result<std::vector<StyleShare>> recognise_styles(const std::shared_ptr<const Model>& remover,
                                                 const Take& take);

// Writes the shares in the order of the remover's styles, then that of neutral; 0 for missing ones.
// out.size() = styles + 1
void write_shares(std::span<const StyleShare> shares, std::span<float> out) noexcept;

}  // namespace panache
