#include "train/fit_walker.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include "base/file.h"
#include "clip/bvh.h"
#include "learn/fit_style.h"
#include "make_clip.h"
#include "temporary_folder.h"
#include "takes/load_takes.h"
#include "train/gait_take.h"

namespace panache {
namespace {

TEST(Ridge, finds_the_weights_that_made_the_rows) {
  Ridge fit(2, 2);
  for (int i = 0; i < 10; ++i) {
    const double x = 0.3 * i;
    fit.add(std::array{1.0, x}, std::array{2 + 3 * x, -x});
  }
  const std::vector<double> weights = fit.solve(std::array{0.0, 0.0});
  EXPECT_NEAR(weights[0], 2, 1e-9);
  EXPECT_NEAR(weights[1], 0, 1e-9);
  EXPECT_NEAR(weights[2], 3, 1e-9);
  EXPECT_NEAR(weights[3], -1, 1e-9);
}

TEST(Ridge, stays_with_the_prior_where_the_rows_say_nothing) {
  Ridge fit(2, 1);
  fit.add(std::array{1.0, 0.0}, std::array{4.0});
  const std::vector<double> weights = fit.solve(std::array{1.0, 1.0}, std::array{2.0, 7.0});
  EXPECT_NEAR(weights[0], 3, 1e-12);  // As far from the row as from the prior.
  EXPECT_NEAR(weights[1], 7, 1e-12);
}

class FitWalker : public testing::Test {
 protected:
  std::string write_walk() const {
    const std::string path = folder_ + "walk.bvh";
    EXPECT_TRUE(write_file(path, format_bvh(test::walking_clip(150)), true).ok());
    return path;
  }

  const test::TemporaryFolder temporary_;
  const std::string folder_ = temporary_.path();
};

TEST_F(FitWalker, sees_speed_and_cadence_of_a_walk) {
  ManifestRow row;
  row.path = write_walk();
  const Result<Take> take = load_take(row, PoseLayout::positions);
  ASSERT_TRUE(take.ok()) << take.error().message;
  const std::vector<GaitFrame> frames = gait_frames(*take);
  // Six digits of frame time make 150 frames a little less than that many thirtieths.
  ASSERT_GE(frames.size(), 149u);
  for (int f = 5; f < 145; ++f) {
    // 1.2 m/s, one cycle a second.
    EXPECT_NEAR(frames[f].going.speed, 1.2, 0.02) << f;
    EXPECT_NEAR(frames[f].going.turn, 0, 0.02) << f;
    EXPECT_NEAR(frames[f].sideways, 0, 0.02) << f;
    EXPECT_NEAR(frames[f].cadence, 1, 0.02) << f;
    EXPECT_GT(frames[f].phase, frames[f - 1].phase);
  }
  // The left thigh is furthest ahead at a quarter of each second; the knees shift the ankles'
  // phase.
  const double quarter = (frames[37].phase + frames[38].phase) / 2;
  EXPECT_NEAR(std::remainder(quarter, 2 * std::numbers::pi), 0, 0.5);
}

TEST_F(FitWalker, sees_no_gait_in_someone_who_stands) {
  Clip clip = test::walking_clip(60);
  for (int f = 1; f < 60; ++f) {
    std::copy_n(clip.rotations.begin(), clip.joints(), clip.pose(f).rotations.begin());
    std::copy_n(clip.translations.begin(), clip.joints(), clip.pose(f).translations.begin());
  }
  ManifestRow row;
  row.path = folder_ + "stand.bvh";
  ASSERT_TRUE(write_file(row.path, format_bvh(clip), true).ok());
  const Result<Take> take = load_take(row, PoseLayout::positions);
  ASSERT_TRUE(take.ok()) << take.error().message;
  EXPECT_TRUE(gait_frames(*take).empty());
}

TEST_F(FitWalker, explains_what_the_manifests_lack) {
  ManifestRow row;
  row.path = write_walk();
  row.content = "walk";
  row.neutral = true;
  const Result<FittedWalker> fitted = fit_walker({row}, "", "");
  ASSERT_FALSE(fitted.ok());
  EXPECT_EQ(fitted.error().message,
            "the manifests hold 143 frames of neutral walking that are not held out; expected "
            "some hundreds");
  row.test = true;
  EXPECT_EQ(fit_walker({row}, "", "").error().message,
            "the manifests hold 0 frames of neutral walking that are not held out; expected "
            "some hundreds");
}

TEST(FitWalkerData, the_shipped_walker_is_what_the_command_makes) {
  const char* data = std::getenv("PANACHE_DATA");
  if (!data) GTEST_SKIP() << "PANACHE_DATA does not say where the motion data are";
  const std::string manifest = data + std::string("/cmu.csv");
  if (!std::filesystem::exists(manifest)) GTEST_SKIP() << "PANACHE_DATA holds no cmu.csv";
  const Result<std::vector<ManifestRow>> rows = read_manifest(manifest, 0);
  ASSERT_TRUE(rows.ok()) << rows.error().message;
  const Result<FittedWalker> fitted = fit_walker(*rows, "", "");
  ASSERT_TRUE(fitted.ok()) << fitted.error().message;
  const auto shipped = WalkerModel::load(PANACHE_SOURCE_DIR "/models/walker.safetensors");
  ASSERT_TRUE(shipped.ok()) << shipped.error().message;
  for (const auto& [ours, theirs] : {std::pair{&fitted->model.walk(), &(*shipped)->walk()},
                                     std::pair{&fitted->model.run(), &(*shipped)->run()}}) {
    for (size_t i = 0; i < ours->coefficients.size(); ++i) {
      // Other compilers and machines round otherwise; a thousandth of a radian is not seen.
      ASSERT_NEAR(ours->coefficients[i], theirs->coefficients[i], 1e-3f) << i;
    }
    EXPECT_NEAR(ours->cadence, theirs->cadence, 1e-3f);
  }
}

}  // namespace
}  // namespace panache
