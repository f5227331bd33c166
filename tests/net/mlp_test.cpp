#include "net/mlp.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <vector>

#include <gtest/gtest.h>

#include "net/dense.h"
#include "net/layer.h"

namespace panache {
namespace {

const char* const kName = "model.safetensors";

Tensor ramp(std::vector<int64_t> shape) {
  Tensor tensor{std::move(shape), {}, false};
  int64_t count = 1;
  for (const int64_t size : tensor.shape) count *= size;
  for (int64_t i = 0; i < count; ++i) {
    tensor.values.push_back(std::sin(static_cast<float>(i) * 0.7f));
  }
  return tensor;
}

// A trunk of three layers, 5 -> 4 -> 6 -> 3 unless told otherwise, called "pose".
TensorFile small_file(std::array<int64_t, 4> sizes = {5, 4, 6, 3}) {
  TensorFile file;
  for (int layer = 0; layer < 3; ++layer) {
    const std::string key = "pose." + std::to_string(layer);
    file.tensors[key + ".weight"] = ramp({sizes[layer], sizes[layer + 1]});
    file.tensors[key + ".bias"] = ramp({sizes[layer + 1]});
  }
  return file;
}

std::string failure(const TensorFile& file) {
  const Result<Trunk> trunk = Trunk::read(file, "pose", 5, kName);
  return trunk.ok() ? "" : trunk.error().message;
}

TEST(Trunk, runs_its_layers_one_after_another_with_elu_behind_each) {
  const TensorFile file = small_file();
  const Result<Trunk> trunk = Trunk::read(file, "pose", 5, kName);
  ASSERT_TRUE(trunk.ok()) << trunk.error().message;
  EXPECT_EQ(trunk->inputs(), 5);
  EXPECT_EQ(trunk->outputs(), 3);

  std::vector<float> expected = {0.5f, -1, 2, 0, 0.25f};
  const std::vector<float> x = expected;
  for (int layer = 0; layer < 3; ++layer) {
    const std::string key = "pose." + std::to_string(layer);
    const Tensor& bias = file.tensors.at(key + ".bias");
    std::vector<float> y(bias.values.size());
    scalar::dense(expected, file.tensors.at(key + ".weight").values, bias.values, y);
    scalar::elu(y);
    expected = y;
  }
  std::vector<float> scratch(trunk->scratch_size());
  const std::span<const float> y = trunk->forward(x, scratch);
  EXPECT_EQ(std::vector<float>(y.begin(), y.end()), expected);
  EXPECT_GE(y.data(), scratch.data());
  EXPECT_LE(y.data() + y.size(), scratch.data() + scratch.size());
}

TEST(TrunkTrio, gives_each_row_the_bits_that_each_of_its_trunks_gives_it_alone) {
  // Widths that are no multiple of any vector, and a trunk of a single layer.
  const std::vector<std::vector<int64_t>> sizes = {{37, 19, 6, 23}, {37, 5}, {37, 33, 17}};
  constexpr size_t kRows = 11, kInputs = 37;
  std::array<Trunk, 3> trunks;
  for (size_t t = 0; t < 3; ++t) {
    TensorFile file;
    for (size_t layer = 0; layer + 1 < sizes[t].size(); ++layer) {
      const std::string key = "pose." + std::to_string(layer);
      file.tensors[key + ".weight"] = ramp({sizes[t][layer], sizes[t][layer + 1]});
      file.tensors[key + ".bias"] = ramp({sizes[t][layer + 1]});
    }
    trunks[t] = *Trunk::read(file, "pose", kInputs, kName);
  }
  const TrunkTrio trio(trunks);
  const std::vector<float> x = ramp({kRows * kInputs}).values;
  std::vector<float> together(trio.scratch_size(kRows));
  const auto rows = trio.forward(Rows<const float>{x.data(), kRows, kInputs}, together);
  for (size_t t = 0; t < 3; ++t) {
    EXPECT_EQ(trio.outputs(t), trunks[t].outputs());
    std::vector<float> alone(trunks[t].scratch_size());
    for (size_t r = 0; r < kRows; ++r) {
      const auto expected = trunks[t].forward(std::span(x).subspan(r * kInputs, kInputs), alone);
      EXPECT_TRUE(std::ranges::equal(std::span(rows[t].row(r), expected.size()), expected))
          << "trunk " << t << ", row " << r;
    }
  }
}

TEST(TrunkTrio, does_without_a_trunk_that_is_not_there) {
  const TensorFile floats = small_file({5, 40, 20, 3});
  for (const TensorFile& file : {floats, quantize(floats)}) {
    const Trunk trunk = *Trunk::read(file, "pose", 5, kName);
    const TrunkTrio trio({trunk, Trunk::none(5), trunk});
    EXPECT_EQ(trio.outputs(1), 0);
    EXPECT_EQ(trio.all_outputs(1), 0u);
    const std::vector<float> x = ramp({5}).values;
    std::vector<float> scratch(trio.scratch_size()), alone(trunk.scratch_size());
    const auto outputs = trio.forward(x, scratch);
    const auto expected = trunk.forward(x, alone);
    for (const size_t t : {0, 2}) {
      EXPECT_EQ(std::vector(outputs[t].begin(), outputs[t].end()),
                std::vector(expected.begin(), expected.end()));
    }
  }
}

TEST(TrunkTrio, leaves_what_every_layer_answered_to_each_row) {
  // Of trunks of different depths: each layer by a trunk that ends with it.
  const TensorFile deep = small_file({5, 40, 20, 3});
  TensorFile flat = deep;
  for (const char* key : {"pose.1", "pose.2"}) {
    for (const char* part : {".weight", ".bias"}) flat.tensors.erase(std::string(key) + part);
  }
  TensorFile middle = deep;
  for (const char* part : {".weight", ".bias"}) middle.tensors.erase("pose.2" + std::string(part));
  const Trunk one = *Trunk::read(flat, "pose", 5, kName),
              two = *Trunk::read(middle, "pose", 5, kName);
  const Trunk three = *Trunk::read(deep, "pose", 5, kName);
  const TrunkTrio trio({two, one, three});
  EXPECT_EQ(trio.all_outputs(0), 60u);
  EXPECT_EQ(trio.all_outputs(1), 40u);
  EXPECT_EQ(trio.all_outputs(2), 63u);
  constexpr size_t kRows = 3;
  const std::vector<float> x = ramp({kRows * 5}).values;
  std::vector<float> scratch(trio.scratch_size(kRows)), alone(three.scratch_size()), out(63);
  trio.forward(Rows<const float>{x.data(), kRows, 5}, scratch);
  for (size_t r = 0; r < kRows; ++r) {
    std::vector<float> expected;
    for (const Trunk* trunk : {&one, &two, &three}) {
      const auto layer = trunk->forward(std::span(x).subspan(5 * r, 5), alone);
      expected.insert(expected.end(), layer.begin(), layer.end());
    }
    trio.all_layers(2, r, kRows, scratch, out);
    EXPECT_EQ(out, expected) << r;
    std::vector<float> start(60);
    trio.all_layers(0, r, kRows, scratch, start);
    EXPECT_TRUE(std::equal(start.begin(), start.end(), expected.begin())) << r;
  }
}

TEST(Trunk, takes_any_number_of_inputs_when_told_so) {
  const Result<Trunk> trunk = Trunk::read(small_file(), "pose", -1, kName);
  ASSERT_TRUE(trunk.ok());
  EXPECT_EQ(trunk->inputs(), 5);
}

TEST(Trunk, what_is_wrong_with_a_file_is_named) {
  using Tensors = std::map<std::string, Tensor>;
  const std::pair<std::function<void(Tensors&)>, std::string> cases[] = {
      {[](Tensors&) {}, ""},
      {[](Tensors& of) {
         of["pose.0.weight"] = ramp({7, 4});
       },
       "tensor 'pose.0.weight' has shape [7, 4]; expected [5, any]"},
      {[](Tensors& of) {
         of["pose.0.weight"] = ramp({5, 0});
       },
       "tensor 'pose.0.weight' has shape [5, 0]; expected [5, any]"},
      {[](Tensors& of) {
         of["pose.1.weight"] = ramp({3, 6});
       },
       "tensor 'pose.1.weight' has shape [3, 6]; expected [4, any]"},
      {[](Tensors& of) { of["pose.2.weight"] = ramp({18}); },
       "tensor 'pose.2.weight' has shape [18]; expected [6, any]"},
      {[](Tensors& of) { of["pose.2.bias"] = ramp({2}); },
       "tensor 'pose.2.bias' has shape [2]; expected [3]"},
      {[](Tensors& of) { of.erase("pose.2.bias"); }, "tensor 'pose.2.bias' is missing"},
      {[](Tensors& of) { of.clear(); }, "tensor 'pose.0.weight' is missing"},
      {[](Tensors& of) { of.erase("pose.1.weight"); },
       "has 5 tensors 'pose.*'; expected 2, a weight and a bias for each of the layers from pose.0 "
       "to pose.0"},
      {[](Tensors& of) { of["pose.1.weight"].values[5] = NAN; },
       "tensor 'pose.1.weight' holds a number that is not finite (number 5)"},
      {[](Tensors& of) { of["pose.1.bias"].values[0] = -INFINITY; },
       "tensor 'pose.1.bias' holds a number that is not finite (number 0)"}};
  for (const auto& [change, message] : cases) {
    TensorFile file = small_file();
    change(file.tensors);
    EXPECT_EQ(failure(file), message.empty() ? "" : "model.safetensors: " + message);
  }
}

TEST(ReadLayer, gives_the_numbers_of_the_file) {
  const TensorFile file = small_file();
  const Result<DenseLayer> layer = read_layer(file, "pose.1", 4, 6, kName);
  ASSERT_TRUE(layer.ok());
  EXPECT_EQ(layer->inputs, 4);
  EXPECT_EQ(layer->outputs, 6);
  EXPECT_EQ(layer->weights, file.tensors.at("pose.1.weight").values);
  EXPECT_EQ(layer->bias, file.tensors.at("pose.1.bias").values);
  EXPECT_EQ(read_layer(file, "pose.1", 4, 7, kName).error().message,
            "model.safetensors: tensor 'pose.1.weight' has shape [4, 6]; expected [4, 7]");
}

}  // namespace
}  // namespace panache
