#pragma once
// Linear least squares with a penalty on each unknown.

#include <span>
#include <vector>

namespace panache {

// Finds the weights[unknowns][outputs] that bring row * weights near to the outputs of each row.
class Ridge {
 public:
  Ridge(int unknowns, int outputs);

  // Adds a row, or several with the same weight. rows[...][unknowns], outputs[...][outputs]
  void add(std::span<const double> rows, std::span<const double> outputs, double weight = 1);
  // penalties[unknowns], not negative: the cost of a squared weight. With `prior`
  // ([unknowns][outputs], or empty for zero), the cost of the squared distance from the prior. The
  // rows and penalties together must determine every unknown.
  std::vector<double> solve(std::span<const double> penalties,
                            std::span<const double> prior = {}) const;

  // Weighted sum of row^T row. [unknowns][unknowns]
  std::vector<double> gram() const;

 private:
  const size_t unknowns_, outputs_;
  std::vector<double> gram_;    // [unknowns][unknowns], lower triangle only
  std::vector<double> target_;  // [unknowns][outputs]
};

}  // namespace panache
