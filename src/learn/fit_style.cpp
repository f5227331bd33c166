#include "learn/fit_style.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "learn/disturbance.h"
#include "style/networks/networks.h"

namespace panache {

Ridge::Ridge(int unknowns, int outputs)
    : unknowns_(unknowns),
      outputs_(outputs),
      gram_(unknowns_ * unknowns_),
      target_(unknowns_ * outputs_) {}

void Ridge::add(std::span<const double> rows, std::span<const double> outputs, double weight) {
  assert(rows.size() % unknowns_ == 0 && rows.size() / unknowns_ * outputs_ == outputs.size());
  // A few rows at a time, because the sums do not fit the inner caches.
  constexpr size_t kRows = 8;
  const size_t count = rows.size() / unknowns_;
  for (size_t first = 0; first < count; first += kRows) {
    const size_t last = std::min(first + kRows, count);
    for (size_t i = 0; i < unknowns_; ++i) {
      for (size_t r = first; r < last; ++r) {
        const double* row = &rows[r * unknowns_];
        const double* given = &outputs[r * outputs_];
        const double a = weight * row[i];
        if (a == 0) continue;
        for (size_t j = 0; j <= i; ++j) gram_[i * unknowns_ + j] += a * row[j];
        for (size_t j = 0; j < outputs_; ++j) target_[i * outputs_ + j] += a * given[j];
      }
    }
  }
}

std::vector<double> Ridge::gram() const {
  std::vector<double> whole = gram_;
  for (size_t i = 0; i < unknowns_; ++i) {
    for (size_t j = 0; j < i; ++j) whole[j * unknowns_ + i] = whole[i * unknowns_ + j];
  }
  return whole;
}

// By Cholesky: gram + penalties = L L^T, then L y = target and L^T weights = y.
std::vector<double> Ridge::solve(std::span<const double> penalties,
                                 std::span<const double> prior) const {
  const size_t n = unknowns_;
  std::vector<double> lower = gram_, weights = target_;
  for (size_t i = 0; i < n; ++i) {
    lower[i * n + i] += penalties[i];
    for (size_t k = 0; k < outputs_ && !prior.empty(); ++k) {
      weights[i * outputs_ + k] += penalties[i] * prior[i * outputs_ + k];
    }
  }
  for (size_t i = 0; i < n; ++i) {
    for (size_t j = 0; j <= i; ++j) {
      double sum = lower[i * n + j];
      for (size_t k = 0; k < j; ++k) sum -= lower[i * n + k] * lower[j * n + k];
      if (i == j) assert(sum > 0);
      lower[i * n + j] = i == j ? std::sqrt(sum) : sum / lower[j * n + j];
    }
  }
  for (size_t o = 0; o < outputs_; ++o) {
    for (size_t i = 0; i < n; ++i) {
      double sum = weights[i * outputs_ + o];
      for (size_t k = 0; k < i; ++k) sum -= lower[i * n + k] * weights[k * outputs_ + o];
      weights[i * outputs_ + o] = sum / lower[i * n + i];
    }
    for (size_t i = n; i-- > 0;) {
      double sum = weights[i * outputs_ + o];
      for (size_t k = i + 1; k < n; ++k) sum -= lower[k * n + i] * weights[k * outputs_ + o];
      weights[i * outputs_ + o] = sum / lower[i * n + i];
    }
  }
  return weights;
}

namespace {

constexpr int kCopies = 8;  // Disturbed copies of each window, besides the window itself.
// The target logit of the contact network for a planted or lifted foot: a probability of 0.88. The
// network's own logit is clamped to the same bounds.
constexpr float kSure = 2;
// Directions that the gate distinguishes; all others share the remaining variance.
constexpr size_t kDirections = 32;
constexpr int kSweeps = 12;  // Iterations to find them.
// Windows up to this quantile of the leverage in training are trusted.
constexpr double kTrusted = 0.99;

// The data of the regression: a row of standardised activations and a row of targets per window.
struct Table {
  size_t rows = 0, activations = 0;
  std::vector<double> seen;     // [rows][activations]
  std::vector<double> targets;  // [rows][kLearntOutputs]

