#include "style/model.h"

#include <gtest/gtest.h>

#include "make_model.h"

namespace panache {
namespace {

std::string refusal(const TensorFile& file) {
  const auto model = Model::parse(format_safetensors(file), "m.safetensors");
  return model.ok() ? "accepted" : model.error().message;
}

TEST(Model, what_was_written_is_read) {
  const auto model =
      Model::parse(format_safetensors(test::make_model({"old", "proud"})), "m.safetensors");
  ASSERT_TRUE(model.ok()) << model.error().message;
  EXPECT_EQ((*model)->styles().size(), 2u);
  EXPECT_EQ((*model)->styles()[1].name, "proud");
  EXPECT_EQ((*model)->styles()[1].description, "looks proud");
  EXPECT_EQ((*model)->recipe(), Recipe::panache);
}

TEST(Model, a_model_of_another_version_is_refused) {
  TensorFile file = test::make_model({"old"});
  file.metadata["format_version"] = "7";
  EXPECT_EQ(refusal(file),
            "m.safetensors: is a model of format version 7; this program reads version 1; train it "
            "again or use the program it came with");
}

TEST(Model, a_safetensors_file_of_something_else_is_refused) {
  TensorFile file = test::make_model({"old"});
  file.metadata.erase("format");
  EXPECT_EQ(refusal(file),
            "m.safetensors: is a safetensors file, but not a panache model; expected metadata "
            "'format' to be 'panache'");
}

TEST(Model, wrong_or_missing_tensors_are_named) {
  TensorFile file = test::make_model({"old"});
  file.tensors.erase("input.mean");
  EXPECT_EQ(refusal(file), "m.safetensors: tensor 'input.mean' is missing");
  file = test::make_model({"old"});
  file.tensors["input.scale"].values[3] = 0;
  EXPECT_EQ(refusal(file), "m.safetensors: tensor 'input.scale' must be above zero throughout");
  file = test::make_model({"old"});
  file.tensors["input.mean"].shape = {33, 2};
  EXPECT_EQ(refusal(file),
            "m.safetensors: tensor 'input.mean' has 66 numbers; expected shape [66]");
  file = test::make_model({"old"});
  file.metadata["recipe"] = "magic";
  EXPECT_EQ(refusal(file), "m.safetensors: has recipe 'magic'; expected panache or smith2019");
  file = test::make_model({"old"});
  file.metadata["styles"] = "old\nproud\n";
  EXPECT_NE(refusal(file), "accepted");
}

TEST(Model, an_unknown_style_gets_the_nearest_names) {
  const auto model = *Model::parse(
      format_safetensors(test::make_model({"angry", "old", "proud", "sad"})), "m.safetensors");
  EXPECT_EQ(*model->find_style("proud"), 2);
  EXPECT_EQ(
      model->find_style("prod").error().message,
      "unknown style 'prod'; the nearest are proud, old and sad (panache styles lists all 4)");
}

TEST(Networks, strength_acts_linearly_and_styles_add_up) {
  const auto model =
      *Model::parse(format_safetensors(test::make_model({"old", "proud"})), "m.safetensors");
  StyleNetworks networks(model);
  std::vector<float> window(size_t(kWindowPoses) * 66);
  Random random(5);
  for (float& w : window) w = random.normal();
  const auto answer = [&](float old, float proud) {
    networks.set_strengths(std::vector<float>{old, proud});
    networks.forward(window);
    return std::vector<float>(networks.pose().begin(), networks.pose().end());
  };
  const std::vector<float> none = answer(0, 0), a = answer(1, 0), b = answer(0, 1);
  const std::vector<float> both = answer(0.5f, 2);
  for (size_t i = 0; i < none.size(); ++i) {
    EXPECT_EQ(none[i], 0);
    EXPECT_NEAR(both[i], 0.5f * a[i] + 2 * b[i], 1e-5);  // Sums of 16 products below 1.
  }
}

}  // namespace
}  // namespace panache
