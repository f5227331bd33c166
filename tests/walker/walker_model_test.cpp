#include "walker/walker_model.h"

#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

#include "net/safetensors.h"
#include "walker/made_up_gait.h"

namespace panache {
namespace {

using test::made_up_walker;

TensorFile made_up_file() { return *parse_safetensors(made_up_walker().format(), "made up"); }

void expect_rejected(const TensorFile& file, const std::string& message) {
  const auto model = WalkerModel::parse(format_safetensors(file), "w.safetensors");
  ASSERT_FALSE(model.ok());
  EXPECT_EQ(model.error().message, message);
}

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
  TensorFile file = made_up_file();
  file.metadata["format"] = "panache";
  expect_rejected(file,
                  "w.safetensors: is a safetensors file, but not a walker; expected metadata "
                  "'format' to be 'panache-walker'");
  file = made_up_file();
  file.metadata["format_version"] = "7";
  expect_rejected(file,
                  "w.safetensors: is a walker of format version 7; this program reads version 1; "
                  "fit it again or use the program it came with");
  file.metadata.erase("format_version");
  expect_rejected(file,
                  "w.safetensors: metadata 'format_version' is missing; expected a walker written "
                  "by panache");
  EXPECT_FALSE(WalkerModel::parse("", "w.safetensors").ok());
  EXPECT_EQ(WalkerModel::load("/nowhere/w.safetensors").error().message,
            "/nowhere/w.safetensors: cannot be read: No such file or directory");
}

TEST(WalkerModel, explains_wrong_tensors) {
  TensorFile file = made_up_file();
  file.tensors.erase("stand");
  expect_rejected(file, "w.safetensors: tensor 'stand' is missing");
  file = made_up_file();
  file.tensors["run.coefficients"] = {{2, 3}, std::vector<float>(6)};
  expect_rejected(file,
                  "w.safetensors: tensor 'run.coefficients' has shape [2, 3]; expected [51, 13, "
                  "6]");
  file = made_up_file();
  file.tensors["walk.coefficients"].values[5] = std::numeric_limits<float>::quiet_NaN();
  expect_rejected(file,
                  "w.safetensors: tensor 'walk.coefficients' holds a number that is not finite "
                  "(number 5)");
  file.tensors["walk.coefficients"].values[5] = 1e4f;
  expect_rejected(file,
                  "w.safetensors: tensor 'walk.coefficients' holds a number that is too large "
                  "(number 5)");
}

TEST(WalkerModel, rejects_numbers_that_no_gait_has) {
  const std::string message = "w.safetensors: tensor 'walk.numbers' holds numbers that no gait has";
  // Slowest, cadence, lift before landing.
  for (const auto& [index, value] : {std::pair{1, 0.0f}, std::pair{3, -1.0f}, std::pair{7, 0.0f}}) {
    TensorFile file = made_up_file();
    file.tensors["walk.numbers"].values[index] = value;
    expect_rejected(file, message);
  }
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
