// Kernels: what they compute. On shapes and numbers of all kinds random_shapes_test compares them.

#include "net/dense.h"

#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "kernel_checks.h"

namespace panache {
namespace {

using namespace test;

void check_dense(size_t inputs, size_t outputs) {
  SCOPED_TRACE(std::to_string(inputs) + " inputs, " + std::to_string(outputs) + " outputs");
  std::mt19937 random(kSeed);
  const std::vector<float> x = random_numbers(inputs, random);
  const std::vector<float> weights = random_numbers(inputs * outputs, random);
  const std::vector<float> bias = random_numbers(outputs, random);
  std::vector<float> expected(outputs);
  std::vector<float> found(outputs + 1, kUntouched);
  scalar::dense(x, weights, bias, expected);
  dense(x, weights, bias, std::span(found).first(outputs));
  EXPECT_TRUE(same_bits(std::span(found).first(outputs), expected));
  EXPECT_EQ(found.back(), kUntouched);
}

TEST(Dense, the_plain_loop_is_a_matrix_product_in_order) {
  const std::vector<float> x = {2, 3}, weights = {1, 10, 100, 4, 40, 400}, bias = {0.5f, 0, -1};
  std::vector<float> y(3);
  scalar::dense(x, weights, bias, y);
  EXPECT_EQ(y, (std::vector<float>{14.5f, 140, 1399}));
}

TEST(Dense, sums_are_taken_input_after_input) {
  // 1e8 swallows the 1 if it comes first; any other order of the sum gives another result.
  const std::vector<float> x = {1, 1, 1}, weights = {1e8f, 1, -1e8f}, bias = {0};
  std::vector<float> y(1), z(1);
  scalar::dense(x, weights, bias, y);
  dense(x, weights, bias, z);
  EXPECT_EQ(y[0], 0);
  EXPECT_EQ(z[0], 0);
}

TEST(Dense, every_instruction_set_gives_the_bits_of_the_plain_loop_for_every_size) {
  on_every_target([] {
    for (size_t outputs = 0; outputs <= 67; ++outputs) {
      for (const size_t inputs : {0, 1, 2, 3, 7, 16, 33, 67}) check_dense(inputs, outputs);
    }
    check_dense(794, 224);
    check_dense(5, 1000);
  });
}

TEST(Dense, every_instruction_set_keeps_infinity_and_nan_where_the_plain_loop_has_them) {
  constexpr float kInf = std::numeric_limits<float>::infinity();
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  const std::vector<float> x = {1, 0, -2};
  std::vector<float> weights(3 * 37, 0.25f), bias(37, -0.0f), expected(37), found(37);
  weights[4] = kInf;
  weights[37 + 5] = kInf;
  weights[2 * 37 + 36] = kNaN;
  weights[8] = std::numeric_limits<float>::denorm_min();
  weights[37 + 8] = weights[2 * 37 + 8] = 0;
  scalar::dense(x, weights, bias, expected);
  ASSERT_TRUE(std::isnan(expected[36]) && std::isnan(expected[5]) && std::isinf(expected[4]));
  ASSERT_EQ(expected[8], std::numeric_limits<float>::denorm_min());
  on_every_target([&] {
    dense(x, weights, bias, found);
    EXPECT_TRUE(same_bits(found, expected));
  });
}

// One number of each kind, and one of each binade and sign.
std::vector<float> telling_numbers() {
  constexpr float kInf = std::numeric_limits<float>::infinity();
  std::vector<float> numbers = {0.0f,   -0.0f, 1.0f,  -1.0f, kInf,    -kInf,
                                -87.0f, -88,   -1e9f, -17.5, -1e-45f, std::nanf("")};
  for (int e = -149; e < 128; ++e) {
    for (const float m : {1.0f, 1.37f, 1.9999f}) {
      numbers.push_back(std::ldexp(m, e));
      numbers.push_back(-std::ldexp(m, e));
    }
  }
  return numbers;
}

// The distance of scalar::elu(x) from exp(x) - 1, in units in the last place.
double elu_error(float x) {
  const double truth = std::expm1(static_cast<double>(x));
  float y = x;
  scalar::elu({&y, 1});
  const float near = static_cast<float>(std::abs(truth));
  const double unit = std::nextafter(near, 2.0f) - near;
  return std::abs(y - truth) / unit;
}

TEST(Elu, is_within_one_unit_in_the_last_place_of_expm1) {
  for (int i = 1; i <= 400000; ++i) {
    const float linear = -20.0f * static_cast<float>(i) / 400000.0f;
    ASSERT_LE(elu_error(linear), 1.0) << linear;
    const float tiny = -std::exp2(-100.0f * static_cast<float>(i) / 400000.0f);
    ASSERT_LE(elu_error(tiny), 1.0) << tiny;
  }
}

TEST(Elu, leaves_the_positive_alone_and_saturates_below) {
  constexpr float kInf = std::numeric_limits<float>::infinity();
  std::vector<float> y = {3.25f, 1e30f, kInf, -25, -1e30f, -kInf, -1e-30f, std::nanf("")};
  scalar::elu(y);
  EXPECT_EQ(std::vector<float>(y.begin(), y.begin() + 7),
            (std::vector<float>{3.25f, 1e30f, kInf, -1, -1, -1, -1e-30f}));
  EXPECT_TRUE(std::isnan(y[7]));
}

TEST(Elu, every_instruction_set_gives_the_bits_of_the_plain_loop) {
  const std::vector<float> telling = telling_numbers();
  on_every_target([&] {
    std::vector<float> found = telling, expected = telling;
    scalar::elu(expected);
    elu(found);
    EXPECT_TRUE(same_bits(found, expected));
    found.clear();
    for (float v = 0.001f; v > -31.0f; v -= 0.0007f) found.push_back(v);
    // Where x / ln 2 is halfway between whole numbers, the last bit of the product decides.
    for (int n = 0; n < 43; ++n) {
      float v = -(static_cast<float>(n) + 0.5f) * 0.693147181f + 1e-5f;
      for (int step = 0; step < 400; ++step) found.push_back(v = std::nextafter(v, -100.0f));
    }
    expected = found;
    scalar::elu(expected);
    elu(found);
    EXPECT_TRUE(same_bits(found, expected));
  });
}

TEST(Standardise, numbers_are_moved_scaled_and_clipped) {
  const std::vector<float> x = {3, 1, -9}, mean = {1, 1, 1}, factor = {0.5f, 2, 0.5f};
  std::vector<float> y(3);
  standardise(x, mean, factor, 3, y);
  EXPECT_EQ(y, (std::vector<float>{1, 0, -3}));
}

TEST(SquareLength, is_the_sum_of_squares) {
  EXPECT_EQ(square_length(std::vector<float>{3, -4}), 25);
  EXPECT_EQ(square_length(std::vector<float>(100, 2)), 400);
}

TEST(SumInAnyOrder, sums_every_number_once) {
  std::vector<float> x(1000);
  for (size_t i = 0; i < x.size(); ++i) x[i] = static_cast<float>(i);
  on_every_target([&] {
    for (const size_t size : {0, 1, 7, 128, 130, 1000}) {
      // Whole numbers below 2^24: exact in any order.
      EXPECT_EQ(sum_in_any_order(std::span(x).first(size)),
                static_cast<float>(size == 0 ? 0 : size * (size - 1) / 2));
    }
  });
}

}  // namespace
}  // namespace panache
