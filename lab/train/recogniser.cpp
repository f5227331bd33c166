#include "train/removal.h"

#include <map>

#include <torch/nn/functional/loss.h>
#include <torch/optim/adamw.h>
#include <torch/types.h>

#include "base/parallel.h"
#include "base/random.h"
#include "learn/recognise.h"
#include "style/networks/networks.h"
#include "train/network.h"

namespace panache {
namespace {

constexpr int kSteps = 4000, kBatch = 512;
constexpr float kRate = 0.004f, kDecay = 0.3f, kNoise = 0.3f;
constexpr float kNeutralShare = 0.35f;     // Of a batch.
constexpr float kMinRawDeviation = 0.02f;  // Of a statistic.

// Rows of a class, by content, so that actions with many rows do not dominate.
using Cells = std::vector<std::vector<std::vector<int64_t>>>;  // [classes][contents][rows]

std::vector<int64_t> draw_rows(const Cells& cells, Random& random, std::vector<int64_t>& labels) {
  std::vector<int64_t> rows;
  labels.clear();
  const auto neutral = static_cast<int64_t>(cells.size()) - 1;
  while (rows.size() < kBatch) {
    const int64_t label =
        random.uniform() < kNeutralShare ? neutral : random.below(static_cast<uint32_t>(neutral));
    const auto& contents = cells[label];
    if (contents.empty()) continue;
    const auto& of = contents[random.below(static_cast<uint32_t>(contents.size()))];
    rows.push_back(of[random.below(static_cast<uint32_t>(of.size()))]);
    labels.push_back(label);
  }
  return rows;
}

}  // namespace

Result<void> add_recognition(const std::vector<Take>& takes, uint64_t seed, TensorFile& file) {
  Result<std::shared_ptr<const Model>> model =
      Model::parse(format_safetensors(file), "the exported model");
  if (!model) return model.error();
  const std::vector<StyleInfo>& styles = (*model)->styles();
  const auto count = static_cast<int64_t>((*model)->recognition_count());
  std::vector<torch::Tensor> rows(takes.size());
  std::vector<int64_t> labels(takes.size(), -1);
  parallel_for(static_cast<int>(takes.size()), [&](int t) {
    const ManifestRow& row = takes[t].row;
    for (size_t s = 0; s < styles.size(); ++s) {
      if (!row.neutral && styles[s].name == row.style) labels[t] = static_cast<int64_t>(s);
    }
    if (row.neutral) labels[t] = static_cast<int64_t>(styles.size());
    if (labels[t] < 0) return;
    const StyleNetworks networks(*model);
    const std::vector<int> windows = recognised_windows(takes[t].frames());
    rows[t] = torch::empty({2 * static_cast<int64_t>(windows.size()), count});
    float* out = rows[t].data_ptr<float>();
    for (const int first : windows) {
      for (const bool mirrored : {false, true}) {
        write_statistics(networks, takes[t], first, mirrored, {out, static_cast<size_t>(count)});
        out += count;
      }
    }
  });
  std::vector<std::map<std::string, std::vector<int64_t>>> found(styles.size() + 1);
  std::vector<torch::Tensor> used;
  int64_t at = 0;
  for (size_t t = 0; t < takes.size(); ++t) {
    if (labels[t] < 0) continue;
    std::vector<int64_t>& cell = found[labels[t]][takes[t].row.content];
    for (int64_t r = 0; r < rows[t].size(0); ++r) cell.push_back(at++);
    used.push_back(rows[t]);
  }
  Cells cells(found.size());
  for (size_t c = 0; c < found.size(); ++c) {
    for (auto& [content, of] : found[c]) cells[c].push_back(std::move(of));
  }
  const torch::Tensor raw = torch::cat(used);
  const torch::Tensor mean = raw.mean(0);
  const torch::Tensor factor = 1 / (raw.std(0, false) + kMinRawDeviation);
  const torch::Tensor all = ((raw - mean) * factor).clamp(-kFarthestStatistic, kFarthestStatistic);

  torch::Tensor weight = torch::zeros({count, static_cast<int64_t>(cells.size())});
  torch::Tensor bias = torch::zeros({static_cast<int64_t>(cells.size())});
  weight.set_requires_grad(true);
  bias.set_requires_grad(true);
  torch::optim::AdamW optimizer({weight, bias},
                                torch::optim::AdamWOptions(kRate).weight_decay(kDecay));
  torch::manual_seed(seed);
  Random random(seed);
  for (int step = 0; step < kSteps; ++step) {
    std::vector<int64_t> wanted;
    const std::vector<int64_t> drawn = draw_rows(cells, random, wanted);
    torch::Tensor x = all.index_select(0, torch::tensor(drawn));
    x = x + kNoise * torch::randn_like(x);
    const torch::Tensor loss =
        torch::nn::functional::cross_entropy(torch::addmm(bias, x, weight), torch::tensor(wanted));
    optimizer.zero_grad();
    loss.backward();
    static_cast<torch::optim::AdamWOptions&>(optimizer.param_groups()[0].options())
        .lr(kRate * (1 - static_cast<double>(step) / kSteps));
    optimizer.step();
  }
  file.tensors["recognition.mean"] = to_tensor(mean);
  file.tensors["recognition.factor"] = to_tensor(factor);
  file.tensors["recognition.weight"] = to_tensor(weight);
  file.tensors["recognition.bias"] = to_tensor(bias);
  return {};
}

}  // namespace panache
