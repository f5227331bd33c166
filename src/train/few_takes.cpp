#include "train/few_takes.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "base/quat.h"
#include "style/pose_change.h"

namespace panache {
namespace {

constexpr size_t kFew = 2;         // Takes that say as much of how they were acted as of the style.
constexpr size_t kManyStyles = 5;  // What so many styles change alike is not of a style.
// A hand is elsewhere if it is this far, and this much farther than the style's hands usually are,
// from where the style mostly puts it. Metres; times the median over the actions.
constexpr float kElsewhere = 0.35f, kUnusual = 1.75f;
// An action says how a style holds its arms if it does so in this share of its samples.
constexpr float kEnough = 0.2f;

constexpr int kArm = index(HumanJoint::left_shoulder);  // The first of an arm's four joints.
using Arm = std::array<Vec3, 4>;                        // Rotation vectors, of the left side.
constexpr size_t kSides = 2;

using Action = std::pair<int, std::string>;  // Set and content.
struct Cell {
  int style = 0;
  Action action;
  std::vector<size_t> samples;
  bool few = false;  // Styled takes.
};

std::vector<Cell> cells_of(const std::vector<Take>& takes, const SampleSet& set) {
  std::map<std::pair<int, Action>, Cell> found;
  std::map<std::pair<int, Action>, std::set<int>> styled;
  for (size_t i = 0; i < set.samples().size(); ++i) {
    const Sample& sample = set.samples()[i];
    if (sample.style < 0) continue;
    const std::pair key{sample.style, Action{takes[sample.take].row.set, set.content(sample)}};
    found[key].samples.push_back(i);
    styled[key].insert(sample.styled);
  }
  std::vector<Cell> cells;
  cells.reserve(found.size());
  for (auto& [key, cell] : found) {
    cell.style = key.first;
    cell.action = key.second;
    cell.few = styled[key].size() <= kFew;
    cells.push_back(std::move(cell));
  }
  return cells;
}

StyleDelta change_of(const SampleSet& set, size_t sample) {
  return unpack(set.target(sample).first<StyleDelta::kSize>());
}

float median(std::vector<float> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

using Numbers = std::array<float, StyleDelta::kSize>;
void add(std::span<const float> numbers, float factor, Numbers& sum) {
  for (size_t n = 0; n < sum.size(); ++n) sum[n] += factor * numbers[n];
}

// Step 1 of correct_few_takes().
void take_off_common_change(const std::vector<Cell>& cells, SampleSet& set) {
  std::vector<Numbers> cell_mean(cells.size());
  std::map<int, std::vector<size_t>> of_style;
  std::map<Action, std::vector<size_t>> of_action;
  for (size_t c = 0; c < cells.size(); ++c) {
    for (const size_t i : cells[c].samples) {
      add(set.target(i), 1 / static_cast<float>(cells[c].samples.size()), cell_mean[c]);
    }
    of_style[cells[c].style].push_back(c);
    of_action[cells[c].action].push_back(c);
  }
  // What a style changes in most actions: one that is odd in all styles must not leak into others.
  std::map<int, Numbers> usual;
  for (const auto& [style, members] : of_style) {
    for (size_t n = 0; n < StyleDelta::kSize; ++n) {
      std::vector<float> values;
      for (const size_t c : members) values.push_back(cell_mean[c][n]);
      usual[style][n] = median(std::move(values));
    }
  }
  for (const auto& [action, members] : of_action) {
    std::set<int> neutral;
    for (const size_t c : members) {
      for (const size_t i : cells[c].samples) neutral.insert(set.samples()[i].take);
    }
    if (members.size() < kManyStyles || neutral.size() > kFew) continue;
    Numbers alike{};
    for (const size_t c : members) {
      const float share = 1 / static_cast<float>(members.size());
      add(cell_mean[c], share, alike);
      add(usual[cells[c].style], -share, alike);
    }
    const StyleDelta common = unpack(alike);
    std::array<Quat, kHumanJoints> back;
    for (int j = 0; j < kHumanJoints; ++j) {
      back[j] = conjugate(exp_rotation(common.rotations[j]));
    }
    for (const size_t c : members) {
      for (const size_t i : cells[c].samples) {
        StyleDelta change = change_of(set, i);
        for (int j = 0; j < kHumanJoints; ++j) {
          change.rotations[j] = log_rotation(exp_rotation(change.rotations[j]) * back[j]);
        }
        change.hips_height -= common.hips_height;
        pack(change, set.target(i).first<StyleDelta::kSize>());
      }
    }
  }
}

// Where the change puts the hands, relative to the chest and to where they were; both as left ones.
std::array<Vec3, kSides> hand_ways(const std::vector<Take>& takes, const SampleSet& set, size_t i) {
  const Sample& sample = set.samples()[i];
  const HumanPositions before = body_at(takes[sample.take], sample.frame);
  const HumanPositions after = change_body(before, change_of(set, i));
  std::array<Vec3, kSides> ways;
  for (size_t side = 0; side < kSides; ++side) {
    const auto hand = [&](const HumanPositions& body) {
      const HumanPositions seen = side == 0 ? body : mirrored(body);
      return seen[index(HumanJoint::left_hand)] - seen[index(HumanJoint::chest)];
    };
    ways[side] = hand(after) - hand(before);
  }
  return ways;
}

// The arm of this side, as a left one.
Arm arm_of(const StyleDelta& change, size_t side) {
  const StyleDelta seen = side == 0 ? change : mirrored(change);
  Arm arm;
  std::copy_n(&seen.rotations[kArm], arm.size(), arm.begin());
  return arm;
}

void put_arm(const Arm& arm, size_t side, StyleDelta& change) {
  if (side == 1) change = mirrored(change);
  std::copy(arm.begin(), arm.end(), &change.rotations[kArm]);
  if (side == 1) change = mirrored(change);
}

// Step 2, for the cells of one style. Returns how many arms it replaced.
int replace_arms(const std::vector<Take>& takes, const std::vector<const Cell*>& cells,
                 SampleSet& set) {
  std::vector<std::vector<std::array<Vec3, kSides>>> ways(cells.size());
  std::vector<float> x, y, z;
  for (size_t c = 0; c < cells.size(); ++c) {
    Vec3 mean{};
    for (const size_t i : cells[c]->samples) {
      ways[c].push_back(hand_ways(takes, set, i));
      mean += ways[c].back()[0];
      mean += ways[c].back()[1];
    }
    mean = mean / static_cast<float>(2 * ways[c].size());
    x.push_back(mean.x);
    y.push_back(mean.y);
    z.push_back(mean.z);
  }
  const Vec3 usual{median(x), median(y), median(z)};
  std::vector<float> away;
  for (const auto& some : ways) {
    float sum = 0;
    for (const auto& way : some) sum += std::max(length(way[0] - usual), length(way[1] - usual));
    away.push_back(sum / static_cast<float>(some.size()));
  }
  const float most = std::max(kElsewhere, kUnusual * median(away));

  struct Elsewhere {
    size_t sample, side;
  };
  std::vector<Elsewhere> elsewhere;
  Arm mean{};
  float actions = 0;
  for (size_t c = 0; c < cells.size(); ++c) {
    Arm sum{};
    float count = 0;
    for (size_t k = 0; k < ways[c].size(); ++k) {
      const size_t i = cells[c]->samples[k];
      for (size_t side = 0; side < kSides; ++side) {
        if (cells[c]->few && length(ways[c][k][side] - usual) > most) {
          elsewhere.push_back({i, side});
          continue;
        }
        const Arm arm = arm_of(change_of(set, i), side);
        for (size_t j = 0; j < sum.size(); ++j) sum[j] += arm[j];
        ++count;
      }
    }
    if (count < kEnough * static_cast<float>(2 * ways[c].size())) continue;
    for (size_t j = 0; j < sum.size(); ++j) mean[j] += sum[j] / count;
    ++actions;
  }
  if (actions == 0) return 0;
  for (Vec3& r : mean) r = r / actions;
  for (const auto& [sample, side] : elsewhere) {
    StyleDelta change = change_of(set, sample);
    put_arm(mean, side, change);
    pack(change, set.target(sample).first<StyleDelta::kSize>());
  }
  return static_cast<int>(elsewhere.size());
}

}  // namespace

int correct_few_takes(const std::vector<Take>& takes, SampleSet& set) {
  const std::vector<Cell> cells = cells_of(takes, set);
  take_off_common_change(cells, set);
  std::map<int, std::vector<const Cell*>> of_style;
  for (const Cell& cell : cells) of_style[cell.style].push_back(&cell);
  int replaced = 0;
  for (const auto& [style, members] : of_style) replaced += replace_arms(takes, members, set);
  return replaced;
}

}  // namespace panache
