// A program as it was written for 0.2: compiled with the header of then, run on the library of now.
#include "fixtures/panache-0.2.h"

#include <cmath>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <gtest/gtest.h>

// The figure's own include of the header is of no effect: the fixture has its guard.
#include "../../samples/common/stick_figure.h"

namespace {

static_assert(PANACHE_VERSION_MAJOR == 0 && PANACHE_VERSION_MINOR == 2,
              "this program was written for 0.2");

TEST(ProgramOf02, runs_on_the_library_of_today) {
  std::ifstream file(PANACHE_SOURCE_DIR "/models/panache.safetensors", std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  panache_model* model = nullptr;
  ASSERT_EQ(panache_model_create(bytes.data(), bytes.size(), &model), PANACHE_OK);
  const panache_human_joint map[] = {{"head", 4}, {"leftShoulder", -1}};
  panache_skeleton_options found = PANACHE_SKELETON_OPTIONS;
  found.up_axis = "+Y";
  found.human_joints = map;
  found.human_joint_count = 2;
  panache_skeleton* skeleton = nullptr;
  ASSERT_EQ(panache_skeleton_create(stick_figure, STICK_JOINTS, &found, &skeleton), PANACHE_OK)
      << panache_last_error();

  panache_character_options options = PANACHE_CHARACTER_OPTIONS;
  options.max_lag = 1;
  panache_character* character = nullptr;
  ASSERT_EQ(panache_character_create(model, skeleton, &options, &character), PANACHE_OK);
  panache_shape shape = PANACHE_SHAPE;
  shape.right_arm = 0.5f;
  shape.foot_lock = 0;
  ASSERT_EQ(panache_character_set_shape(character, &shape), PANACHE_OK) << panache_last_error();
  panache_character_set_strength(character, panache_model_find_style(model, "mummy"), 1);
  std::vector<float> rotations, translations;
  for (int f = 0; f < 120; ++f) {
    stick_pose in, out;
    stick_walk(f / 60.0, 0, &in);
    panache_character_step(character, stick_input(&in), 1 / 60.0, stick_output(&out));
    ASSERT_TRUE(std::isfinite(out.rotations[4][0]));
    const float *q = &in.rotations[0][0], *t = &in.translations[0][0];
    rotations.insert(rotations.end(), q, q + 4 * STICK_JOINTS);
    translations.insert(translations.end(), t, t + 3 * STICK_JOINTS);
  }
  // A mummy is slow: with time to spare it is late, so every field is where it was in 0.2.
  panache_report report = PANACHE_REPORT;
  ASSERT_EQ(panache_character_get_report(character, &report), PANACHE_OK);
  EXPECT_GT(report.gate, 0);
  EXPECT_LE(report.gate, 1);
  EXPECT_LT(report.rate, 1);
  EXPECT_LT(report.ahead, 0);
  EXPECT_GE(report.ahead, -1);

  const panache_clip clip = {skeleton, 120, 1 / 60.0, rotations.data(), translations.data()};
  const panache_strength_key key = {0, 1};
  const panache_strength_track track = {panache_model_find_style(model, "mummy"), 1, &key};
  panache_stylize_options stylize = PANACHE_STYLIZE_OPTIONS;
  stylize.shape = &shape;
  panache_styled_clip* styled = nullptr;
  ASSERT_EQ(panache_stylize_clip(model, &clip, &track, 1, &stylize, &styled), PANACHE_OK)
      << panache_last_error();
  EXPECT_GT(panache_styled_clip_frame_count(styled), 120);
  panache_styled_clip_destroy(styled);
  panache_character_destroy(character);
  panache_skeleton_destroy(skeleton);
  panache_model_destroy(model);
}

}  // namespace
