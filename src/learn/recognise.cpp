#include "learn/recognise.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "base/elementary.h"
#include "learn/samples.h"
#include "net/rows.h"
#include "pose/features.h"
#include "style/model/model.h"

namespace panache {
namespace {

constexpr int kStride = 3;  // One of this many frames of a window is evaluated.

}  // namespace

std::vector<int> recognised_windows(int frames) {
  std::vector<int> first;
  for (int f = 0; f == 0 || f + kRecognisedFrames <= frames; f += kRecognisedHop)
    first.push_back(f);
  return first;
}

void write_statistics(const StyleNetworks& networks, const Take& take, int first, bool mirrored,
                      std::span<float> out) {
  const PoseLayout layout = networks.model().layout();
  const int numbers = pose_feature_count(layout);
  const size_t activations = networks.model().activation_count();
  const size_t count = activations + numbers;
  const std::span<float> mean = out.first(count), deviation = out.subspan(count, count);
  std::fill(out.begin(), out.end(), 0.0f);
  std::vector<float> window(kWindowPoses * numbers), now(count);
  const int last = std::min(first + kRecognisedFrames, take.frames());
  int instants = 0;
  for (int f = first; f < last; f += kStride, ++instants) {
    take_window(take, static_cast<float>(f), numbers, window);
    if (mirrored) mirror_poses(layout, window);
    networks.activations(window, std::span(now).first(activations));
    std::copy_n(window.begin(), numbers, now.begin() + activations);
    for (size_t n = 0; n < count; ++n) {
      mean[n] += now[n];
      deviation[n] += now[n] * now[n];
    }
  }
  for (size_t n = 0; n < count; ++n) {
    mean[n] /= static_cast<float>(instants);
    const float variance = deviation[n] / static_cast<float>(instants) - mean[n] * mean[n];
    deviation[n] = std::sqrt(std::max(variance, 0.0f));
  }
}

Result<std::vector<StyleShare>> recognise_styles(const std::shared_ptr<const Model>& remover,
                                                 const Take& take) {
  const Model::Recognition* recognition = remover->recognition();
  if (!recognition) {
    return Error{"the model recognises no styles; expected one that takes them off"};
  }
  const StyleNetworks networks(remover);
  const size_t classes = remover->styles().size() + 1;
  AlignedVector<float> statistics(padded(remover->recognition_count()));
  AlignedVector<float> scores(recognition->layer.width());
  std::vector<float> shares(classes);
  const std::vector<int> windows = recognised_windows(take.frames());
  for (const int first : windows) {
    const std::span<float> numbers = std::span(statistics).first(remover->recognition_count());
    write_statistics(networks, take, first, false, numbers);
    for (size_t n = 0; n < numbers.size(); ++n) {
      numbers[n] = std::clamp((numbers[n] - recognition->mean[n]) * recognition->factor[n],
                              -kFarthestStatistic, kFarthestStatistic);
    }
    recognition->layer.forward({statistics.data(), 1, 0}, {scores.data(), 1, 0});
    const float top = *std::max_element(scores.begin(), scores.begin() + classes);
    float sum = 0;
    for (size_t c = 0; c < classes; ++c) sum += scores[c] = exponential(scores[c] - top);
    for (size_t c = 0; c < classes; ++c) {
      shares[c] += scores[c] / sum / static_cast<float>(windows.size());
    }
  }
  std::vector<StyleShare> found;
  for (size_t c = 0; c < classes; ++c) {
    const bool neutral = c + 1 == classes;
    if (!neutral && remover->styles()[c].name == kAnyStyle) continue;
    found.push_back({neutral ? -1 : static_cast<int>(c), shares[c]});
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const StyleShare& a, const StyleShare& b) { return a.share > b.share; });
  return found;
}

Result<std::vector<StyleShare>> recognise_styles(const std::shared_ptr<const Model>& remover,
                                                 const Clip& clip, const Rig& rig) {
  return recognise_styles(remover, make_take(clip, rig, remover->layout()));
}

void write_shares(std::span<const StyleShare> shares, std::span<float> out) noexcept {
  std::fill(out.begin(), out.end(), 0.0f);
  for (const auto& [style, share] : shares) {
    out[style < 0 ? int(out.size()) - 1 : style] = share;
  }
}

}  // namespace panache
