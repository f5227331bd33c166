#include "walker/walker_model.h"

#include <cmath>
#include <functional>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "net/safetensors.h"
#include "walker/made_up_gait.h"

namespace panache {
namespace {

using test::made_up_walker;

TEST(WalkerModel, reads_back_what_it_writes) {
  const WalkerModel model = made_up_walker();
  const auto again = WalkerModel::parse(model.format(), "w.safetensors");
  ASSERT_TRUE(again.ok()) << again.error().message;
  EXPECT_EQ((*again)->format(), model.format());
  EXPECT_EQ((*again)->walk().coefficients, model.walk().coefficients);
  EXPECT_EQ((*again)->run().reference, 2.8f);
  EXPECT_EQ((*again)->walk().gaze_lead, 0.1f);
  EXPECT_EQ((*again)->stand(), model.stand());
  EXPECT_EQ((*again)->metadata().at("format"), "panache-walker");
  EXPECT_EQ((*again)->metadata().at("licence"), "none");
}

TEST(WalkerModel, explains_a_file_that_is_no_walker) {
  const std::string no_gait = "tensor 'walk.numbers' holds numbers that no gait has";
  const std::pair<std::function<void(TensorFile&)>, std::string> cases[] = {
      {[](TensorFile& file) { file.metadata["format"] = "panache"; },
       "is a safetensors file, but not a walker; expected metadata 'format' to be "
       "'panache-walker'"},
      {[](TensorFile& file) { file.metadata["format_version"] = "7"; },
       "is a walker of format version 7; this program reads version 1; fit it again or use the "
       "program it came with"},
      {[](TensorFile& file) { file.metadata.erase("format_version"); },
       "metadata 'format_version' is missing; expected a walker written by panache"},
      {[](TensorFile& file) { file.tensors.erase("stand"); }, "tensor 'stand' is missing"},
      {[](TensorFile& file) {
         file.tensors["run.coefficients"] = {{2, 3}, std::vector<float>(6)};
       },
       "tensor 'run.coefficients' has shape [2, 3]; expected [51, 13, 6]"},
      {[](TensorFile& file) { file.tensors["walk.coefficients"].values[5] = NAN; },
       "tensor 'walk.coefficients' holds a number that is not finite (number 5)"},
      {[](TensorFile& file) { file.tensors["walk.coefficients"].values[5] = 1e4f; },
       "tensor 'walk.coefficients' holds a number that is too large (number 5)"},
      // Slowest, cadence, lift before landing.
      {[](TensorFile& file) { file.tensors["walk.numbers"].values[1] = 0; }, no_gait},
      {[](TensorFile& file) { file.tensors["walk.numbers"].values[3] = -1; }, no_gait},
      {[](TensorFile& file) { file.tensors["walk.numbers"].values[7] = 0; }, no_gait}};
  for (const auto& [change, message] : cases) {
    TensorFile file = *parse_safetensors(made_up_walker().format(), "made up");
    change(file);
    const auto model = WalkerModel::parse(format_safetensors(file), "w.safetensors");
    ASSERT_FALSE(model.ok()) << message;
    EXPECT_EQ(model.error().message, "w.safetensors: " + message);
  }
  EXPECT_FALSE(WalkerModel::parse("", "w.safetensors").ok());
  EXPECT_EQ(WalkerModel::load("/nowhere/w.safetensors").error().message,
            "/nowhere/w.safetensors: cannot be read: No such file or directory");
}

TEST(WalkerModel, survives_every_truncation) {
  const std::string bytes = made_up_walker().format();
  for (size_t size = 0; size < bytes.size(); size += size < 2000 ? 1 : 97) {
    EXPECT_FALSE(WalkerModel::parse(std::string_view(bytes).substr(0, size), "w").ok()) << size;
  }
}

TEST(WalkerModel, strides_match_the_speed) {
  const WalkerModel model = made_up_walker();
  for (const float speed : {0.7f, 0.9f, 1.1f, 1.3f}) {
    const Stride stride = model.walk_stride(speed);
    const float cycle = speed / cadence(model.walk(), speed);
    // The table is read between entries 0.1 m/s apart.
    EXPECT_NEAR(stride.amount * distance_over_foot(model.walk(), stride.speed), cycle,
                0.01f * cycle);
  }
  EXPECT_EQ(model.walk_stride(0).amount, 0);
}

TEST(Gait, a_reflection_undone_is_the_same) {
  Channels channels;
  for (int c = 0; c < kChannels; ++c) channels[c] = static_cast<float>(c + 1);
  EXPECT_NE(mirrored(channels), channels);
  EXPECT_EQ(mirrored(mirrored(channels)), channels);
  EXPECT_EQ(mirrored(channels)[0], -channels[0]);
}

TEST(Gait, waves_are_cosines_and_sines) {
  std::array<float, kWaves> waves;
  gait_waves(0.7f, waves);
  for (int k = 1; k <= kHarmonics; ++k) {
    EXPECT_NEAR(waves[2 * k - 1], std::cos(0.7f * k), 1e-6f);
    EXPECT_NEAR(waves[2 * k], std::sin(0.7f * k), 1e-6f);
  }
}

}  // namespace
}  // namespace panache
