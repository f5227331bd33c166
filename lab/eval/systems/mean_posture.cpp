#include "eval/systems/mean_posture.h"

#include <algorithm>
#include <cmath>

#include "learn/samples.h"
#include "recipes/recipe.h"
#include "style/stages/strengths.h"
#include "takes/manifest.h"

namespace panache {
namespace {

class Constant final : public ChangeSource {
 public:
  Constant(const AskedChange& asked, const Shape& shape) : asked_(asked), shape_(shape) {
    asked_.shape = &shape_;
  }
  AskedChange ask(const SourceInput&) override { return asked_; }

 private:
  AskedChange asked_;
  Shape shape_;
};

std::vector<std::string> names_of(const std::vector<StyleName>& styles) {
  std::vector<std::string> names;
  for (const StyleName& style : styles) names.push_back(style.name);
  return names;
}

}  // namespace

MeanPosture::MeanPosture(std::string name, const SystemData& data)
    : ChangeSystem(std::move(name), names_of(data.styles)), means_(data.styles.size()) {
  const SampleSet set(data.takes, data.pairings, styles(), default_recipe(), false);
  struct Sum {
    std::array<double, StyleDelta::kSize> change{};
    double log_rate = 0, count = 0;
  };
  std::vector<Sum> sums(means_.size());
  for (size_t i = 0; i < set.samples().size(); ++i) {
    Sum& sum = sums[set.samples()[i].style];
    const std::span<const float> target = set.target(i);
    for (int n = 0; n < StyleDelta::kSize; ++n) sum.change[n] += target[n];
    sum.log_rate += set.samples()[i].log_rate;
    ++sum.count;
  }
  for (size_t s = 0; s < sums.size(); ++s) {
    const double count = std::max(1.0, sums[s].count);
    std::array<float, StyleDelta::kSize> change;
    for (int n = 0; n < StyleDelta::kSize; ++n) {
      change[n] = static_cast<float>(sums[s].change[n] / count);
    }
    means_[s] = {unpack(change), static_cast<float>(sums[s].log_rate / count)};
  }
}

SystemFacts MeanPosture::facts() const {
  SystemFacts facts;
  facts.parameters = means_.size() * (StyleDelta::kSize + 1);
  return facts;
}

// Strengths have the same effect as for a model's styles.
std::unique_ptr<ChangeSource> MeanPosture::make_source(const Take&, double,
                                                       const Strengths& strengths) const {
  AskedChange asked;
  float all_posture = 0, all_movement = 0;
  std::array<float, StyleDelta::kSize> sum{};
  for (const auto& [style, strength] : strengths) {
    const Mean& mean = means_[style];
    const float posture = posture_strength(strength);
    std::array<float, StyleDelta::kSize> change;
    pack(mean.change, change);
    for (size_t n = 0; n < sum.size(); ++n) sum[n] += posture * change[n];
    asked.log_rate += movement_strength(strength) * mean.log_rate;
    all_posture += std::abs(posture);
    all_movement += std::abs(movement_strength(strength));
    const Stance stance = stance_of(mean.change);
    asked.stance.heel += posture * stance.heel;
    for (size_t f = 0; f < kFeet; ++f) asked.stance.turn[f] += posture * stance.turn[f];
  }
  asked.delta = unpack(sum);
  Shape shape;  // As EasedStrengths::shape().
  if (all_movement < all_posture) shape.dynamics = all_movement / all_posture;
  return std::make_unique<Constant>(asked, shape);
}

Result<std::unique_ptr<System>> make_mean_posture(const std::string& name, const SystemData& data) {
  return std::unique_ptr<System>(std::make_unique<MeanPosture>(name, data));
}

}  // namespace panache
