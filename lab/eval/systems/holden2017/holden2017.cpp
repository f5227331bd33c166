#include "eval/systems/holden2017/holden2017.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "base/parallel.h"
#include "base/progress.h"
#include "eval/systems/whole_take.h"
#include "rig/canonical_body.h"
#include "takes/manifest.h"

namespace panache {

using namespace holden2017;

namespace {

// The motion of each style of `data`, for actions with pairs; `rows`: of all takes.
std::vector<StyleMotion> style_motions(const SystemData& data,
                                       const std::vector<torch::Tensor>& rows) {
  using Action = std::pair<int, std::string>;  // Set and content.
  std::map<std::pair<std::string, Action>, std::pair<std::set<int>, std::set<int>>> cells;
  for (const Pairing& pairing : data.pairings) {
    const ManifestRow& row = data.takes[pairing.styled].row;
    auto& [neutral, styled] = cells[{row.style, {row.set, row.content}}];
    neutral.insert(pairing.neutral);
    styled.insert(pairing.styled);
  }
  std::vector<StyleMotion> motions;
  for (const StyleName& style : data.styles) {
    StyleMotion& motion = motions.emplace_back();
    for (const auto& [cell, takes] : cells) {
      if (cell.first != style.name) continue;
      StyleMotion::Action& action = motion.actions.emplace_back();
      for (const int t : takes.first) action.neutral.push_back(rows[t]);
      for (const int t : takes.second) action.styled.push_back(rows[t]);
    }
  }
  return motions;
}

// The change from one body (body frame) to another; a change consists of rotations only, so bones
// keep their lengths.
StyleDelta change_to(const HumanPositions& before, const HumanPositions& after) {
  std::array<Quat, kHumanJoints> from, to;
  canonical_frames(before, 0, from);
  canonical_frames(after, 0, to);
  StyleDelta change;
  for (int j = 0; j < kHumanJoints; ++j) {
    change.rotations[j] = log_rotation(to[j] * conjugate(from[j]));
  }
  change.hips_height = after[0].y - before[0].y;
  return change;
}

}  // namespace

Result<std::unique_ptr<Holden2017>> Holden2017::create(const std::string& name,
                                                       const SystemData& data,
                                                       const HoldenSettings& settings) {
  if (data.pairings.empty()) {
    return Error{name + ": there is no pair of a neutral and a styled take to learn from"};
  }
  Progress progress("training " + name);
  std::vector<torch::Tensor> rows, neutral;
  for (const Take& take : data.takes) {
    rows.push_back(motion_rows(take));
    if (take.row.neutral) neutral.push_back(rows.back());
  }
  for (const Take& take : data.unlabelled) neutral.push_back(motion_rows(take));
  RowUnits units(neutral);
  for (std::vector<torch::Tensor>* motions : {&rows, &neutral}) {
    for (torch::Tensor& motion : *motions) motion = units.normalise(motion);
  }
  const Autoencoder loss_network(Windows(neutral), data.seed * 31 + 7, settings.autoencoder);
  progress.update(0.3);

  const std::vector<StyleMotion> motions = style_motions(data, rows);
  TransferSettings transfer = settings.transfer;
  transfer.steps = std::min(transfer.steps, settings.all_steps / static_cast<int>(motions.size()));
  std::vector<std::optional<Transfer>> made(motions.size());
  std::atomic<int> done = 0;
  parallel_for(static_cast<int>(motions.size()), [&](int i) {
    if (!motions[i].actions.empty()) {
      made[i].emplace(loss_network, units, motions[i], data.seed * 31 + 8 + i, transfer);
    }
    progress.update(0.3 + 0.7 * ++done / static_cast<double>(motions.size()));
  });
  std::vector<std::string> styles;
  std::vector<Transfer> networks;
  for (size_t i = 0; i < made.size(); ++i) {
    if (!made[i]) continue;
    styles.push_back(data.styles[i].name);
    networks.push_back(std::move(*made[i]));
  }
  return std::unique_ptr<Holden2017>(
      new Holden2017(name, std::move(styles), std::move(units), std::move(networks)));
}

Holden2017::Holden2017(std::string name, std::vector<std::string> styles, RowUnits units,
                       std::vector<Transfer> networks)
    : ChangeSystem(std::move(name), std::move(styles)),
      units_(std::move(units)),
      networks_(std::move(networks)) {}

SystemFacts Holden2017::facts() const {
  SystemFacts facts;
  for (const Transfer& network : networks_) facts.parameters += network.parameters();
  facts.bytes = facts.parameters * sizeof(float);
  return facts;
}

std::unique_ptr<ChangeSource> Holden2017::make_source(const Take& take, double begin,
                                                      const Strengths& strengths) const {
  if (strengths.empty())
    return std::make_unique<WholeTakeSource>(take, begin, std::vector<StyleDelta>());
  const torch::NoGradGuard no_gradients;
  const torch::Tensor rows = units_.normalise(motion_rows(take)).unsqueeze(0);
  std::vector<std::array<float, StyleDelta::kSize>> sums(take.frames());
  for (const auto& [style, strength] : strengths) {
    const torch::Tensor styled = units_.undo(networks_[style](rows)[0]).t().contiguous();
    for (int f = 0; f < take.frames(); ++f) {
      const std::span<const float> pose(styled.data_ptr<float>() + int64_t{f} * kRows, kPoseRows);
      std::array<float, StyleDelta::kSize> change;
      pack(change_to(take.body[f], read_positions(pose)), change);
      for (size_t n = 0; n < change.size(); ++n) sums[f][n] += strength * change[n];
    }
  }
  std::vector<StyleDelta> changes;
  changes.reserve(sums.size());
  for (const auto& sum : sums) changes.push_back(unpack(sum));
  return std::make_unique<WholeTakeSource>(take, begin, std::move(changes));
}

}  // namespace panache
