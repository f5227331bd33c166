#include "learn/fit_style.h"

#include <cmath>

#include <gtest/gtest.h>

#include "learn/make_takes.h"
#include "make_model.h"
#include "style/networks/networks.h"

namespace panache {
namespace {

TEST(ActivationStatistics, are_those_of_neutral_takes_that_are_not_held_out) {
  std::vector<Take> takes = {test::make_take("neutral", 40, 0, 1, 0)};
  TensorFile file = test::make_model({"old"});
  ASSERT_TRUE(add_activation_statistics(takes, file).ok());
  const auto model = *Model::parse(format_safetensors(file), "m");
  ASSERT_TRUE(model->can_learn());
  // By hand, of every fifth frame, as the file keeps it in 16 bits.
  const StyleNetworks networks(model);
  std::vector<float> window(size_t(kWindowPoses) * 66), activations(model->activation_count());
  double sum = 0, squares = 0;
  for (int f = 0; f < 40; f += 5) {
    take_window(takes[0], static_cast<float>(f), 66, window);
    networks.activations(window, activations);
    sum += activations[20] / 8.0;
    squares += double(activations[20]) * activations[20] / 8.0;
  }
  EXPECT_NEAR(model->activation_mean()[20], sum, 1e-3);
  EXPECT_NEAR(model->activation_scale()[20], std::sqrt(squares - sum * sum) + 0.01, 1e-3);

  takes.push_back(test::make_take("old", 40, 0, 1, 0.5f));
  takes.push_back(test::make_take("neutral", 40, 2, 1, 0.9f));
  takes.back().row.test = true;
  TensorFile again = test::make_model({"old"});
  ASSERT_TRUE(add_activation_statistics(takes, again).ok());
  EXPECT_EQ(again.tensors["learn.mean"].values, file.tensors["learn.mean"].values);
}

TEST(ActivationStatistics, a_model_of_the_slides_recipe_cannot_have_them) {
  TensorFile file = test::make_model({"old"}, 1, test::kSmith2019);
  const Result<void> added = add_activation_statistics({}, file);
  ASSERT_FALSE(added.ok());
  EXPECT_EQ(added.error().message,
            "the model is of recipe smith2019, on which no style can be learnt");
}

}  // namespace
}  // namespace panache
