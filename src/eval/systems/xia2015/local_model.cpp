#include "eval/systems/xia2015/local_model.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace panache::xia2015 {
namespace {

using Eigen::Index;
using Eigen::MatrixXf;
using Eigen::RowVectorXf;
using Eigen::VectorXf;

constexpr int kClusterRounds = 5;

// The neighbours as matrices, one a row.
struct Examples {
  VectorXf weights;  // Sum 1.
  MatrixXf keys, recent, outputs;
};

Examples gather(const Database& database, const std::vector<Database::Neighbour>& neighbours) {
  const Index count = static_cast<Index>(neighbours.size());
  Examples out{VectorXf(count), MatrixXf(count, kKeySize), MatrixXf(count, kOutputs),
               MatrixXf(count, kOutputs)};
  // A Gaussian of the distance, half as wide as the farthest neighbour is away.
  const float width = std::max(neighbours.back().distance / 4, 1e-6f);
  for (Index k = 0; k < count; ++k) {
    const Database::Example& example = *neighbours[static_cast<size_t>(k)].example;
    out.weights[k] = std::exp(-neighbours[static_cast<size_t>(k)].distance / (2 * width));
    out.keys.row(k) = Eigen::Map<const RowVectorXf>(example.key.data(), kKeySize);
    const Output& before = database.before(example).output;
    out.recent.row(k) = Eigen::Map<const RowVectorXf>(before.data(), kOutputs);
    out.outputs.row(k) = Eigen::Map<const RowVectorXf>(example.output.data(), kOutputs);
  }
  out.weights /= out.weights.sum();
  return out;
}

// Which of `components` each neighbour belongs to: by k-means of the outputs, that begins with the
// nearest neighbour and those farthest from the ones before.
std::vector<int> cluster(const Examples& examples, int components) {
  const Index count = examples.outputs.rows();
  std::vector<int> member(static_cast<size_t>(count), 0);
  if (components < 2 || count < 2 * components) return member;
  MatrixXf centres(components, kOutputs);
  centres.row(0) = examples.outputs.row(0);
  VectorXf away = (examples.outputs.rowwise() - centres.row(0)).rowwise().squaredNorm();
  for (int c = 1; c < components; ++c) {
    Index far = 0;
    away.maxCoeff(&far);
    centres.row(c) = examples.outputs.row(far);
    away = away.cwiseMin((examples.outputs.rowwise() - centres.row(c)).rowwise().squaredNorm());
  }
  for (int round = 0; round < kClusterRounds; ++round) {
    for (Index k = 0; k < count; ++k) {
      Index best = 0;
      (centres.rowwise() - examples.outputs.row(k)).rowwise().squaredNorm().minCoeff(&best);
      member[static_cast<size_t>(k)] = static_cast<int>(best);
    }
    for (int c = 0; c < components; ++c) {
      RowVectorXf sum = RowVectorXf::Zero(kOutputs);
      float weight = 0;
      for (Index k = 0; k < count; ++k) {
        if (member[static_cast<size_t>(k)] != c) continue;
        sum += examples.weights[k] * examples.outputs.row(k);
        weight += examples.weights[k];
      }
      if (weight > 0) centres.row(c) = sum / weight;
    }
  }
  return member;
}

// One autoregressive model: the output is linear in key and recent output. Least squares with a
// penalty, in its dual form, as there are fewer neighbours than numbers; with R the roots of the
// weights on a diagonal, y = mean(y) + dY^T R (R dU dU^T R + penalty)^-1 R dU du.
RowVectorXf regress(const Examples& examples, const VectorXf& weights, const RowVectorXf& key,
                    const RowVectorXf* recent, const LocalSettings& settings) {
  const RowVectorXf key_mean = weights.transpose() * examples.keys;
  const RowVectorXf output_mean = weights.transpose() * examples.outputs;
  const Index width = kKeySize + (recent ? kOutputs : 0);
  MatrixXf inputs(examples.keys.rows(), width);
  RowVectorXf input(width);
  const auto put = [&](Index at, const MatrixXf& rows, const RowVectorXf& mean,
                       const RowVectorXf& query, float share) {
    auto block = inputs.middleCols(at, rows.cols());
    block = rows.rowwise() - mean;
    const float square = weights.dot(block.rowwise().squaredNorm());
    const float factor = std::sqrt(share / std::max(square, 1e-9f));
    block *= factor;
    input.segment(at, rows.cols()) = (query - mean) * factor;
  };
  put(0, examples.keys, key_mean, key, recent ? 1 - settings.recent : 1.0f);
  if (recent) {
    const RowVectorXf recent_mean = weights.transpose() * examples.recent;
    put(kKeySize, examples.recent, recent_mean, *recent, settings.recent);
  }
  // Beyond its neighbours a linear map knows nothing.
  const float reach =
      std::sqrt((weights.array() > 0).select(inputs.rowwise().squaredNorm(), 0.0f).maxCoeff());
  if (const float far = input.norm(); far > reach && far > 0) input *= reach / far;
  const VectorXf roots = weights.cwiseSqrt();
  inputs = roots.asDiagonal() * inputs;
  MatrixXf gram = inputs * inputs.transpose();
  gram.diagonal().array() += settings.penalty;
  const VectorXf shares = roots.cwiseProduct(gram.llt().solve(inputs * input.transpose()));
  return output_mean + shares.transpose() * (examples.outputs.rowwise() - output_mean);
}

// How much of the say each component has: by the weight of its members, and by how well the recent
// output goes with theirs.
VectorXf say_of(const Examples& examples, const std::vector<VectorXf>& weights,
                const RowVectorXf* recent) {
  const Index components = static_cast<Index>(weights.size());
  VectorXf log_say(components);
  float spread = 0;
  for (Index c = 0; c < components; ++c) {
    const VectorXf& own = weights[static_cast<size_t>(c)];
    const float total = own.sum();
    log_say[c] = std::log(total);
    if (!recent) continue;
    const RowVectorXf mean = own.transpose() * examples.recent / total;
    spread += own.dot((examples.recent.rowwise() - mean).rowwise().squaredNorm());
  }
  for (Index c = 0; c < components && recent; ++c) {
    const VectorXf& own = weights[static_cast<size_t>(c)];
    const RowVectorXf mean = own.transpose() * examples.recent / own.sum();
    log_say[c] -= (*recent - mean).squaredNorm() / (2 * std::max(spread, 1e-6f));
  }
  const VectorXf say = (log_say.array() - log_say.maxCoeff()).exp();
  return say / say.sum();
}

}  // namespace

