// All kernels on random shapes and numbers, against the plain loops. PANACHE_SHAPES is how many
// (200).

#include <bit>
#include <cmath>
#include <cstdlib>
#include <string>

#include "kernel_checks.h"
#include "net/dense_int8.h"

namespace panache {
namespace {

using namespace test;

// Draws sizes and numbers; everything follows from the seed.
class Draw {
 public:
  explicit Draw(unsigned seed) : random_(seed), kind_(whole(0, 3)) {}

  size_t whole(size_t low, size_t high) {
    return std::uniform_int_distribution<size_t>(low, high)(random_);
  }
  // Small ones are as frequent as large ones: 0 to `high`.
  size_t size(size_t high) {
    const auto bits = static_cast<size_t>(std::bit_width(high));
    return std::min(high, whole(0, (size_t{1} << whole(0, bits)) - 1));
  }
  // A span of `count` numbers of one kind, somewhere in a buffer, so that vectors are not aligned.
  std::span<float> numbers(std::vector<float>& buffer, size_t count) {
    const size_t skip = whole(0, 15);
    buffer.resize(skip + count + 1);
    for (float& v : buffer) v = number();
    return std::span(buffer).subspan(skip, count);
  }
  float number() {
    switch (kind_) {
      case 0:
        return normal_(random_);
      case 1:  // Of all sizes, with products and sums that are too small or too large for a float.
        return std::ldexp(normal_(random_), static_cast<int>(whole(0, 270)) - 145);
      case 2:  // Whole, with ties and zeros of both signs.
        return std::trunc(4 * normal_(random_)) / 2;
      default:  // Any bits: infinities, NaN.
        return std::bit_cast<float>(static_cast<uint32_t>(random_()));
    }
  }

 private:
  std::mt19937 random_;
  std::normal_distribution<float> normal_{0, 1.5f};
  size_t kind_;
};

void check_dense(Draw& draw) {
  const size_t rows = draw.whole(0, 2 * kRowsAtOnce + 1), inputs = draw.size(300);
  const size_t outputs = draw.size(300), x_stride = inputs + draw.whole(0, 3);
  const size_t y_stride = outputs + draw.whole(0, 3);
  SCOPED_TRACE(std::to_string(rows) + " rows of " + std::to_string(inputs) + " inputs, " +
               std::to_string(outputs) + " outputs");
  std::vector<float> buffers[3];
  const std::span<float> x = draw.numbers(buffers[0], rows * x_stride);
  const std::span<float> weights = draw.numbers(buffers[1], inputs * outputs);
  const std::span<float> bias = draw.numbers(buffers[2], outputs);
  std::vector<float> expected(rows * y_stride + 1, kUntouched), found = expected;
  for (size_t r = 0; r < rows; ++r) {
    scalar::dense(x.subspan(r * x_stride, inputs), weights, bias,
                  std::span(expected).subspan(r * y_stride, outputs));
  }
  on_every_target([&] {
    found.assign(found.size(), kUntouched);
    dense_rows({x.data(), rows, x_stride}, inputs, weights, bias, {found.data(), rows, y_stride});
    EXPECT_TRUE(same_bits(found, expected));
  });
}

void check_dense_int8(Draw& draw) {
  const size_t rows = draw.whole(0, 2 * kRowsAtOnce + 1);
  const size_t inputs = draw.size(draw.whole(0, 9) ? 300 : kMaxInt8Inputs);
  const size_t outputs = kPadding * draw.size(12);
  const size_t x_stride = inputs + draw.whole(0, 3), y_stride = outputs + draw.whole(0, 3);
  SCOPED_TRACE(std::to_string(rows) + " rows of " + std::to_string(inputs) + " inputs, " +
               std::to_string(outputs) + " outputs, int8");
  std::vector<float> buffers[3];
  const std::span<float> x = draw.numbers(buffers[0], rows * x_stride);
  const std::span<float> scale = draw.numbers(buffers[1], outputs);
  const std::span<float> bias = draw.numbers(buffers[2], outputs);
  std::vector<int16_t> weights((inputs + 1) / 2 * outputs + kInt8Slack, packed_weights(0, 0));
  for (size_t i = 0; i < inputs; ++i) {
    for (size_t o = 0; o < outputs; ++o) {
      const int weight = static_cast<int>(draw.whole(0, 254)) - kMaxInt8Weight;
      set_int8_weight(weights.data(), outputs, i, o, static_cast<int8_t>(weight));
    }
  }
  const Int8Matrix layer{inputs, outputs, weights.data(), scale.data(), bias.data()};
  std::vector<float> expected(rows * y_stride + 1, kUntouched), found = expected;
  scalar::dense_int8({x.data(), rows, x_stride}, layer, {expected.data(), rows, y_stride});
  on_every_target([&] {
    found.assign(found.size(), kUntouched);
    dense_int8({x.data(), rows, x_stride}, layer, {found.data(), rows, y_stride});
    EXPECT_TRUE(same_bits(found, expected));
  });
}

// The kernels that take each number by itself, or sum them up.
void check_lists(Draw& draw) {
  const size_t size = draw.size(1000);
  SCOPED_TRACE(std::to_string(size) + " numbers");
  std::vector<float> buffers[4];
  const std::span<float> x = draw.numbers(buffers[0], size), y = draw.numbers(buffers[1], size);
  const std::span<float> mean = draw.numbers(buffers[2], size);
  const std::span<float> factor = draw.numbers(buffers[3], size);
  const float a = draw.number(), clip = std::abs(draw.number());
  std::vector<float> curved(x.begin(), x.end()), added(y.begin(), y.end()), clipped(size);
  scalar::elu(curved);
  scalar::add_scaled(a, x, added);
  scalar::standardise(x, mean, factor, clip, clipped);
  const float length = scalar::square_length(x);
  on_every_target([&] {
    std::vector<float> found(x.begin(), x.end());
    elu(found);
    EXPECT_TRUE(same_bits(found, curved));
    found.assign(y.begin(), y.end());
    add_scaled(a, x, found);
    EXPECT_TRUE(same_bits(found, added));
    standardise(x, mean, factor, clip, found);
    EXPECT_TRUE(same_bits(found, clipped));
    const float found_length = square_length(x);
    EXPECT_TRUE(same_bits({&found_length, 1}, {&length, 1}));
  });
}

TEST(Kernels, random_shapes_have_the_bits_of_the_plain_loops_on_every_instruction_set) {
  const char* wish = std::getenv("PANACHE_SHAPES");
  const unsigned shapes = wish ? static_cast<unsigned>(std::strtoul(wish, nullptr, 10)) : 200;
  ASSERT_GT(shapes, 0u);
  for (unsigned i = 0; i < shapes && !testing::Test::HasFailure(); ++i) {
    SCOPED_TRACE("shape " + std::to_string(i));
    Draw draw(kSeed + i);
    check_dense(draw);
    check_dense_int8(draw);
    check_lists(draw);
  }
}

}  // namespace
}  // namespace panache
