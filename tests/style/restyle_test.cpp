#include "style/restyle.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>

#include <gtest/gtest.h>

#include "clip/motion_file.h"
#include "make_clip.h"
#include "make_model.h"
#include "style_checks.h"

namespace panache {
namespace {

std::shared_ptr<const Model> model_with_rate(float log_rate) {
  TensorFile file = test::make_model({"old"});
  Tensor& weight = file.tensors["timing.head.0.weight"];
  std::fill(weight.values.begin(), weight.values.end(), 0.0f);
  file.tensors["timing.head.0.bias"].values = {log_rate};
  return read(file);
}

Restyled restyle_with(float log_rate, float strength, const RestyleOptions& options = {}) {
  const Clip clip = test::walking_clip(121, 60);
  return *restyle(clip, *Rig::create(clip), model_with_rate(log_rate), {{0, {{0, strength}}}},
                  options);
}

TEST(Restyle, a_slow_style_takes_longer_and_a_fast_one_less) {
  EXPECT_NEAR(restyle_with(std::log(0.8f), 1).clip.frames, 121 / 0.8, 2);
  EXPECT_NEAR(restyle_with(std::log(1.25f), 1).clip.frames, 121 / 1.25, 2);
  EXPECT_NEAR(restyle_with(std::log(0.8f), 0.5f).clip.frames, 121 / std::sqrt(0.8), 2);
  RestyleOptions steady;
  steady.timing = false;
  EXPECT_EQ(restyle_with(std::log(0.8f), 1, steady).clip.frames, 121);
}

TEST(Restyle, an_option_out_of_its_range_is_rejected) {
  const Clip clip = test::walking_clip(3);
  RestyleOptions options;
  options.stylizer.ease_seconds = -1;
  const auto result = restyle(clip, *Rig::create(clip), model_with_rate(0), {}, options);
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().message,
            "stylizer option of -1.000000 seconds; expected 0 to 10 seconds");
}

TEST(Restyle, strength_zero_is_the_input_frame_by_frame) {
  const Clip clip = test::walking_clip(121, 60);
  const Restyled same = restyle_with(std::log(0.8f), 0);
  EXPECT_EQ(same.clip.frames, clip.frames);
  EXPECT_EQ(same.clip.rotations, clip.rotations);
  EXPECT_EQ(same.clip.translations, clip.translations);
  for (int f = 0; f < clip.frames; ++f) EXPECT_EQ(same.source_frames[f], f);
}

TEST(Restyle, every_frame_tells_how_far_its_motion_was_trusted) {
  const Clip clip = test::walking_clip(60);
  TensorFile file = test::make_model({"old"});
  const auto gates = [&] {
    const auto model = read(file);
    const Restyled result = *restyle(clip, *Rig::create(clip), model, {{0, {{0, 1.0f}}}});
    EXPECT_EQ(result.gates.size(), static_cast<size_t>(result.clip.frames));
    return result.gates;
  };
  for (const float gate : gates()) EXPECT_EQ(gate, 1);
  test::add_gate(file, 1e-3f);
  for (const float gate : gates()) EXPECT_LT(gate, 0.01f);
}

TEST(Restyle, a_track_is_straight_between_points_and_held_beyond) {
  const StrengthTrack track{0, {{1, 0}, {3, 1}, {4, 0.5f}}};
  EXPECT_EQ(track.at(0), 0);
  EXPECT_FLOAT_EQ(track.at(2), 0.5f);
  EXPECT_FLOAT_EQ(track.at(3.5), 0.75f);
  EXPECT_EQ(track.at(99), 0.5f);
}

TEST(Restyle, strength_zero_keeps_every_number_of_every_real_file) {
  const char* data = std::getenv("PANACHE_DATA");
  if (!data) GTEST_SKIP() << "PANACHE_DATA is not set: no real motion to read";
  const auto model = model_with_rate(std::log(0.8f));
  int files = 0;
  for (const char* folder : {"formats", "xia"}) {
    const std::filesystem::path root = std::filesystem::path(data) / folder;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(
             root, std::filesystem::directory_options::follow_directory_symlink)) {
      if (entry.path().extension() != ".bvh") continue;
      const auto file = read_motion(entry.path().string());
      ASSERT_TRUE(file.ok()) << file.error().message;
      const Clip& clip = (*file)->clip();
      const auto rig = Rig::create(clip);
      ASSERT_TRUE(rig.ok()) << entry.path() << rig.error().message;
      const auto same = restyle(clip, *rig, model, {{0, {{0, 0.0f}}}});
      ASSERT_TRUE(same.ok());
      std::vector<double> frames(clip.frames);
      for (int f = 0; f < clip.frames; ++f) frames[f] = f;
      EXPECT_EQ((*file)->encode(same->clip, same->source_frames), (*file)->encode(clip, frames))
          << entry.path();
      ++files;
    }
  }
  EXPECT_GT(files, 50);
}

}  // namespace
}  // namespace panache
