#include "net/dense_int8.h"

#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "kernel_checks.h"

namespace panache {
namespace {

using namespace test;

// A layer and what its kernels want.
struct Layer {
  Layer(size_t layer_inputs, size_t layer_outputs, std::mt19937& random)
      : inputs(layer_inputs),
        outputs(layer_outputs),
        weights((inputs + 1) / 2 * outputs + kInt8Slack, packed_weights(0, 0)),
        scale(random_numbers(outputs, random)),
        bias(random_numbers(outputs, random)) {
    std::uniform_int_distribution<int> byte(-kMaxInt8Weight, kMaxInt8Weight);
    for (size_t i = 0; i < inputs; ++i) {
      for (size_t o = 0; o < outputs; ++o) set(i, o, byte(random));
    }
  }
  void set(size_t i, size_t o, int weight) {
    set_int8_weight(weights.data(), outputs, i, o, static_cast<int8_t>(weight));
  }
  Int8Matrix matrix() const { return {inputs, outputs, weights.data(), scale.data(), bias.data()}; }

  size_t inputs, outputs;
  std::vector<int16_t> weights;
  std::vector<float> scale, bias;
};

// Compares a row with the plain loop.
void check(const Layer& layer, const std::vector<float>& x) {
  std::vector<float> found(layer.outputs + 1, kUntouched), expected = found;
  scalar::dense_int8({x.data(), 1, 0}, layer.matrix(), {expected.data(), 1, 0});
  dense_int8({x.data(), 1, 0}, layer.matrix(), {found.data(), 1, 0});
  EXPECT_TRUE(same_bits(found, expected)) << layer.inputs << " inputs";
}

TEST(DenseInt8, the_plain_loop_is_a_matrix_product_of_rounded_numbers) {
  std::mt19937 random(kSeed);
  Layer layer(3, kPadding, random);
  // Steps of 2^-12: 1.25 is 5120 of them, 2^-13 is half of one and goes to the even 0.
  const std::vector<float> x = {1.25f, 0x1p-13f, -3 * 0x1p-13f};
  layer.set(0, 0, 100);
  layer.set(1, 0, 127);
  layer.set(2, 0, 1);
  layer.scale[0] = 0.5f;
  layer.bias[0] = 1;
  std::vector<float> y(kPadding);
  scalar::dense_int8({x.data(), 1, 0}, layer.matrix(), {y.data(), 1, 0});
  EXPECT_EQ(y[0], 1 + 0.5f * 0x1p-12f * (5120 * 100 + 0 * 127 - 2 * 1));
}

TEST(DenseInt8, products_as_large_as_can_be_do_not_leave_32_bits) {
  // All inputs at 2^13 steps, all weights at 127, and as many of both as a layer may have.
  std::mt19937 random(kSeed);
  Layer layer(kMaxInt8Inputs, kPadding, random);
  for (size_t i = 0; i < layer.inputs; ++i) {
    for (size_t o = 0; o < layer.outputs; ++o) {
      layer.set(i, o, o % 2 ? kMaxInt8Weight : -kMaxInt8Weight);
    }
  }
  layer.scale.assign(kPadding, 1);
  layer.bias.assign(kPadding, 0);
  // The largest float below 1 is 8191.9995 steps of 2^-13, and rounded 8192.
  std::vector<float> x(kMaxInt8Inputs, std::nextafter(1.0f, 0.0f));
  for (const float sign : {1.0f, -1.0f}) {
    for (float& v : x) v = sign * std::abs(v);
    on_every_target([&] {
      std::vector<float> y(kPadding);
      dense_int8({x.data(), 1, 0}, layer.matrix(), {y.data(), 1, 0});
      const double whole = double(kMaxInt8Inputs) * 8192 * kMaxInt8Weight;
      ASSERT_LT(whole, double(std::numeric_limits<int32_t>::max()));
      for (size_t o = 0; o < kPadding; ++o) {
        EXPECT_EQ(y[o], static_cast<float>((o % 2 ? sign : -sign) * whole) * 0x1p-13f) << o;
      }
      check(layer, x);
    });
  }
}

TEST(DenseInt8, rows_of_any_size_have_the_bits_of_the_plain_loop) {
  on_every_target([] {
    std::mt19937 random(kSeed);
    const Layer layer(21, 32, random);
    const std::vector<float> ordinary = random_numbers(21, random);
    for (int e = -149; e < 127; ++e) {
      std::vector<float> x = ordinary;
      for (float& v : x) v = std::ldexp(v, e);
      check(layer, x);
    }
    check(layer, std::vector<float>(21, std::numeric_limits<float>::max()));
    check(layer, std::vector<float>(21, -0.0f));
  });
}

TEST(DenseInt8, numbers_that_are_not_finite_count_as_zero) {
  std::mt19937 random(kSeed);
  const Layer layer(20, 32, random);
  std::vector<float> x = random_numbers(20, random), without = x;
  x[3] = std::nanf("");
  x[4] = INFINITY;
  x[18] = -INFINITY;  // Where no whole vector is.
  without[3] = without[4] = without[18] = 0;
  on_every_target([&] {
    std::vector<float> y(32), expected(32);
    dense_int8({x.data(), 1, 0}, layer.matrix(), {y.data(), 1, 0});
    scalar::dense_int8({without.data(), 1, 0}, layer.matrix(), {expected.data(), 1, 0});
    EXPECT_TRUE(same_bits(y, expected));
  });
}

TEST(DenseInt8, a_row_of_nothing_gives_the_bias) {
  std::mt19937 random(kSeed);
  const Layer layer(20, 32, random);
  on_every_target([&] {
    for (const float nothing : {0.0f, 0x1p-120f, std::nanf("")}) {
      const std::vector<float> x(20, nothing);
      std::vector<float> y(32);
      dense_int8({x.data(), 1, 0}, layer.matrix(), {y.data(), 1, 0});
      EXPECT_TRUE(same_bits(y, layer.bias));
    }
  });
}

}  // namespace
}  // namespace panache
