#include "train/fingerprint.h"

#include <span>
#include <string_view>
#include <type_traits>

namespace panache {
namespace {

// FNV-1a over the bytes of numbers, lists of numbers, and text.
class Hash {
 public:
  template <class... T>
  void add(const T&... values) {
    static_assert(
        ((std::has_unique_object_representations_v<T> || std::is_floating_point_v<T>)&&...),
        "bytes between the fields of a struct are anything");
    (add_bytes({reinterpret_cast<const char*>(&values), sizeof values}), ...);
  }
  void add_list(std::span<const float> values) {
    add(values.size());
    add_bytes({reinterpret_cast<const char*>(values.data()), values.size_bytes()});
  }
  void add_text(std::string_view text) {
    add(text.size());
    add_bytes(text);
  }
  uint64_t value() const { return value_; }

 private:
  void add_bytes(std::string_view bytes) {
    for (const char c : bytes) value_ = (value_ ^ static_cast<uint8_t>(c)) * 1099511628211u;
  }
  uint64_t value_ = 14695981039346656037u;
};

uint64_t hash_data(const TrainingData& data, const SampleSet& set, const std::vector<int>& choice) {
  Hash hash;
  for (const Take& take : data.takes) {
    hash.add_text(take.row.content);
    hash.add_list(take.pose_features);
  }
  for (const Take& take : data.unlabelled) hash.add_list(take.pose_features);
  for (size_t i = 0; i < set.samples().size(); ++i) {
    const Sample& sample = set.samples()[i];
    hash.add(sample.take, sample.frame, sample.style, sample.log_rate);
    hash.add_list(sample.contacts);
    hash.add_list(set.target(i));
  }
  for (const int sample : choice) hash.add(sample);
  return hash.value();
}

uint64_t hash_styles(const std::vector<StyleName>& styles) {
  Hash hash;
  for (const StyleName& style : styles) hash.add_text(style.name);
  return hash.value();
}

void hash_disturbance(const Disturbance& disturbance, Hash& hash) {
  hash.add_list(
      std::to_array({disturbance.scale, disturbance.floor, disturbance.heading, disturbance.posture,
                     disturbance.jitter, disturbance.velocity, disturbance.turn_rate,
                     disturbance.tempo, disturbance.torso, disturbance.head, disturbance.arms,
                     disturbance.legs, disturbance.amplitude}));
}

uint64_t hash_settings(const TrainOptions& options) {
  const TrainingSettings& settings = options.settings;
  Hash hash;
  hash.add(options.seed);
  hash.add_text(options.recipe->name);
  hash.add(settings.steps, settings.neutral_samples, settings.squared_tempo,
           settings.predictor_steps, settings.smoothness, settings.positions);
  const BatchSettings& batch = settings.batch;
  hash.add(batch.size, batch.by_style, batch.mirrored, batch.disturbed, batch.input_clip);
  hash_disturbance(batch.disturbance, hash);
  const GuidanceSettings& guidance = settings.guidance;
  hash.add(guidance.sequences, guidance.every, guidance.weight, guidance.guides,
           guidance.guide_steps);
  hash.add_list(
      std::to_array({guidance.style, guidance.statistics, guidance.velocity, guidance.smoothness,
                     guidance.balance, guidance.prior, guidance.signature, guidance.anatomy,
                     guidance.standing, guidance.tempo, guidance.ramp, guidance.spliced}));
  hash_disturbance(guidance.disturbance, hash);
  const OptimizerSettings& optimizer = settings.optimizer;
  hash.add(optimizer.learning_rate, optimizer.epsilon, optimizer.one_cycle, optimizer.weight_decay,
           optimizer.dropout);
  return hash.value();
}

}  // namespace

Fingerprint fingerprint(const TrainingData& data, const SampleSet& set,
                        const std::vector<int>& choice, const std::vector<StyleName>& styles,
                        const TrainOptions& options) {
  return {hash_data(data, set, choice), hash_styles(styles), hash_settings(options)};
}

}  // namespace panache
