#include "net/layer.h"

#include <array>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "net/mlp.h"

namespace panache {
namespace {

const char* const kName = "model.safetensors";
constexpr unsigned kSeed = 7;

Tensor random_tensor(std::vector<int64_t> shape, std::mt19937& random) {
  std::normal_distribution<float> normal(0, 0.2f);
  Tensor tensor{std::move(shape), {}, false};
  int64_t count = 1;
  for (const int64_t size : tensor.shape) count *= size;
  for (int64_t i = 0; i < count; ++i) tensor.values.push_back(normal(random));
  return tensor;
}

void add_layer(TensorFile& file, const std::string& key, int64_t inputs, int64_t outputs,
               std::mt19937& random) {
  file.tensors[key + ".weight"] = random_tensor({inputs, outputs}, random);
  file.tensors[key + ".bias"] = random_tensor({outputs}, random);
}

// A trunk "pose" of layers 37 -> 33 -> 20.
TensorFile small_file() {
  std::mt19937 random(kSeed);
  TensorFile file;
  file.metadata["licence"] = "CC0";
  add_layer(file, "pose.0", 37, 33, random);
  add_layer(file, "pose.1", 33, 20, random);
  return file;
}

std::string failure(const TensorFile& file) {
  const Result<Trunk> trunk = Trunk::read(file, "pose", 37, kName);
  return trunk.ok() ? "" : trunk.error().message;
}

TEST(Quantize, each_weight_is_rounded_to_the_nearest_step_of_its_column) {
  const TensorFile file = small_file(), int8 = quantize(file);
  const Tensor& before = file.tensors.at("pose.0.weight");
  const Tensor& after = int8.tensors.at("pose.0.weight");
  const std::vector<float>& scale = int8.tensors.at("pose.0.scale").values;
  ASSERT_TRUE(after.int8);
  ASSERT_EQ(after.shape, before.shape);
  float largest = 0;
  for (size_t i = 0; i < before.values.size(); ++i) {
    const float step = scale[i % 33];
    // Half a step, and what a division rounds.
    EXPECT_NEAR(after.values[i] * step, before.values[i], step * 0.50001f) << i;
    largest = std::max(largest, std::abs(after.values[i]));
  }
  EXPECT_EQ(largest, 127);
  EXPECT_EQ(int8.metadata, file.metadata);
  EXPECT_EQ(int8.tensors.at("pose.0.bias").values, file.tensors.at("pose.0.bias").values);
}

TEST(Quantize, small_layers_long_ones_and_what_is_no_layer_stay_as_they_are) {
  std::mt19937 random(kSeed);
  TensorFile file = small_file();
  add_layer(file, "few", 10, 15, random);
  add_layer(file, "long", 2065, 16, random);
  add_layer(file, "longest", 2064, 16, random);
  file.tensors["lone.weight"] = random_tensor({16, 16}, random);
  file.tensors["input.mean"] = random_tensor({32}, random);
  const TensorFile int8 = quantize(file);
  for (const char* key : {"few.weight", "long.weight", "lone.weight", "input.mean"}) {
    EXPECT_FALSE(int8.tensors.at(key).int8) << key;
    EXPECT_EQ(int8.tensors.at(key).values, file.tensors.at(key).values) << key;
  }
  EXPECT_TRUE(int8.tensors.at("longest.weight").int8);
  EXPECT_EQ(int8.tensors.size(), file.tensors.size() + 3);
}

TEST(Quantize, a_column_of_zeros_stays_one) {
  TensorFile file = small_file();
  std::vector<float>& weights = file.tensors["pose.0.weight"].values;
  for (size_t i = 4; i < weights.size(); i += 33) weights[i] = 0;
  const TensorFile int8 = quantize(file);
  EXPECT_EQ(int8.tensors.at("pose.0.scale").values[4], 0);
  EXPECT_EQ(int8.tensors.at("pose.0.weight").values[4], 0);
  EXPECT_EQ(failure(int8), "");
}

TEST(Quantize, it_is_told_from_a_float_one_and_quantizes_to_itself) {
  const TensorFile file = small_file(), int8 = quantize(file);
  EXPECT_FALSE(is_quantized(file));
  EXPECT_TRUE(is_quantized(int8));
  EXPECT_EQ(format_safetensors(quantize(int8)), format_safetensors(int8));
}

TEST(Quantize, a_trunk_of_it_reads_back_and_answers_like_the_whole_one) {
  const TensorFile file = small_file();
  const Result<TensorFile> int8 = parse_safetensors(format_safetensors(quantize(file)), kName);
  ASSERT_TRUE(int8.ok()) << int8.error().message;
  const Result<Trunk> a = Trunk::read(file, "pose", 37, kName);
  const Result<Trunk> b = Trunk::read(*int8, "pose", 37, kName);
  ASSERT_TRUE(b.ok()) << b.error().message;
  EXPECT_TRUE(b->is_int8());
  EXPECT_FALSE(a->is_int8());
  std::mt19937 random(kSeed + 1);
  const std::vector<float> x = random_tensor({37}, random).values;
  std::vector<float> work_a(a->scratch_size()), work_b(b->scratch_size());
  const auto ya = a->forward(x, work_a), yb = b->forward(x, work_b);
  for (size_t i = 0; i < ya.size(); ++i) {
    // 37 products of inputs near 0.2 and errors up to 0.5 / 127 of weights up to 0.8, likewise in
    // the second layer: far below a hundredth even if most pull one way.
    EXPECT_NEAR(ya[i], yb[i], 0.01f) << i;
    EXPECT_NE(ya[i], yb[i]) << i;
  }
}

TEST(Quantize, three_trunks_of_it_give_several_rows_the_bits_that_each_gives_alone) {
  std::mt19937 random(kSeed);
  constexpr size_t kRows = 11, kInputs = 37;
  std::array<Trunk, 3> trunks;
  for (size_t t = 0; t < 3; ++t) {
    TensorFile file;
    add_layer(file, "pose.0", kInputs, 20 + 3 * static_cast<int64_t>(t), random);
    add_layer(file, "pose.1", 20 + 3 * static_cast<int64_t>(t), 17, random);
    trunks[t] = *Trunk::read(quantize(file), "pose", kInputs, kName);
  }
  const TrunkTrio trio(trunks);
  const std::vector<float> x = random_tensor({kRows * kInputs}, random).values;
  std::vector<float> together(trio.scratch_size(kRows));
  const auto rows = trio.forward(Rows<const float>{x.data(), kRows, kInputs}, together);
  for (size_t t = 0; t < 3; ++t) {
    std::vector<float> alone(trunks[t].scratch_size());
    for (size_t r = 0; r < kRows; ++r) {
      const auto expected = trunks[t].forward(std::span(x).subspan(r * kInputs, kInputs), alone);
      const std::span<const float> found(rows[t].row(r), expected.size());
      EXPECT_EQ(std::vector(found.begin(), found.end()),
                std::vector(expected.begin(), expected.end()))
          << "trunk " << t << ", row " << r;
    }
  }
}

TEST(Quantize, a_layer_without_its_int8_scale_or_with_other_bytes_is_rejected) {
  const auto message = [](auto&& change) {
    TensorFile int8 = quantize(small_file());
    change(int8.tensors);
    return failure(int8);
  };
  EXPECT_EQ(message([](auto& of) { of.erase("pose.1.scale"); }),
            "model.safetensors: tensor 'pose.1.scale' is missing");
  EXPECT_EQ(message([](auto& of) {
              of["pose.1.scale"].shape = {4, 5};
            }),
            "model.safetensors: tensor 'pose.1.scale' has shape [4, 5]; expected [20]");
  EXPECT_EQ(message([](auto& of) { of["pose.1.scale"].values[3] = INFINITY; }),
            "model.safetensors: tensor 'pose.1.scale' holds a number that is not finite (number "
            "3)");
  // A sum of such could overflow.
  EXPECT_EQ(message([](auto& of) { of["pose.1.weight"].values[6] = -128; }),
            "model.safetensors: tensor 'pose.1.weight' holds a -128 (number 6); expected bytes "
            "from -127 to 127");
}

TEST(Quantize, a_layer_with_too_many_inputs_is_rejected) {
  TensorFile file;
  std::mt19937 random(kSeed);
  add_layer(file, "pose.0", 2065, 16, random);
  Tensor& weights = file.tensors["pose.0.weight"];
  weights.int8 = true;
  for (float& w : weights.values) w = 1;
  file.tensors["pose.0.scale"] = random_tensor({16}, random);
  EXPECT_EQ(Trunk::read(file, "pose", 2065, kName).error().message,
            "model.safetensors: tensor 'pose.0.weight' of bytes has 2065 inputs; expected at most "
            "2064");
}

}  // namespace
}  // namespace panache
