#include "train/removal.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>
#include <numeric>

#include "base/elementary.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "base/random.h"
#include "style/restyle.h"
#include "takes/load_takes.h"

namespace panache {
namespace {

constexpr double kPartSeconds = 6;                 // Maximum length of a restyled part,
constexpr double kMinSeconds = 1.5;                // and minimum.
constexpr const char* kRestyled = "restyled";      // Content name of the model's output,
constexpr const char* kUnlabelled = "unlabelled";  // and of its input.

Clip part_of(const Clip& clip, int first, int frames) {
  Clip part;
  part.skeleton = clip.skeleton;
  part.frame_time = clip.frame_time;
  for (int f = first; f < first + frames; ++f) part.append(clip.pose(f));
  return part;
}

// A part of a clip, the model's output for it, and the source of each output frame.
struct RestyledPart {
  Take neutral, styled;
  std::vector<float> neutral_frames;  // Per frame of the styled take.
};

Result<std::optional<RestyledPart>> restyle_part(const ManifestRow& row,
                                                 const std::shared_ptr<const Model>& model,
                                                 Random random) {
  const Result<RiggedClip> from = load_clip(row.path);
  if (!from) return from.error();
  const auto& [clip, rig] = *from;
  const int first = std::min(rig.first_frame(), clip.frames - 1);
  const int frames = clip.frames - first;
  if (frames * clip.frame_time < kMinSeconds) return std::optional<RestyledPart>();
  const int length = std::min(frames, static_cast<int>(kPartSeconds / clip.frame_time));
  const int begin = static_cast<int>(random.below(static_cast<uint32_t>(frames - length + 1)));
  const Clip part = part_of(clip, begin, first + length);
  const int style = static_cast<int>(random.below(static_cast<uint32_t>(model->styles().size())));
  RestyleOptions options;
  options.loop = LoopMode::off;
  Result<Restyled> restyled = restyle(part, rig, model, {{style, {{0, 1}}}}, options);
  if (!restyled) return located(row.path, restyled.error());

  RestyledPart made;
  made.neutral = make_take(part, rig, PoseLayout::positions);
  made.styled = make_take(restyled->clip, rig, PoseLayout::positions);
  made.neutral.row = made.styled.row = row;
  made.neutral.row.content = kUnlabelled;
  made.neutral.row.style = "neutral";
  made.neutral.row.neutral = true;
  made.styled.row.content = kRestyled;
  made.styled.row.style = model->styles()[style].name;
  made.styled.row.neutral = false;
  const double step = 1 / (kTakeRate * clip.frame_time);
  for (int f = 0; f < made.styled.frames(); ++f) {
    const double source = between(restyled->source_frames, first + f * step);
    const double last = made.neutral.frames() - 1;
    made.neutral_frames.push_back(
        static_cast<float>(std::clamp((source - first) / step, 0.0, last)));
  }
  return std::optional(std::move(made));
}

Pairing pairing_of(const std::vector<float>& neutral_frames, int styled, int neutral) {
  Pairing pairing;
  pairing.styled = styled;
  pairing.neutral = neutral;
  pairing.neutral_frames = neutral_frames;
  const int last = static_cast<int>(neutral_frames.size()) - 1;
  for (int f = 0; f <= last; ++f) {
    const int a = std::max(f - 1, 0), b = std::min(f + 1, last);
    pairing.rates.push_back((neutral_frames[b] - neutral_frames[a]) /
                            static_cast<float>(std::max(b - a, 1)));
  }
  return pairing;
}

// A take paired with itself, for which no change is learnt.
Pairing unchanged(const Take& take, int index) {
  std::vector<float> frames(take.frames());
  std::iota(frames.begin(), frames.end(), 0.0f);
  return pairing_of(frames, index, index);
}

Result<std::vector<Pairing>> add_restyled(const Model& model,
                                          const std::vector<ManifestRow>& unlabelled, uint64_t seed,
                                          TrainingData& data) {
  std::vector<ManifestRow> rows;
  for (const ManifestRow& row : unlabelled) {
    if (!row.test) rows.push_back(row);
  }
  const std::shared_ptr<const Model> shared(std::shared_ptr<const Model>(), &model);
  Progress progress("restyling unlabelled motion");
  std::mutex mutex;
  int done = 0;
  auto parts = parallel_results<std::optional<RestyledPart>>(rows.size(), [&](int i) {
    auto part = restyle_part(rows[i], shared, Random(seed * 1000003 + static_cast<uint64_t>(i)));
    const std::lock_guard lock(mutex);
    progress.update(static_cast<double>(++done) / static_cast<double>(rows.size()));
    return part;
  });
  if (!parts) return parts.error();
  std::vector<Pairing> pairings;
  for (std::optional<RestyledPart>& part : *parts) {
    if (!part) continue;
    const int index = static_cast<int>(data.takes.size());
    data.takes.push_back(std::move(part->neutral));
    data.takes.push_back(std::move(part->styled));
    pairings.push_back(pairing_of(part->neutral_frames, index + 1, index));
  }
  return pairings;
}

}  // namespace

std::optional<Pairing> reversed(const Pairing& pairing) {
  const std::vector<float>& frames = pairing.neutral_frames;
  Pairing back;
  back.styled = pairing.neutral;
  back.neutral = pairing.styled;
  back.cost = pairing.cost;
  back.first = static_cast<int>(std::ceil(frames.front()));
  const int end = static_cast<int>(std::floor(frames.back()));
  size_t i = 0;
  for (int f = back.first; f <= end; ++f) {
    // If the path stands still at a frame, the first instant counts.
    while (i + 2 < frames.size() && frames[i + 1] < static_cast<float>(f)) ++i;
    const float rise = frames[i + 1] - frames[i];
    const float share =
        rise > 0 ? std::clamp((static_cast<float>(f) - frames[i]) / rise, 0.0f, 1.0f) : 0;
    back.neutral_frames.push_back(static_cast<float>(pairing.first) + static_cast<float>(i) +
                                  share);
    back.rates.push_back(1 /
                         believable_rate(std::lerp(pairing.rates[i], pairing.rates[i + 1], share)));
  }
  if (back.rates.size() <= 2) return std::nullopt;
  return back;
}

int take_with_style(const std::vector<Take>& takes, const Sample& sample) {
  return takes[sample.styled].row.neutral ? sample.take : sample.styled;
}

Result<void> prepare_removal(const Model& model, const std::vector<ManifestRow>& unlabelled,
                             uint64_t seed, TrainingData& data) {
  std::vector<Pairing> pairings = data.pairings;
  Result<std::vector<Pairing>> restyled = add_restyled(model, unlabelled, seed, data);
  if (!restyled) return restyled.error();
  pairings.insert(pairings.end(), restyled->begin(), restyled->end());
  for (const Pairing& pairing : pairings) {
    std::optional<Pairing> back = reversed(pairing);
    if (!back) continue;
    for (const std::string& style :
         {data.takes[pairing.styled].row.style, std::string(kAnyStyle)}) {
      back->style = style;
      data.removal.push_back(*back);
    }
  }
  for (size_t t = 0; t < data.takes.size(); ++t) {
    if (!data.takes[t].row.neutral) continue;
    data.removal.push_back(unchanged(data.takes[t], static_cast<int>(t)));
    data.removal.back().style = kAnyStyle;
  }
  return {};
}

}  // namespace panache
