#include "learn/ridge.h"

#include <algorithm>
#include <cassert>
#include <cmath>

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

}  // namespace panache
