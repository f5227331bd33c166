#include "learn/samples.h"

#include "api/errors.h"
#include "api/objects.h"
#include "api/poses.h"
#include "learn/pairing.h"
#include "recipes/recipe.h"

using namespace panache;
using namespace panache::api;

namespace {

constexpr PoseLayout kLayout = PoseLayout::positions;
static_assert(PANACHE_WINDOW_SIZE == kWindowPoses * pose_feature_count(kLayout));
static_assert(PANACHE_CHANGE_SIZE == StyleDelta::kSize);

void add_neutral(const Take& take, panache_samples& out) {
  std::vector<float> window(PANACHE_WINDOW_SIZE);
  for (int f = 0; f < take.frames(); ++f) {
    take_window(take, static_cast<float>(f), pose_feature_count(kLayout), window);
    out.windows.insert(out.windows.end(), window.begin(), window.end());
    out.changes.resize(out.changes.size() + PANACHE_CHANGE_SIZE);
    out.log_rates.push_back(0);
    for (const bool planted : take.contacts[f]) out.contacts.push_back(planted ? 1.0f : 0.0f);
  }
  out.count += take.frames();
}

Result<void> add_pair(LearnPair pair, panache_samples& out) {
  std::vector<Take> takes = {std::move(pair.neutral), std::move(pair.styled)};
  takes[0].row.neutral = true;
  takes[1].row.style = "styled";
  const std::vector<Pairing> pairings = pair_in_phase(takes, 1, 0, pair.neutral_cycle);
  if (pairings.empty()) {
    return Error{pair.neutral_name + " and " + pair.styled_name +
                 ": no match was found between them, as the neutral one is too short for the "
                 "styled one; a pair shows one action, done neutrally and in the style"};
  }
  const SampleSet set(takes, pairings, {"styled"}, default_recipe(), false);
  std::vector<float> window(PANACHE_WINDOW_SIZE);
  for (size_t i = 0; i < set.samples().size(); ++i) {
    const Sample& sample = set.samples()[i];
    set.window(i, window);
    out.windows.insert(out.windows.end(), window.begin(), window.end());
    out.changes.insert(out.changes.end(), set.target(i).begin(), set.target(i).end());
    out.log_rates.push_back(sample.log_rate);
    out.contacts.insert(out.contacts.end(), sample.contacts.begin(), sample.contacts.end());
  }
  out.count += static_cast<int32_t>(set.samples().size());
  return {};
}

Result<void> add(const panache_pair& pair, const std::string& name, panache_samples& out) {
  const std::string neutral_name = name + ", neutral", styled_name = name + ", styled";
  const Result<Clip> neutral = read_clip(pair.neutral, Rotations::unit, neutral_name);
  if (!neutral) return neutral.error();
  if (neutral->frames == 0) return Error{neutral_name + ": has no frames"};
  const Rig& rig = pair.neutral.skeleton->rig;
  if (pair.styled.frame_count == 0) {
    add_neutral(make_take(*neutral, rig, kLayout), out);
    return {};
  }
  const Result<Clip> styled = read_clip(pair.styled, Rotations::unit, styled_name);
  if (!styled) return styled.error();
  Result<LearnPair> takes = make_learn_pair({*neutral, rig, neutral_name},
                                            {*styled, pair.styled.skeleton->rig, styled_name});
  if (!takes) return takes.error();
  return add_pair(*std::move(takes), out);
}

}  // namespace

panache_status panache_samples_create(const panache_pair* pairs, int32_t pair_count,
                                      panache_samples** out) {
  start(out);
  return guarded([&] {
    auto samples = std::make_unique<panache_samples>();
    for (int32_t p = 0; p < pair_count; ++p) {
      auto added = add(pairs[p], "pair " + std::to_string(p + 1), *samples);
      if (!added) return fail(PANACHE_BAD_CLIP, added.error());
    }
    *out = samples.release();
    return PANACHE_OK;
  });
}

void panache_samples_destroy(panache_samples* samples) { delete samples; }

int32_t panache_samples_count(const panache_samples* samples) { return samples->count; }
const float* panache_samples_windows(const panache_samples* samples) {
  return samples->windows.data();
}
const float* panache_samples_changes(const panache_samples* samples) {
  return samples->changes.data();
}
const float* panache_samples_log_rates(const panache_samples* samples) {
  return samples->log_rates.data();
}
const float* panache_samples_contacts(const panache_samples* samples) {
  return samples->contacts.data();
}
