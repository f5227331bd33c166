// The toy recipe is trained by what trains the others.

#include <gtest/gtest.h>

#include "make_manifest.h"
#include "style/stylizer.h"
#include "temporary_folder.h"
#include "train/trainer.h"

namespace panache {
namespace {

TEST(TrainToyRecipe, learns_the_lean_of_a_styled_walk) {
  const test::TemporaryFolder folder;
  test::write_manifest(folder.path());
  std::vector<ManifestRow> rows = *read_manifest(folder.path() + "manifest.csv", 0);
  std::vector<StyleName> styles;
  ASSERT_TRUE(apply_style_names(styles, rows).ok());
  const Result<Trained> trained = train(rows, styles, TrainOptions(*find_recipe("toy")));
  ASSERT_TRUE(trained.ok()) << trained.error().message;
  EXPECT_EQ(trained->model.metadata.at("recipe"), "toy");
  // Sums of a few hundred products in another order: single precision's share of 1e-7 each.
  EXPECT_LT(trained->export_error, 1e-4f);

  const auto model = Model::create(trained->model, "trained");
  ASSERT_TRUE(model.ok()) << model.error().message;
  Clip clip = test::walking_clip(60), out = clip;
  Stylizer stylizer = *Stylizer::create(*model, *Rig::create(clip));
  const std::array<float, 1> strengths = {1};
  double bend = 0;
  for (int f = 0; f < clip.frames; ++f) {
    stylizer.step(clip.pose(f), strengths, clip.frame_time, out.pose(f));
    bend += log_rotation(stylizer.change().rotations[index(HumanJoint::chest)]).x / clip.frames;
  }
  // The lean is a constant that a network of three layers meets within a tenth in 300 steps.
  EXPECT_NEAR(bend, test::kLean, 0.1 * test::kLean);
}

}  // namespace
}  // namespace panache