LocalAnswer answer_locally(const Database& database,
                           const std::vector<Database::Neighbour>& neighbours,
                           std::span<const float, kKeySize> key, const Output* recent,
                           const LocalSettings& settings) {
  const Examples examples = gather(database, neighbours);
  const std::vector<int> member = cluster(examples, settings.components);
  std::vector<VectorXf> weights;
  for (int c = 0; c < settings.components; ++c) {
    VectorXf own = VectorXf::Zero(examples.weights.size());
    for (Index k = 0; k < own.size(); ++k) {
      if (member[static_cast<size_t>(k)] == c) own[k] = examples.weights[k];
    }
    if (own.sum() > 0) weights.push_back(std::move(own));
  }
  const RowVectorXf query = Eigen::Map<const RowVectorXf>(key.data(), kKeySize);
  RowVectorXf recent_row;
  if (recent) recent_row = Eigen::Map<const RowVectorXf>(recent->data(), kOutputs);
  const RowVectorXf* last = recent ? &recent_row : nullptr;
  const VectorXf say = say_of(examples, weights, last);
  RowVectorXf output = RowVectorXf::Zero(kOutputs);
  for (size_t c = 0; c < weights.size(); ++c) {
    output += say[static_cast<Index>(c)] *
              regress(examples, weights[c] / weights[c].sum(), query, last, settings);
  }
  LocalAnswer answer;
  Eigen::Map<RowVectorXf>(answer.output.data(), kOutputs) = output;
  // The tempo, too, is regressed on the neighbours, by their weights alone: slopes of an alignment
  // are too noisy for more. The mean is that of the rate, not of its logarithm, because rates add
  // up to the time that a take covers.
  answer.rate = 0;
  for (size_t k = 0; k < neighbours.size(); ++k) {
    const float weight = examples.weights[static_cast<Index>(k)];
    answer.rate += weight * neighbours[k].example->rate;
    for (int f = 0; f < kFeet; ++f) {
      answer.contacts[f] += weight * neighbours[k].example->contacts[f];
    }
  }
  return answer;
}

}  // namespace panache::xia2015
