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
constexpr float kNobody = 1e-4f;  // A component with less weight is empty.

// The neighbours as matrices, one per row.
struct Examples {
  VectorXf weights;  // Sum 1.
  MatrixXf keys, recent, outputs;
};

Examples gather(const Database& database, const std::vector<Database::Neighbour>& neighbours) {
  const Index count = static_cast<Index>(neighbours.size());
  Examples out{VectorXf(count), MatrixXf(count, kKeySize), MatrixXf(count, kOutputs),
               MatrixXf(count, kOutputs)};
  // A Gaussian of the distance; its deviation is half the distance of the farthest neighbour.
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

// Soft assignment of neighbours to components: [neighbours][components], rows add up to 1.
// Expectation maximisation of a Gaussian mixture with a common width, on the outputs; starts with
// the nearest neighbour and those farthest from the previous ones. Every neighbour belongs to all
// components to a degree, so that the output does not jump between frames.
MatrixXf cluster(const Examples& examples, int components) {
  const Index count = examples.outputs.rows();
  if (count < 2 * components) components = 1;
  MatrixXf members = MatrixXf::Ones(count, components);
  if (components == 1) return members;
  MatrixXf centres(components, kOutputs);
  centres.row(0) = examples.weights.transpose() * examples.outputs;
  VectorXf away = (examples.outputs.rowwise() - centres.row(0)).rowwise().squaredNorm();
  float width = std::max(examples.weights.dot(away), 1e-9f);
  for (int c = 0; c < components; ++c) {
    Index far = 0;
    away.cwiseProduct(examples.weights).maxCoeff(&far);
    centres.row(c) = examples.outputs.row(far);
    away = away.cwiseMin((examples.outputs.rowwise() - centres.row(c)).rowwise().squaredNorm());
  }
  for (int round = 0; round < kClusterRounds; ++round) {
    MatrixXf square(count, components);
    for (Index c = 0; c < components; ++c) {
      square.col(c) = (examples.outputs.rowwise() - centres.row(c)).rowwise().squaredNorm();
    }
    const VectorXf nearest = square.rowwise().minCoeff();
    members = ((square.colwise() - nearest) / (-2 * width)).array().exp();
    const VectorXf sums = members.rowwise().sum();
    members = members.array().colwise() / sums.array();
    const MatrixXf weighted = examples.weights.asDiagonal() * members;
    const Eigen::RowVectorXf totals = weighted.colwise().sum().cwiseMax(1e-9f);
    centres = totals.cwiseInverse().asDiagonal() * (weighted.transpose() * examples.outputs);
    width = std::max(weighted.cwiseProduct(square).sum(), 1e-9f);
  }
  return members;
}

// Dot products of the maps' inputs, for all components at once.
struct Products {
  MatrixXf own;   // Neighbours with neighbours: [neighbours][neighbours]
  VectorXf with;  // Neighbours with the query.
  float query;    // The query with itself.
};
Products products_of(const MatrixXf& rows, const RowVectorXf& query) {
  return {rows * rows.transpose(), rows * query.transpose(), query.squaredNorm()};
}

// The same after subtracting the rows' weighted mean from rows and query, divided by their mean
// square.
Products standardised(const Products& from, const VectorXf& weights, float share) {
  const VectorXf with_mean = from.own * weights;
  const float mean = weights.dot(with_mean), query_mean = weights.dot(from.with);
  Products out{from.own, from.with - with_mean, from.query - 2 * query_mean + mean};
  out.own.colwise() -= with_mean;
  out.own.rowwise() -= with_mean.transpose();
  out.own.array() += mean;
  out.with.array() += mean - query_mean;
  // Below this share of the sums, single-precision differences are only noise.
  const float noise = 1e-4f * weights.dot(from.own.diagonal()) + 1e-6f;
  const float factor = share / std::max(weights.dot(out.own.diagonal()), noise);
  out.own *= factor;
  out.with *= factor;
  out.query *= factor;
  return out;
}

// One autoregressive model: the output is linear in the key and the recent output. Ridge regression
// in dual form, because there are fewer neighbours than dimensions; with R the diagonal matrix of
// square roots of the weights, y = mean(y) + dY^T R (R dU dU^T R + penalty)^-1 R dU du.
// `recent`: may be null.
RowVectorXf regress(const Examples& examples, const VectorXf& weights, const Products& key,
                    const Products* recent, const LocalSettings& settings) {
  Products inputs = standardised(key, weights, recent ? 1 - settings.recent : 1.0f);
  if (recent) {
    const Products more = standardised(*recent, weights, settings.recent);
    inputs.own += more.own;
    inputs.with += more.with;
    inputs.query += more.query;
  }
  // Scales back a query beyond the neighbours, where a linear map is unreliable. Nearly constant
  // inputs may have a negative product by rounding.
  const float reach = std::max(inputs.own.diagonal().maxCoeff(), 0.0f);
  if (inputs.query > reach) inputs.with *= std::sqrt(reach / inputs.query);
  const VectorXf roots = weights.cwiseSqrt();
  MatrixXf gram = roots.asDiagonal() * inputs.own * roots.asDiagonal();
  gram.diagonal().array() += settings.penalty;
  const VectorXf shares =
      roots.cwiseProduct(gram.llt().solve(roots.cwiseProduct(inputs.with).eval()));
  // Coefficients of dY; their sum is subtracted from that of the mean.
  return (shares + (1 - shares.sum()) * weights).transpose() * examples.outputs;
}

// The weight of each component: the weight of its members, times the likelihood of the recent
// output.
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
  const MatrixXf members = cluster(examples, settings.components);
  std::vector<VectorXf> weights;
  for (Index c = 0; c < members.cols(); ++c) {
    weights.push_back(examples.weights.cwiseProduct(members.col(c)));
    if (weights.back().sum() < kNobody) weights.pop_back();
  }
  const RowVectorXf query = Eigen::Map<const RowVectorXf>(key.data(), kKeySize);
  RowVectorXf recent_row;
  if (recent) recent_row = Eigen::Map<const RowVectorXf>(recent->data(), kOutputs);
  const RowVectorXf* last = recent ? &recent_row : nullptr;
  const VectorXf say = say_of(examples, weights, last);
  const Products keys = products_of(examples.keys, query);
  Products recents;
  if (last) recents = products_of(examples.recent, *last);
  RowVectorXf output = RowVectorXf::Zero(kOutputs);
  for (size_t c = 0; c < weights.size(); ++c) {
    output += say[static_cast<Index>(c)] * regress(examples, weights[c] / weights[c].sum(), keys,
                                                   last ? &recents : nullptr, settings);
  }
  LocalAnswer answer;
  Eigen::Map<RowVectorXf>(answer.output.data(), kOutputs) = output;
  // The rate is a weighted mean over the neighbours: slopes of an alignment are too noisy for more.
  // It is the mean of the rate, not of its logarithm, because rates add up to the duration of a
  // take.
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
