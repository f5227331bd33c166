#include "train/neutral_tempos.h"

#include <cmath>
#include <map>
#include <string>
#include <tuple>

#include "train/removal.h"

namespace panache {
namespace {

constexpr size_t kReferences = 12;  // Takes that each take is compared with, at most.

using Group = std::vector<int>;  // Takes.

// Mean logarithm of neutral seconds per second of `take`; 0 if the two do not match.
double log_rate(const std::vector<Take>& takes, int take, int neutral) {
  double sum = 0;
  int count = 0;
  for (const Pairing& pairing : pair_takes(takes, {take}, {neutral})) {
    for (const float rate : pairing.rates) sum += std::log(believable_rate(rate)), ++count;
  }
  return count > 0 ? sum / count : 0;
}

// How much faster each take is than the mean of its group, as a logarithm.
std::map<int, float> tempos_of(const std::vector<Take>& takes, const Group& group) {
  const size_t stride = (group.size() + kReferences - 1) / kReferences;
  std::map<int, float> faster;
  float sum = 0;
  for (const int take : group) {
    double own = 0;
    size_t count = 0;
    for (size_t r = 0; r < group.size(); r += stride, ++count) {
      const int other = group[r];
      if (other != take) own += (log_rate(takes, take, other) - log_rate(takes, other, take)) / 2;
    }
    faster[take] = static_cast<float>(own / static_cast<double>(count));
    sum += faster[take];
  }
  for (auto& [take, tempo] : faster) tempo -= sum / static_cast<float>(group.size());
  return faster;
}

class NeutralTempos {
 public:
  NeutralTempos(const std::vector<Take>& takes, const std::vector<Pairing>& pairings)
      : takes_(takes) {
    for (const Pairing& pairing : pairings) {
      const Key wanted = key(pairing.styled, pairing.neutral);
      if (!faster_.contains(wanted)) faster_[wanted] = tempos_of(takes, group_of(wanted));
    }
  }
  // 0 for takes without a pairing.
  float faster(int styled, int neutral) const {
    const auto group = faster_.find(key(styled, neutral));
    if (group == faster_.end()) return 0;
    const auto tempo = group->second.find(neutral);
    return tempo == group->second.end() ? 0 : tempo->second;
  }

 private:
  // Manifest, content, set; -1 means all other performers.
  using Key = std::tuple<std::string, std::string, int>;
  Key key(int styled, int neutral) const {
    const ManifestRow &row = takes_[styled].row, &other = takes_[neutral].row;
    return {row.manifest, row.content, row.set == other.set ? row.set : -1};
  }
  Group group_of(const Key& key) const {
    const auto& [manifest, content, set] = key;
    Group group;
    for (size_t t = 0; t < takes_.size(); ++t) {
      const ManifestRow& row = takes_[t].row;
      if (row.neutral && row.manifest == manifest && row.content == content &&
          (set < 0 || row.set == set)) {
        group.push_back(static_cast<int>(t));
      }
    }
    return group;
  }

  const std::vector<Take>& takes_;
  std::map<Key, std::map<int, float>> faster_;
};

}  // namespace

void level_neutral_tempos(const std::vector<Take>& takes, std::vector<Pairing>& pairings,
                          SampleSet& set) {
  const NeutralTempos tempos(takes, pairings);
  for (size_t i = 0; i < set.samples().size(); ++i) {
    Sample& sample = set.sample(i);
    if (sample.styled < 0) continue;
    // A remover goes from the styled take to the neutral one.
    const bool removes = take_with_style(takes, sample) == sample.take;
    sample.log_rate += removes ? -tempos.faster(sample.take, sample.styled)
                               : tempos.faster(sample.styled, sample.take);
  }
  for (Pairing& pairing : pairings) {
    const float factor = std::exp(tempos.faster(pairing.styled, pairing.neutral));
    for (float& rate : pairing.rates) rate *= factor;
  }
}

}  // namespace panache
