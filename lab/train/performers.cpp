#include "train/training_data.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "base/quat.h"
#include "learn/pairing.h"

namespace panache {
namespace {

constexpr size_t kFewestPerformers = 3;  // With neutral takes, to measure how persons differ.
// A median of few styles has a larger error than their mean, and styles of one performer are
// correlated: the share of their variance that remains for any number of styles.
constexpr float kMedian = 1.5f, kAlike = 0.25f;

using Numbers = std::array<float, StyleDelta::kSize>;

struct Mean {
  Numbers sum{};
  float count = 0;

  void add(std::span<const float> change) {
    for (size_t n = 0; n < change.size(); ++n) sum[n] += change[n];
    ++count;
  }
  Numbers mean() const {
    Numbers numbers = sum;
    for (float& number : numbers) number /= count;
    return numbers;
  }
};

using Action = std::pair<int, std::string>;          // Set, content.
using Shared = std::pair<std::string, std::string>;  // Manifest, content.

// Mean squares.
struct Squares {
  Numbers sum{};
  size_t count = 0;

  void add(const Numbers& numbers) {
    for (size_t n = 0; n < numbers.size(); ++n) sum[n] += numbers[n] * numbers[n];
    ++count;
  }
  float mean(size_t n) const { return sum[n] / static_cast<float>(count); }
};

// How each performer with neutral takes of this content differs from the others of the manifest.
Squares differences_of_persons(const std::vector<Take>& takes, const Shared& action) {
  std::map<int, std::vector<const Take*>> performers;
  for (const Take& take : takes) {
    const ManifestRow& row = take.row;
    if (row.neutral && Shared{row.manifest, row.content} == action) {
      performers[row.set].push_back(&take);
    }
  }
  Squares squares;
  if (performers.size() < kFewestPerformers) return squares;
  for (const auto& [one, own] : performers) {
    std::vector<Take> compared;
    std::vector<int> styled, neutral;
    for (const auto& [other, members] : performers) {
      for (const Take* take : members) {
        (other == one ? styled : neutral).push_back(static_cast<int>(compared.size()));
        compared.push_back(*take);
        compared.back().row.set = 0;
      }
    }
    Mean mean;
    for (const Pairing& pairing : pair_takes(compared, styled, neutral)) {
      const int frames = static_cast<int>(pairing.rates.size());
      for (int i = kTrimFrames; i < frames - kTrimFrames; ++i) {
        const float rate = believable_rate(pairing.rates[i]);
        Numbers change;
        pack(change_between(compared[pairing.styled], pairing.first + i, compared[pairing.neutral],
                            pairing.neutral_frames[i], rate),
             change);
        mean.add(change);
      }
    }
    if (mean.count > 0) squares.add(mean.mean());
  }
  return squares;
}

// The median change over the styles of a performer, shrunk where styles vary more than persons.
Numbers shared_change(const std::map<int, Mean>& styles, const Squares& persons,
                      const Squares& own_styles) {
  const float doubt = kAlike + kMedian / static_cast<float>(styles.size());
  Numbers shared{};
  for (size_t n = 0; n < shared.size(); ++n) {
    std::vector<float> values;
    for (const auto& [style, mean] : styles) values.push_back(mean.mean()[n]);
    std::sort(values.begin(), values.end());
    const size_t half = values.size() / 2;
    const float median = (values[half] + values[(values.size() - 1) / 2]) / 2;
    const float person = persons.mean(n), spread = doubt * own_styles.mean(n);
    if (!(person > 0)) continue;
    const float max = std::sqrt(person);
    shared[n] = std::clamp(median * person / (person + spread), -max, max);
  }
  return shared;
}

}  // namespace

void take_off_performers(const std::vector<Take>& takes, SampleSet& set) {
  std::map<Action, std::map<int, Mean>> foreign;              // By style.
  std::map<Shared, std::map<std::pair<int, int>, Mean>> own;  // By set and style.
  std::map<Action, Shared> compared;
  const auto is_foreign = [&](const Sample& sample) {
    return takes[sample.take].row.set != takes[sample.styled].row.set;
  };
  for (size_t i = 0; i < set.samples().size(); ++i) {
    const Sample& sample = set.samples()[i];
    if (sample.styled < 0) continue;
    const ManifestRow& row = takes[sample.styled].row;
    const auto change = set.target(i).first<StyleDelta::kSize>();
    const Action action{row.set, row.content};
    compared[action] = {row.manifest, row.content};
    Mean& mean = is_foreign(sample) ? foreign[action][sample.style]
                                    : own[compared[action]][{row.set, sample.style}];
    mean.add(change);
  }
  std::map<Action, Numbers> taken_off;
  for (const auto& [action, styles] : foreign) {
    Squares own_styles;
    for (const auto& [style, mean] : own[compared[action]]) {
      own_styles.add(mean.mean());
    }
    const Squares persons = differences_of_persons(takes, compared[action]);
    if (persons.count == 0 || own_styles.count == 0) continue;
    taken_off[action] = shared_change(styles, persons, own_styles);
  }
  for (size_t i = 0; i < set.samples().size(); ++i) {
    Sample& sample = set.sample(i);
    if (sample.styled < 0 || !is_foreign(sample)) continue;
    const ManifestRow& row = takes[sample.styled].row;
    const auto shared = taken_off.find({row.set, row.content});
    if (shared == taken_off.end()) continue;
    const auto target = set.target(i).first<StyleDelta::kSize>();
    StyleDelta change = unpack(target);
    const StyleDelta persons = unpack(shared->second);
    for (int j = 0; j < kHumanJoints; ++j) {
      change.rotations[j] = log_rotation(exp_rotation(change.rotations[j]) *
                                         conjugate(exp_rotation(persons.rotations[j])));
    }
    change.hips_height -= persons.hips_height;
    change.velocity_left -= persons.velocity_left;
    change.velocity_forward -= persons.velocity_forward;
    change.turn_rate -= persons.turn_rate;
    pack(change, target);
  }
}

}  // namespace panache
