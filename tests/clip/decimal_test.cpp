#include "clip/text_cursor.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace panache {
namespace {

std::string fixed(double value, int decimals) {
  std::string out = ">";
  append_fixed(out, value, decimals);
  return out.substr(1);
}

TEST(Decimal, writes_the_decimals_asked_for) {
  EXPECT_EQ(fixed(1.5, 0), "2");
  EXPECT_EQ(fixed(-0.25, 1), "-0.3");
  EXPECT_EQ(fixed(12.0625, 4), "12.0625");
  EXPECT_EQ(fixed(0.001, 6), "0.001000");
  EXPECT_EQ(fixed(-1e9, 9), "-1000000000.000000000");
}

TEST(Decimal, writes_no_negative_zero) {
  EXPECT_EQ(fixed(-0.0, 2), "0.00");
  EXPECT_EQ(fixed(-0.00001, 4), "0.0000");
}

TEST(Decimal, writes_what_is_no_number_as_one) {
  EXPECT_EQ(fixed(std::numeric_limits<double>::infinity(), 1), "1000000000.0");
  EXPECT_EQ(fixed(-1e300, 0), "-1000000000");
  EXPECT_EQ(fixed(std::numeric_limits<double>::quiet_NaN(), 4), "0.0000");
}

TEST(Decimal, is_never_further_off_than_half_the_last_digit) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> size(-6, 8.9);
  for (int i = 0; i < 10000; ++i) {
    const double value = (i % 2 ? 1 : -1) * std::pow(10, size(random));
    const int decimals = i % 10;
    const double back = std::strtod(fixed(value, decimals).c_str(), nullptr);
    // Half of the last digit, and the rounding of the product and of the double read back.
    EXPECT_LE(std::abs(back - value), 0.5 * std::pow(10, -decimals) + std::abs(value) * 4e-16)
        << value << " with " << decimals;
  }
}

TEST(Decimal, counts_decimals) {
  EXPECT_EQ(decimals_of("12"), 0);
  EXPECT_EQ(decimals_of("12."), 0);
  EXPECT_EQ(decimals_of("-.0083333"), 7);
  EXPECT_EQ(decimals_of("5.1072e-06"), 0);
}

}  // namespace
}  // namespace panache
