#pragma once
// The distance between two sets of features.

#include <torch/types.h>

namespace panache {

// Frechet distance of the normal distributions fitted to the rows of `a` and `b` (Heusel et al.
// 2017): |m_a - m_b|^2 + tr(S_a + S_b - 2 (S_a S_b)^(1/2)). Both need at least one row, and the
// same columns.
double frechet_distance(const torch::Tensor& a, const torch::Tensor& b);

}  // namespace panache
