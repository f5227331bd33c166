// Reads the networks of a model: its tensors, and the numbers in its metadata.

#include <algorithm>
#include <cmath>
#include <limits>

#include "style/model/model.h"
#include "style/model/predictor_network.h"

namespace panache {
Result<void> Model::read_networks(const TensorFile& file, const std::string& name) {
  const bool per_style = recipe_->style_heads;
  const size_t learnt = count_learnt(file);
  if (learnt > (recipe_->learns_styles ? styles_.size() : 0)) {
    return Error{name + ": has " + std::to_string(learnt) + " learnt styles and lists " +
                 std::to_string(styles_.size()) + " in all; expected a model written by panache"};
  }
  const int styles = static_cast<int>(styles_.size() - learnt);
  const int inputs = kWindowPoses * pose_feature_count(layout()) + recipe_->style_inputs(styles);
  const struct {
    const char* prefix;
    int outputs, heads;
  } networks[kNetworks] = {{"pose", recipe_->outputs, per_style ? styles : 1},
                           {"timing", 1, per_style ? styles : 1},
                           {"contact", 2, per_style ? styles + 1 : 1}};
  std::array<Trunk, kNetworks> trunks;
  std::array<int, kNetworks> hidden;
  for (size_t n = 0; n < kNetworks; ++n) {
    const std::string prefix = networks[n].prefix;
    // Styles are learnt on the pose network's trunk; trunks without heads may be missing.
    const bool needed = networks[n].heads > 0 || n == kPose;
    Result<Trunk> trunk =
        needed ? Trunk::read(file, prefix + ".trunk", inputs, name) : Trunk::none(inputs);
    if (!trunk) return trunk.error();
    if (static_cast<size_t>(trunk->widest()) > kMaxUnits) {
      return Error{name + ": the layers of '" + prefix + ".trunk' have up to " +
                   std::to_string(trunk->widest()) + " units; expected at most " +
                   std::to_string(kMaxUnits)};
    }
    hidden[n] = trunk->outputs();
    trunks[n] = *std::move(trunk);
  }
  trunks_ = TrunkTrio(std::move(trunks));
  Result<std::vector<int>> reduced = read_reductions(file, per_style ? styles : 0, name);
  if (!reduced) return reduced.error();
  for (size_t n = 0; n < kNetworks; ++n) {
    std::vector<DenseLayer> heads;
    for (int h = 0; h < networks[n].heads; ++h) {
      const bool reads_all = n == kPose && !reduced->empty();
      Result<DenseLayer> head = read_layer(
          file, networks[n].prefix + std::string(".head.") + std::to_string(h),
          reads_all ? (*reduced)[static_cast<size_t>(h)] : hidden[n], networks[n].outputs, name);
      if (!head) return head.error();
      heads.push_back(*std::move(head));
    }
    heads_[n].count = heads.size();
    heads_[n].outputs = static_cast<size_t>(networks[n].outputs);
    if (heads.empty()) {
      // All styles are learnt ones.
    } else if (heads_[n].outputs < kPadding) {
      heads_[n].layers.emplace_back(side_by_side(heads));
    } else {
      for (const DenseLayer& head : heads) heads_[n].layers.emplace_back(head);
    }
  }
  if (static_cast<size_t>(inputs) > kMaxInputs) {
    return Error{name + ": has " + std::to_string(styles) + " styles; expected at most " +
                 std::to_string(kMaxInputs - 800) + " with this recipe"};
  }
  if (auto read = read_activations(file, name); !read) return read.error();
  return read_learnt(file, learnt, name);
}

// The number of units that each pose head reads, or none if heads read the last layer.
Result<std::vector<int>> Model::read_reductions(const TensorFile& file, int styles,
                                                const std::string& name) {
  std::vector<int> units;
  if (!file.tensors.contains("pose.reduce.0.weight")) return units;
  for (int s = 0; s < styles; ++s) {
    const std::string key = "pose.reduce." + std::to_string(s);
    Result<DenseLayer> layer =
        read_layer(file, key, static_cast<int>(activation_count()), -1, name);
    if (!layer) return layer.error();
    if (layer->outputs > kMaxReduced) {
      return Error{name + ": layer '" + key + "' has " + std::to_string(layer->outputs) +
                   " units; expected at most " + std::to_string(kMaxReduced)};
    }
    units.push_back(layer->outputs);
    reductions_.emplace_back(*layer);
  }
  return units;
}

Result<void> Model::read_recognition(const TensorFile& file, const std::string& name) {
  if (!file.tensors.contains("recognition.mean")) return {};
  const int statistics = static_cast<int>(recognition_count());
  Recognition recognition;
  Result<std::vector<float>> mean = read_vector(file, "recognition.mean", statistics, name);
  if (!mean) return mean.error();
  Result<std::vector<float>> factor = read_vector(file, "recognition.factor", statistics, name);
  if (!factor) return factor.error();
  Result<DenseLayer> layer =
      read_layer(file, "recognition", statistics, static_cast<int>(styles_.size()) + 1, name);
  if (!layer) return layer.error();
  recognition_ = {*std::move(mean), *std::move(factor), PackedLayer(*layer)};
  return {};
}

Result<void> Model::measure_scratch(const std::string& name) {
  size_t outputs = padded(kLearntOutputs);
  for (const Heads& heads : heads_) {
    for (const PackedLayer& layer : heads.layers) outputs = std::max(outputs, layer.width());
  }
  const bool reads_all = can_learn() || !reductions_.empty() || persons_;
  const size_t activations = padded(reads_all ? activation_count() : trunks_.outputs(kPose));
  size_t reduced = 0;
  for (const PackedLayer& layer : reductions_) reduced = std::max(reduced, layer.width());
  size_t heads = 3 * activations + reduced + outputs;
  if (persons_) {
    const size_t products = padded(persons_->head().inputs()),
                 width = persons_->reduction().width();
    heads = std::max(heads, width + std::max(activations, products + persons_->head().width()));
  }
  scratch_size_ = padded(static_cast<size_t>(trunks_.inputs())) + trunks_.scratch_size() + heads;
  if (scratch_size_ <= kMaxScratch) return {};
  return Error{name + ": a step works in " + std::to_string(scratch_size_) +
               " numbers; expected trunks of fewer layers, so that it takes at most " +
               std::to_string(kMaxScratch)};
}

Result<void> Model::read_numbers(const TensorFile& file, const std::string& name) {
  const int numbers = pose_feature_count(layout()), outputs = recipe_->outputs;
  std::vector<float> input_mean, input_scale;
  const struct {
    const char* key;
    int size;
    std::vector<float>* to;
  } vectors[] = {{"input.mean", numbers, &input_mean},
                 {"input.scale", numbers, &input_scale},
                 {"output.scale", outputs, &output_scale_}};
  for (const auto& [key, size, to] : vectors) {
    Result<std::vector<float>> read = read_vector(file, key, size, name);
    if (!read) return read.error();
    *to = *std::move(read);
  }
  output_mean_.assign(outputs, 0.0f);
  if (!recipe_->output_scale) {
    Result<std::vector<float>> mean = read_vector(file, "output.mean", outputs, name);
    if (!mean) return mean.error();
    output_mean_ = *std::move(mean);
  }
  Result<std::vector<float>> clip = read_vector(file, "input.clip", 1, name);
  if (!clip) return clip.error();
  input_clip_ = clip->front() > 0 ? clip->front() : std::numeric_limits<float>::infinity();
  for (const float scale : input_scale) {
    if (!(scale > 0) || std::isinf(1 / scale)) {
      return Error{name + ": tensor 'input.scale' must be above zero throughout"};
    }
  }
  for (int k = 0; k < kWindowPoses; ++k) {
    input_mean_.insert(input_mean_.end(), input_mean.begin(), input_mean.end());
    for (const float scale : input_scale) input_factor_.push_back(1 / scale);
  }
  if (auto read = read_networks(file, name); !read) return read.error();
  if (PredictorNetwork::is_in(file)) {
    Result<PredictorNetwork> predictor = PredictorNetwork::read(file, name);
    if (!predictor) return predictor.error();
    predictor_ = std::make_shared<const PredictorNetwork>(*std::move(predictor));
  }
  if (auto read = read_recognition(file, name); !read) return read.error();
  if (auto read = read_gate(file, name); !read) return read.error();
  if (PersonSpace::is_in(file)) {
    if (!recipe_->style_heads) {
      return Error{name + ": has tensors 'person.*'; a model of recipe " + recipe_->name +
                   " cannot have persons"};
    }
    Result<PersonSpace> persons =
        PersonSpace::read(file, static_cast<int>(activation_count()), output_scale_, name);
    if (!persons) return persons.error();
    persons_ = *std::move(persons);
  }
  if (auto read = read_gestures(file, name); !read) return read.error();
  measure_stances();
  return measure_scratch(name);
}

void Model::measure_stances() {
  if (!recipe_->style_heads || (built_in() > 0 && !gate_.present())) return;
  const auto mean_answer = [&](const PackedLayer& head, std::span<const float> activations) {
    AlignedVector<float> output(head.width());
    head.forward({activations.data(), 1, 0}, {output.data(), 1, 0});
    std::array<float, StyleDelta::kSize> change;
    for (size_t i = 0; i < change.size(); ++i) change[i] = output[i] * output_scale_[i];
    stances_.push_back(stance_of(unpack(change)));
  };
  // Reductions are zero on average.
  const std::vector<float> zeros(kMaxReduced);
  for (const PackedLayer& head : heads_[kPose].layers) {
    mean_answer(head, reductions_.empty() ? gate_.mean : zeros);
  }
  for (const Learnt& learnt : learnt_) mean_answer(learnt.head, learnt.mean);
}

Result<void> Model::read_gate(const TensorFile& file, const std::string& name) {
  const int hidden = trunks_.outputs(kPose);
  gate_.mean.assign(hidden, 0.0f);
  const bool gated = std::any_of(file.tensors.begin(), file.tensors.end(), [](const auto& tensor) {
    return tensor.first.starts_with("gate.");
  });
  if (gated) {
    Result<std::vector<float>> mean = read_vector(file, "gate.mean", hidden, name);
    if (!mean) return mean.error();
    gate_.mean = *std::move(mean);
    Result<DenseLayer> whitening = read_layer(file, "gate.whitening", hidden, hidden, name);
    if (!whitening) return whitening.error();
    gate_.whitening = PackedLayer(*whitening);
    Result<std::vector<float>> limit = read_vector(file, "gate.limit", 1, name);
    if (!limit) return limit.error();
    gate_.limit = limit->front();
    if (gate_.limit <= 0) return Error{name + ": tensor 'gate.limit' must be above zero"};
  }
  return {};
}

}  // namespace panache