  std::span<double> row(size_t r) { return {&seen[r * activations], activations}; }
};

Table make_table(const std::shared_ptr<const Model>& model, const SampleSet& set,
                 std::span<const size_t> samples) {
  StyleNetworks networks(model);  // Without a style: the contacts are those of the networks alone.
  Table table;
  table.activations = model->activation_count();
  Random random(1);
  std::vector<float> window(set.inputs()), activations(table.activations);
  for (const size_t i : samples) {
    const Sample& sample = set.samples()[i];
    for (int copy = 0; copy <= kCopies; ++copy) {
      if (copy == 0) {
        set.window(i, window);
      } else {
        const Disturbed draw = draw_disturbance(kOtherPeople, set.units(), random);
        set.window(i, window, draw.tempo);
        disturb(draw, kOtherPeople, random, window);
      }
      networks.forward(window);
      networks.activations(window, activations);
      for (size_t f = 0; f < activations.size(); ++f) {
        table.seen.push_back((activations[f] - model->activation_mean()[f]) /
                             model->activation_scale()[f]);
      }
      for (int n = 0; n < StyleDelta::kSize; ++n) {
        table.targets.push_back(set.target(i)[n] / model->output_scale()[n]);
      }
      table.targets.push_back(sample.log_rate);
      for (int foot = 0; foot < kFeet; ++foot) {
        const float p = networks.contact()[foot];
        const float unchanged = std::clamp(std::log(p / (1 - p)), -kSure, kSure);
        table.targets.push_back((sample.contacts[foot] > 0.5f ? kSure : -kSure) - unchanged);
      }
      ++table.rows;
    }
  }
  return table;
}

// Subtracts the mean of each column from the rows, and returns it.
std::vector<double> centre(std::vector<double>& rows, size_t columns) {
  std::vector<double> mean(columns);
  const double count = double(rows.size()) / columns;
  for (size_t i = 0; i < rows.size(); ++i) mean[i % columns] += rows[i] / count;
  for (size_t i = 0; i < rows.size(); ++i) rows[i] -= mean[i % columns];
  return mean;
}

double dot(std::span<const double> a, std::span<const double> b) {
  double sum = 0;
  for (size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

// The orthonormal directions of a covariance with the largest variance, and the variance along
// each, by orthogonal iteration: if two variances are close, their directions may be mixed, which
// does not affect leverage.
struct Directions {
  std::vector<double> vectors;  // [directions][size]
  std::vector<double> variances;
  std::span<double> vector(size_t d, size_t size) { return {&vectors[d * size], size}; }
};
Directions main_directions(const std::vector<double>& covariance, size_t size, size_t count) {
  Directions found;
  Random random(2);
  for (size_t i = 0; i < count * size; ++i) found.vectors.push_back(random.normal());
  std::vector<double> turned(count * size);
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (size_t d = 0; d < count; ++d) {
      const std::span<double> vector = found.vector(d, size);
      for (size_t e = 0; e < d; ++e) {
        const std::span<double> other = found.vector(e, size);
        const double shared = dot(vector, other);
        for (size_t i = 0; i < size; ++i) vector[i] -= shared * other[i];
      }
      const double longest = std::sqrt(dot(vector, vector));
      for (double& v : vector) v /= std::max(longest, 1e-30);
    }
    found.variances.clear();
    for (size_t d = 0; d < count; ++d) {
      for (size_t i = 0; i < size; ++i) {
        turned[d * size + i] = dot({&covariance[i * size], size}, found.vector(d, size));
      }
      found.variances.push_back(dot({&turned[d * size], size}, found.vector(d, size)));
    }
    if (sweep + 1 < kSweeps) std::swap(found.vectors, turned);
  }
  return found;
}

Tensor tensor(std::vector<int64_t> shape, const std::vector<double>& values, bool half = false) {
  Tensor out;
  out.shape = std::move(shape);
  out.values.assign(values.begin(), values.end());
  out.half = half;
  return out;
}

// Stores a layer on standardised activations in the file as one on the activations themselves:
// F16 weights, and a bias that makes the output for the activations `mean` exactly `output`.
void put_layer(const std::string& key, const Model& model, const std::vector<double>& weights,
               const std::vector<double>& mean, std::vector<double> output, TensorFile& file) {
  const size_t outputs = output.size();
  std::vector<double> rounded(weights.size());
  for (size_t i = 0; i < weights.size(); ++i) {
    const size_t f = i / outputs;
    const double scale = model.activation_scale()[f];
    rounded[i] = from_half(to_half(static_cast<float>(weights[i] / scale)));
    output[i % outputs] -= rounded[i] * mean[f];
  }
  const auto rows = static_cast<int64_t>(mean.size()), columns = static_cast<int64_t>(outputs);
  file.tensors[key + ".weight"] = tensor({rows, columns}, rounded, true);
  file.tensors[key + ".bias"] = tensor({columns}, output);
}

// The gate: the leverage of a window, z^T (S + penalty)^-1 z with S the covariance of the training
// data, in units of the limit of trust.
void put_gate(const Model& model, Table& table, const std::vector<double>& covariance,
              const std::vector<double>& mean, double penalty, TensorFile& file) {
  const size_t size = table.activations, count = std::min(kDirections, size);
  Directions main = main_directions(covariance, size, count);
  double left = 0;  // Variance outside the main directions.
  for (size_t f = 0; f < size; ++f) left += covariance[f * size + f];
  for (const double variance : main.variances) left -= variance;
  const double others = size > count ? std::max(0.0, left) / (size - count) : 0;
  const double rest = 1 / (others + penalty);
  std::vector<double> gate_weights;
  gate_weights.reserve(main.variances.size());
  for (const double variance : main.variances)
    gate_weights.push_back(1 / (variance + penalty) - rest);

  std::vector<double> leverages;
  for (size_t r = 0; r < table.rows; ++r) {
    const std::span<const double> row = table.row(r);
    double leverage = rest * dot(row, row);
    for (size_t d = 0; d < count; ++d) {
      const double along = dot(row, main.vector(d, size));
      leverage += gate_weights[d] * along * along;
    }
    leverages.push_back(leverage);
  }
  const auto rank = static_cast<size_t>(kTrusted * (table.rows - 1));
  std::nth_element(leverages.begin(), leverages.begin() + rank, leverages.end());
  const double limit = std::max(leverages[rank], 1e-6);  // 0 for a single pose.
  for (double& w : gate_weights) w /= limit;

  std::vector<double> weights(size * count);
  for (size_t d = 0; d < count; ++d) {
    for (size_t f = 0; f < size; ++f) weights[f * count + d] = main.vector(d, size)[f];
  }
  put_layer("gate", model, weights, mean, std::vector<double>(count, 0.0), file);
  file.tensors["gate.worth"] = tensor({static_cast<int64_t>(count)}, gate_weights);
  file.tensors["gate.rest"] = tensor({1}, {rest / limit});
}

}  // namespace

TensorFile fit_style(const std::shared_ptr<const Model>& model, const SampleSet& set,
                     std::span<const size_t> samples, double penalty, double strength) {
  assert(model->can_learn() && !samples.empty());
  Table table = make_table(model, set, samples);
  for (double& target : table.targets) target *= strength;
  const std::vector<double> middle = centre(table.seen, table.activations);
  const std::vector<double> mean_target = centre(table.targets, kLearntOutputs);
  Ridge ridge(static_cast<int>(table.activations), kLearntOutputs);
  ridge.add(table.seen, table.targets, 1 / double(table.rows));
  // The mean posture is not penalised: rows and targets are centred.
  const std::vector<double> weights = ridge.solve(std::vector<double>(table.activations, penalty));
  std::vector<double> mean;
  for (size_t f = 0; f < table.activations; ++f) {
    const double scale = model->activation_scale()[f];
    // In the file's precision.
    mean.push_back(static_cast<float>(model->activation_mean()[f] + middle[f] * scale));
  }
  TensorFile file;
  put_layer("head", *model, weights, mean, mean_target, file);
  file.tensors["mean"] = tensor({static_cast<int64_t>(mean.size())}, mean);
  put_gate(*model, table, ridge.gram(), mean, penalty, file);
  return file;
}

TensorFile fit_posture(const Model& model, const StyleDelta& change) {
  assert(model.can_learn());
  const size_t size = model.activation_count(), directions = std::min(kDirections, size);
  std::vector<double> output(kLearntOutputs), mean;
  std::array<float, StyleDelta::kSize> numbers;
  pack(change, numbers);
  for (size_t n = 0; n < numbers.size(); ++n) output[n] = numbers[n] / model.output_scale()[n];
  for (size_t f = 0; f < size; ++f) mean.push_back(model.activation_mean()[f]);
  TensorFile file;
  put_layer("head", model, std::vector<double>(size * kLearntOutputs), mean, output, file);
  file.tensors["mean"] = tensor({static_cast<int64_t>(size)}, mean);
  put_layer("gate", model, std::vector<double>(size * directions), mean,
            std::vector<double>(directions), file);
  file.tensors["gate.worth"] =
      tensor({static_cast<int64_t>(directions)}, std::vector<double>(directions));
  file.tensors["gate.rest"] = tensor({1}, {0});  // All motion counts as known.
  return file;
}

Result<void> add_activation_statistics(const std::vector<Take>& takes, TensorFile& file) {
  // The noise of a feature that hardly moves must not count.
  constexpr double kStill = 0.01;
  constexpr int kEvery = 5;  // Frames.
  Result<std::shared_ptr<const Model>> model = Model::create(file, "the model");
  if (!model) return model.error();
  if (const Recipe& recipe = (*model)->recipe(); !recipe.learns_styles) {
    return Error{"the model is of recipe " + std::string(recipe.name) +
                 ", on which no style can be learnt"};
  }
  const StyleNetworks networks(*model);
  const size_t size = (*model)->activation_count();
  const int numbers = pose_feature_count((*model)->layout());
  std::vector<float> window(size_t(kWindowPoses) * numbers), activations(size);
  std::vector<double> sum(size), squares(size);
  double count = 0;
  for (const Take& take : takes) {
    if (!take.row.neutral || take.row.test) continue;
    for (int f = 0; f < take.frames(); f += kEvery) {
      take_window(take, static_cast<float>(f), numbers, window);
      networks.activations(window, activations);
      for (size_t i = 0; i < size; ++i) {
        sum[i] += activations[i];
        squares[i] += double(activations[i]) * activations[i];
      }
      ++count;
    }
  }
  std::vector<double> mean, scale;
  for (size_t i = 0; i < size; ++i) {
    mean.push_back(count > 0 ? sum[i] / count : 0);
    const double variance = count > 0 ? squares[i] / count - mean[i] * mean[i] : 1;
    scale.push_back(std::sqrt(std::max(0.0, variance)) + kStill);
  }
  file.tensors["learn.mean"] = tensor({static_cast<int64_t>(size)}, mean, true);
  file.tensors["learn.scale"] = tensor({static_cast<int64_t>(size)}, scale, true);
  return {};
}

}  // namespace panache
