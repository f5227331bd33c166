#include "eval/evaluator.h"

#include <cmath>

#include <gtest/gtest.h>

#include "base/random.h"

namespace panache {
namespace {

torch::Tensor cloud(int64_t rows, int64_t columns, uint64_t seed) {
  torch::Tensor tensor = torch::empty({rows, columns});
  Random random(seed);
  for (int64_t i = 0; i < tensor.numel(); ++i) tensor.data_ptr<float>()[i] = random.normal();
  return tensor;
}

// Four points on two axes of the plane turned by `angle`, whose covariance has the variances 4 and
// 1 along them.
torch::Tensor cross(double angle) {
  const double a = std::sqrt(6), b = std::sqrt(1.5), c = std::cos(angle), s = std::sin(angle);
  return torch::tensor({a * c, a * s, -a * c, -a * s, -b * s, b * c, b * s, -b * c},
                       torch::kFloat64)
      .view({4, 2});
}

TEST(Frechet, a_cloud_has_no_distance_from_itself) {
  const torch::Tensor x = cloud(50, 8, 1);
  // Roots of eigenvalues that differ in the last digits of double precision.
  EXPECT_NEAR(frechet_distance(x, x), 0, 1e-6);
}

TEST(Frechet, a_shifted_cloud_is_as_far_as_the_square_of_the_shift) {
  const torch::Tensor x = cloud(50, 8, 1);
  torch::Tensor shift = torch::zeros({8});
  shift[2] = 3;
  shift[5] = -4;
  // The sums are rounded to single precision: 1e-7 of numbers below 10, squared.
  EXPECT_NEAR(frechet_distance(x, x + shift), 25, 1e-4);
}

TEST(Frechet, in_one_dimension_deviations_differ_as_the_square_of_their_difference) {
  // Means 0 and 5, deviations 1 and 3: three points (-s, 0, s) have the deviation s.
  const torch::Tensor a = torch::tensor({-1.0, 0.0, 1.0}).view({3, 1});
  const torch::Tensor b = torch::tensor({2.0, 5.0, 8.0}).view({3, 1});
  EXPECT_NEAR(frechet_distance(a, b), 25 + 4, 1e-9);
  EXPECT_NEAR(frechet_distance(b, a), 25 + 4, 1e-9);
}

TEST(Frechet, covariances_that_do_not_commute_are_compared_right) {
  // S_a = diag(4, 1), S_b the same turned by 45 degrees: S_a S_b has the trace 12.5 and the
  // determinant 16, so its root has the trace sqrt(12.5 + 2 * sqrt(16)).
  const double expected = 10 - 2 * std::sqrt(12.5 + 2 * std::sqrt(16.0));
  EXPECT_NEAR(frechet_distance(cross(0), cross(M_PI / 4)), expected, 1e-9);
}

TEST(Frechet, fewer_rows_than_columns_give_a_finite_distance) {
  const torch::Tensor x = cloud(5, 40, 2).to(torch::kFloat64);
  EXPECT_NEAR(frechet_distance(x, x), 0, 1e-5);
  // Twice as far from the mean: S becomes 4 S, and S + 4 S - 2 * 2 S = S.
  const torch::Tensor mean = x.mean(0), centred = x - mean;
  const double trace = centred.square().sum().item<double>() / 4;
  EXPECT_NEAR(frechet_distance(x, mean + 2 * centred), trace, 1e-4 * trace);
}

TEST(Frechet, a_single_row_is_a_point) {
  const torch::Tensor x = torch::tensor({1.0, 2.0}).view({1, 2});
  const torch::Tensor y = torch::tensor({1.0, 5.0}).view({1, 2});
  EXPECT_NEAR(frechet_distance(x, y), 9, 1e-12);
}

}  // namespace
}  // namespace panache
