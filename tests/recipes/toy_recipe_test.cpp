// Nothing but its folder and its line in the table knows of the toy recipe, and its models style.

#include <gtest/gtest.h>

#include "make_clip.h"
#include "make_model.h"
#include "style/stylizer.h"

namespace panache {
namespace {

const Recipe& toy() { return *find_recipe("toy"); }

// The last frame of a walk in the only style of a model.
BodyChange last_change(const std::shared_ptr<const Model>& model, float strength) {
  Clip clip = test::walking_clip(60), out = clip;
  Stylizer stylizer = *Stylizer::create(model, *Rig::create(clip));
  const std::array<float, 1> strengths = {strength};
  for (int f = 0; f < clip.frames; ++f) {
    stylizer.step(clip.pose(f), strengths, clip.frame_time, out.pose(f));
  }
  return stylizer.change();
}

TEST(ToyRecipe, a_model_of_it_is_read_and_styles) {
  const std::string bytes = format_safetensors(test::make_model({"bent"}, 1, toy()));
  const auto model = Model::parse(bytes, "toy.safetensors");
  ASSERT_TRUE(model.ok()) << model.error().message;
  EXPECT_EQ(&(*model)->recipe(), &toy());
  EXPECT_FALSE((*model)->can_learn());
  const BodyChange change = last_change(*model, 1), other = last_change(*model, 0.5f);
  const Quat bend = change.rotations[index(HumanJoint::chest)];
  EXPECT_GT(length(log_rotation(bend)), 0.01f);
  EXPECT_EQ(change.rotations[index(HumanJoint::left_hand)], bend);
  EXPECT_EQ(change.rotations[0], Quat{});
  EXPECT_NE(other.rotations[index(HumanJoint::chest)], bend) << "the strength is an input";
}

TEST(ToyRecipe, a_model_of_it_that_does_not_fit_is_rejected) {
  TensorFile file = test::make_model({"bent"}, 1, toy());
  file.tensors["output.scale"] = test::constant_tensor(StyleDelta::kSize, 1);
  EXPECT_EQ(Model::create(file, "toy.safetensors").error().message,
            "toy.safetensors: tensor 'output.scale' has shape [67]; expected [4]");
}

}  // namespace
}  // namespace panache
