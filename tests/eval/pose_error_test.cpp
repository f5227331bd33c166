#include "eval/pose_error.h"

#include <gtest/gtest.h>

#include "make_manifest.h"
#include "make_model.h"
#include "temporary_folder.h"

namespace panache {
namespace {

class PoseErrorTest : public testing::Test {
 protected:
  PoseErrorTest() {
    test::write_manifest(folder_, {"train", "test"});
    rows_ = *read_manifest(folder_ + "manifest.csv", 0);
    std::vector<StyleName> styles;
    EXPECT_TRUE(apply_style_names(styles, rows_).ok());
  }

  const test::TemporaryFolder temporary_;
  const std::string folder_ = temporary_.path();
  std::vector<ManifestRow> rows_;
};

TEST_F(PoseErrorTest, a_constant_lean_is_all_posture) {
  const auto table = measure_pose_error(rows_, {});
  ASSERT_TRUE(table.ok()) << table.error().message;
  ASSERT_EQ(table->rows.size(), 2u);
  const PoseErrorRow& old = table->rows[0];
  EXPECT_EQ(old.style, "old");
  EXPECT_GT(old.frames, 50u);
  // Left alone, one of 21 joints is off by the lean, and everything above it by centimetres.
  EXPECT_NEAR(old.errors[0].degrees, test::kLean * 180 / M_PI / kHumanJoints, 0.3);
  EXPECT_GT(old.errors[0].cm, 3);
  // With the mean posture hardly anything is left: the alignment is good to a frame.
  EXPECT_LT(old.errors[1].degrees, 0.35 * old.errors[0].degrees);
  EXPECT_LT(old.errors[1].cm, 0.35 * old.errors[0].cm);
}

TEST_F(PoseErrorTest, a_model_has_its_own_column_and_a_random_one_is_no_good) {
  for (const Recipe recipe : {Recipe::panache, Recipe::smith2019}) {
    const auto model = *Model::parse(format_safetensors(test::make_model({"old"}, 1, recipe)), "m");
    const auto table = measure_pose_error(rows_, {{"random", model}});
    ASSERT_TRUE(table.ok()) << table.error().message;
    EXPECT_EQ(table->systems.back(), "random");
    EXPECT_GT(table->rows[0].errors[2].cm, table->rows[0].errors[1].cm);
  }
}

TEST_F(PoseErrorTest, without_test_takes_there_is_nothing_to_judge) {
  for (ManifestRow& row : rows_) row.test = false;
  EXPECT_EQ(measure_pose_error(rows_, {}).error().message,
            "no styled test take has a neutral test take of its content");
}

}  // namespace
}  // namespace panache
