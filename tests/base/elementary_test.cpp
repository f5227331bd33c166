#include "base/elementary.h"

#include <cmath>
#include <cstdint>
#include <limits>

#include <gtest/gtest.h>

#include "base/random.h"

namespace panache {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// How many floats lie between the two.
double units_apart(float found, double expected) {
  const float nearest = static_cast<float>(expected);
  const float next = std::nextafter(nearest, kInfinity);
  const double unit = static_cast<double>(next) - static_cast<double>(nearest);
  return std::abs(static_cast<double>(found) - expected) / unit;
}

// FNV-1a over the bits of the results.
struct Hash {
  uint64_t value = 0xcbf29ce484222325;
  void add(float x) { value = (value ^ std::bit_cast<uint32_t>(x)) * 0x100000001b3; }
};

TEST(Elementary, exponential_is_right_to_a_unit) {
  Random random(1);
  for (int i = 0; i < 200'000; ++i) {
    const float x = 80 * (2 * random.uniform() - 1);
    ASSERT_LE(units_apart(exponential(x), std::exp(static_cast<double>(x))), 1) << x;
  }
  EXPECT_EQ(exponential(0.0f), 1.0f);
  EXPECT_EQ(exponential(-kInfinity), 0.0f);
  EXPECT_EQ(exponential(kInfinity), kInfinity);
  EXPECT_TRUE(std::isnan(exponential(std::nanf(""))));
}

// Near its zeros a sine keeps only the digits that double has left, so it is compared absolutely.
TEST(Elementary, sine_and_cosine_are_right_to_a_unit_of_one) {
  Random random(2);
  for (int i = 0; i < 200'000; ++i) {
    const float x = (i % 2 ? 4.0f : 1000.0f) * (2 * random.uniform() - 1);
    const double exact = static_cast<double>(x);
    ASSERT_NEAR(static_cast<double>(sine(x)), std::sin(exact), 0x1p-24) << x;
    ASSERT_NEAR(static_cast<double>(cosine(x)), std::cos(exact), 0x1p-24) << x;
  }
  EXPECT_EQ(sine(0.0f), 0.0f);
  EXPECT_EQ(cosine(0.0f), 1.0f);
  EXPECT_EQ(sine(1e-20f), 1e-20f);
  for (const float x : {kInfinity, -kInfinity, std::nanf("")}) {
    EXPECT_TRUE(std::isnan(sine(x)));
    EXPECT_TRUE(std::isnan(cosine(x)));
  }
  EXPECT_LE(std::abs(sine(3e38f)), 1);
}

TEST(Elementary, arc_tangent_is_right_to_a_unit) {
  Random random(3);
  for (int i = 0; i < 200'000; ++i) {
    const float y = 2 * random.uniform() - 1, x = 2 * random.uniform() - 1;
    const double expected = std::atan2(static_cast<double>(y), static_cast<double>(x));
    ASSERT_LE(units_apart(arc_tangent(y, x), expected), 1) << y << ' ' << x;
  }
  for (const float y : {0.0f, 1.0f, -1.0f, kInfinity, -kInfinity, 1e-40f}) {
    for (const float x : {0.0f, 1.0f, -1.0f, kInfinity, -kInfinity, 1e-40f}) {
      const double expected = std::atan2(static_cast<double>(y), static_cast<double>(x));
      EXPECT_NEAR(static_cast<double>(arc_tangent(y, x)), expected, 0x1p-22) << y << ' ' << x;
    }
  }
  EXPECT_TRUE(std::isnan(arc_tangent(std::nanf(""), 1.0f)));
}

// The bits themselves: another compiler or machine that rounds otherwise fails here.
TEST(Elementary, bits_are_the_same_on_every_machine) {
  Random random(4);
  Hash hash;
  for (int i = 0; i < 100'000; ++i) {
    const float x = 20 * (2 * random.uniform() - 1), y = random.uniform();
    hash.add(sine(x)), hash.add(cosine(x)), hash.add(exponential(x)), hash.add(arc_tangent(x, y));
  }
  EXPECT_EQ(hash.value, 14361419896205005600u);
}

}  // namespace
}  // namespace panache
