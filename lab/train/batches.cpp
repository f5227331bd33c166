#include "train/batches.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "pose/features.h"

namespace panache {

OutputUnits output_units(const SampleSet& set, const std::vector<int>& samples) {
  const size_t outputs = static_cast<size_t>(set.outputs());
  if (set.recipe().output_scale) {
    return {std::vector<float>(outputs), set.recipe().output_scale()};
  }
  std::vector<double> sum(outputs), squares(outputs);
  for (const int i : samples) {
    const std::span<const float> target = set.target(i);
    for (size_t o = 0; o < outputs; ++o) {
      sum[o] += target[o];
      squares[o] += double(target[o]) * target[o];
    }
  }
  OutputUnits units;
  const double count = std::max<double>(1, static_cast<double>(samples.size()));
  for (size_t o = 0; o < outputs; ++o) {
    const double mean = sum[o] / count;
    const double variance = std::max(squares[o] / count - mean * mean, 0.0);
    units.mean.push_back(static_cast<float>(mean));
    units.scale.push_back(static_cast<float>(std::max(std::sqrt(variance), 0.02)));
  }
  return units;
}

BatchMaker::BatchMaker(const SampleSet& set, std::vector<int> choice, int styles,
                       const BatchSettings& settings, OutputUnits units)
    : set_(set),
      choice_(std::move(choice)),
      styles_(styles),
      settings_(settings),
      units_(std::move(units)) {
  if (!settings_.by_style) return;
  std::map<std::pair<int, std::string>, std::vector<int>> cells;
  for (const int i : choice_) {
    const Sample& sample = set.samples()[i];
    if (sample.has_next && sample.style >= 0) {
      cells[{sample.style, set.content(sample)}].push_back(i);
    }
  }
  float total = 0;
  for (auto& [cell, samples] : cells) {
    total += std::sqrt(static_cast<float>(samples.size()));
    cells_.push_back({cell.first, std::move(samples), total});
  }
  for (Cell& cell : cells_) cell.share /= total;
}

Batch BatchMaker::make(Random& random) const {
  std::vector<Row> rows;
  std::vector<Disturbed> draws;
  std::vector<int64_t> groups;
  const auto mirrored = [&] { return settings_.mirrored && (random.bits() & 1); };
  if (!settings_.by_style) {
    for (int i = 0; i < settings_.size; ++i) {
      rows.push_back(
          {choice_[random.below(static_cast<uint32_t>(choice_.size()))], mirrored(), -1});
    }
    return fill(rows, draws, nullptr);
  }
  const int pairs = settings_.size / 2;
  std::vector<std::vector<const Cell*>> drawn(styles_);
  for (int p = 0; p < pairs; ++p) {
    const float at = random.uniform();
    auto cell =
        std::find_if(cells_.begin(), cells_.end() - 1, [&](const Cell& c) { return at < c.share; });
    drawn[cell->style].push_back(&*cell);
  }
  for (const std::vector<const Cell*>& of_style : drawn) {
    groups.push_back(2 * static_cast<int64_t>(of_style.size()));
    for (const Cell* cell : of_style) {
      const int sample = cell->samples[random.below(static_cast<uint32_t>(cell->samples.size()))];
      const bool flip = mirrored();
      int draw = -1;
      if (settings_.disturbed) {
        draw = static_cast<int>(draws.size());
        draws.push_back(draw_disturbance(settings_.disturbance, set_.units(), random));
      }
      rows.push_back({sample, flip, draw});
      rows.push_back({sample + 1, flip, draw});
    }
  }
  Batch batch = fill(rows, draws, &random);
  batch.group_sizes = std::move(groups);
  return batch;
}

Batch BatchMaker::plain(const std::vector<int>& samples) const {
  std::vector<Row> rows;
  rows.reserve(samples.size());
  for (const int i : samples) rows.push_back({i, false, -1});
  return fill(rows, {}, nullptr);
}

Batch BatchMaker::disturbed(const std::vector<int>& samples, Random& random) const {
  std::vector<Row> rows;
  std::vector<Disturbed> draws;
  Disturbance disturbance = kOtherPeople;
  disturbance.tempo = settings_.disturbance.tempo;
  for (const int i : samples) {
    rows.push_back({i, false, static_cast<int>(draws.size())});
    draws.push_back(draw_disturbance(disturbance, set_.units(), random));
  }
  return fill(rows, draws, &random);
}

Batch BatchMaker::fill(const std::vector<Row>& rows, const std::vector<Disturbed>& draws,
                       Random* random) const {
  const int64_t count = static_cast<int64_t>(rows.size());
  const int window = set_.inputs(), numbers = set_.numbers(), outputs = set_.outputs();
  const Recipe& recipe = set_.recipe();
  const int style_inputs = recipe.style_inputs(styles_), inputs = window + style_inputs;
  std::vector<float> strengths(static_cast<size_t>(styles_));
  Batch batch{torch::zeros({count, inputs}),
              torch::empty({count, outputs}),
              torch::empty({count, 1}),
              torch::empty({count, kFeet}),
              {}};
  const float clip = settings_.input_clip > 0 ? settings_.input_clip : INFINITY;
  for (int64_t r = 0; r < count; ++r) {
    const Row& row = rows[r];
    const Sample& sample = set_.samples()[row.sample];
    float* input = batch.inputs.data_ptr<float>() + r * inputs;
    const std::span<float> seen(input, window);
    set_.window(row.sample, seen, row.disturbed >= 0 ? draws[row.disturbed].tempo : 1);
    if (row.mirrored) mirror_poses(recipe.layout, seen);
    if (row.disturbed >= 0) {
      disturb(draws[row.disturbed], settings_.disturbance, *random, seen);
    }
    for (int i = 0; i < window; ++i) {
      const int n = i % numbers;
      input[i] = std::clamp((input[i] - set_.mean()[n]) / set_.scale()[n], -clip, clip);
    }
    if (sample.style >= 0) strengths[sample.style] = 1;
    recipe.write_style_inputs(strengths, {input + window, static_cast<size_t>(style_inputs)});
    if (sample.style >= 0) strengths[sample.style] = 0;

    float* pose = batch.pose.data_ptr<float>() + r * outputs;
    std::copy_n(set_.target(row.sample).begin(), outputs, pose);
    // A window that is played faster has less time of its own, in which the root moves faster.
    const float tempo = row.disturbed >= 0 ? draws[row.disturbed].tempo : 1;
    if (recipe.style_heads) {
      for (int o = StyleDelta::kSize - kRootFeatures; o < StyleDelta::kSize; ++o) pose[o] *= tempo;
    }
    if (row.mirrored) recipe.mirror_target({pose, static_cast<size_t>(outputs)});
    for (int i = 0; i < outputs; ++i) {
      pose[i] = (pose[i] - units_.mean[i]) / units_.scale[i];
    }
    batch.log_rate.data_ptr<float>()[r] = sample.log_rate - std::log(tempo);
    float* contacts = batch.contacts.data_ptr<float>() + r * kFeet;
    for (int f = 0; f < kFeet; ++f) contacts[f] = sample.contacts[row.mirrored ? 1 - f : f];
  }
  return batch;
}

}  // namespace panache
