// A whole clip in one call, and the shape of a style.
#include "stick_api.h"

#include <cstddef>

namespace {

using panache::test::Walk;

class ClipApi : public panache::test::StickApi {
 protected:
  // Styles a walk with one style; null where that fails.
  panache_styled_clip* stylize(const Walk& walk, std::vector<panache_strength_key> keys,
                               const panache_stylize_options* options = nullptr) const {
    const panache_strength_track track = {panache_model_find_style(model_, "old"),
                                          static_cast<int32_t>(keys.size()), keys.data()};
    panache_styled_clip* out = nullptr;
    EXPECT_EQ(panache_stylize_clip(model_, &walk.clip, &track, 1, options, &out), PANACHE_OK)
        << panache_last_error();
    return out;
  }
  static bool same_pose(const panache_styled_clip* styled, int frame, const Walk& walk, int other) {
    return std::memcmp(panache_styled_clip_rotations(styled) + frame * 4 * STICK_JOINTS,
                       walk.rotations.data() + other * 4 * STICK_JOINTS,
                       4 * STICK_JOINTS * sizeof(float)) == 0 &&
           std::memcmp(panache_styled_clip_translations(styled) + frame * 3 * STICK_JOINTS,
                       walk.translations.data() + other * 3 * STICK_JOINTS,
                       3 * STICK_JOINTS * sizeof(float)) == 0;
  }
};

TEST_F(ClipApi, a_clip_without_a_style_stays_bit_for_bit) {
  const Walk walk(skeleton_, 90, false);
  panache_styled_clip* styled = stylize(walk, {{0, 0}});
  ASSERT_EQ(panache_styled_clip_frame_count(styled), 90);
  for (int f = 0; f < 90; ++f) {
    EXPECT_TRUE(same_pose(styled, f, walk, f)) << f;
    EXPECT_EQ(panache_styled_clip_source_frames(styled)[f], f);
  }
  panache_styled_clip_destroy(styled);
  styled = nullptr;
  ASSERT_EQ(panache_stylize_clip(model_, &walk.clip, nullptr, 0, nullptr, &styled), PANACHE_OK)
      << panache_last_error();
  EXPECT_TRUE(same_pose(styled, 89, walk, 89));
  panache_styled_clip_destroy(styled);
}

// The shipped remover; null where it cannot be read.
panache_model* read_remover() {
  const std::string bytes = panache::test::file_bytes("remover-int8.safetensors");
  panache_model* remover = nullptr;
  EXPECT_EQ(panache_model_create(bytes.data(), bytes.size(), &remover), PANACHE_OK)
      << panache_last_error();
  return remover;
}

TEST_F(ClipApi, a_style_is_taken_off_by_a_remover_and_by_no_other_model) {
  const Walk walk(skeleton_, 90, false);
  panache_model* remover = read_remover();
  panache_stylize_options options = PANACHE_STYLIZE_OPTIONS;
  options.remover = remover;
  options.removed = panache_model_find_style(remover, "any");
  panache_styled_clip* styled = stylize(walk, {{0, 0}}, &options);
  EXPECT_FALSE(same_pose(styled, 60, walk, 60));
  panache_styled_clip_destroy(styled);
  options.removed = panache_model_style_count(remover);
  EXPECT_EQ(panache_stylize_clip(model_, &walk.clip, nullptr, 0, &options, &styled),
            PANACHE_BAD_ARGUMENT);
  options.remover = nullptr;
  EXPECT_EQ(panache_stylize_clip(model_, &walk.clip, nullptr, 0, &options, &styled),
            PANACHE_BAD_ARGUMENT);
  options.remover = model_;
  options.removed = 0;
  EXPECT_EQ(panache_stylize_clip(model_, &walk.clip, nullptr, 0, &options, &styled),
            PANACHE_BAD_ARGUMENT);
  panache_model_destroy(remover);
}

TEST_F(ClipApi, the_styles_of_a_clip_are_recognised) {
  const Walk walk(skeleton_, 90, false);
  panache_model* remover = read_remover();
  const int32_t count = panache_model_style_count(remover) + 1;
  std::vector<float> shares(static_cast<size_t>(count));
  EXPECT_EQ(panache_recognise_styles(remover, &walk.clip, shares.data(), count), PANACHE_OK)
      << panache_last_error();
  float sum = 0;
  for (const float share : shares) sum += share;
  EXPECT_NEAR(sum, 1, 0.01);
  EXPECT_EQ(panache_recognise_styles(remover, &walk.clip, shares.data(), count - 1),
            PANACHE_BAD_ARGUMENT);
  EXPECT_EQ(panache_recognise_styles(model_, &walk.clip, shares.data(),
                                     panache_model_style_count(model_) + 1),
            PANACHE_BAD_MODEL);
  panache_model_destroy(remover);
}

TEST_F(ClipApi, a_clip_gets_the_tempo_of_its_style_unless_timing_is_off) {
  const Walk walk(skeleton_, 240, false);
  panache_styled_clip* styled = stylize(walk, {{0, 1}});
  const int frames = panache_styled_clip_frame_count(styled);
  EXPECT_NE(frames, 240);
  double last = -1;
  bool planted = false;
  for (int f = 0; f < frames; ++f) {
    EXPECT_GT(panache_styled_clip_source_frames(styled)[f], last);
    last = panache_styled_clip_source_frames(styled)[f];
    EXPECT_GE(panache_styled_clip_gates(styled)[f], 0);
    EXPECT_LE(panache_styled_clip_gates(styled)[f], 1);
    for (int foot = 0; foot < 2; ++foot) {
      EXPECT_LE(panache_styled_clip_contacts(styled)[2 * f + foot], 1);
      planted |= panache_styled_clip_contacts(styled)[2 * f + foot] == 1;
    }
  }
  EXPECT_LE(last, 239.001);
  EXPECT_TRUE(planted);
  panache_styled_clip_destroy(styled);

  panache_stylize_options options = PANACHE_STYLIZE_OPTIONS;
  options.style_timing = 0;
  panache_styled_clip* in_time = stylize(walk, {{0, 1}}, &options);
  EXPECT_EQ(panache_styled_clip_frame_count(in_time), 240);
  // Frame by frame it is what a character does live.
  panache_character* live = character("old");
  const std::vector<stick_pose> stepped = StickApi::walk(live, 240);
  EXPECT_EQ(std::memcmp(panache_styled_clip_rotations(in_time) + 239 * 4 * STICK_JOINTS,
                        stepped[239].rotations, sizeof stepped[239].rotations),
            0);
  EXPECT_EQ(std::memcmp(panache_styled_clip_translations(in_time) + 239 * 3 * STICK_JOINTS,
                        stepped[239].translations, sizeof stepped[239].translations),
            0);
  panache_styled_clip_destroy(in_time);
}

TEST_F(ClipApi, a_loop_stays_one_unless_told_otherwise_or_asked_by_an_old_program) {
  const Walk strides(skeleton_, 201, false), part(skeleton_, 220, false);  // 3 and 3.3 strides.
  const auto is_loop = [&](const Walk& walk, const panache_stylize_options* options) {
    panache_styled_clip* styled = stylize(walk, {{0, 1}}, options);
    const int32_t loop = panache_styled_clip_is_loop(styled);
    panache_styled_clip_destroy(styled);
    return loop;
  };
  panache_stylize_options options = PANACHE_STYLIZE_OPTIONS;
  EXPECT_EQ(is_loop(strides, nullptr), 1);
  EXPECT_EQ(is_loop(strides, &options), 1);
  EXPECT_EQ(is_loop(part, &options), 0);
  options.struct_size = offsetof(panache_stylize_options, loop);
  EXPECT_EQ(is_loop(strides, &options), 0);
  options = PANACHE_STYLIZE_OPTIONS;
  options.loop = 0;
  EXPECT_EQ(is_loop(strides, &options), 0);
  const panache_strength_key key = {0, 1};
  const panache_strength_track track = {0, 1, &key};
  panache_styled_clip* none = nullptr;
  options.loop = 2;
  EXPECT_EQ(panache_stylize_clip(model_, &part.clip, &track, 1, &options, &none),
            PANACHE_BAD_ARGUMENT);
  EXPECT_EQ(std::string(panache_last_error()).find("the motion is not a loop: its last pose is "),
            0u)
      << panache_last_error();
  options.loop = 3;
  EXPECT_EQ(panache_stylize_clip(model_, &part.clip, &track, 1, &options, &none),
            PANACHE_BAD_ARGUMENT);
  EXPECT_EQ(none, nullptr);
}

TEST_F(ClipApi, strength_goes_along_its_keys) {
  const Walk walk(skeleton_, 180, false);
  panache_stylize_options options = PANACHE_STYLIZE_OPTIONS;
  options.style_timing = 0;
  panache_styled_clip* styled = stylize(walk, {{1, 0}, {2, 1}}, &options);
  EXPECT_TRUE(same_pose(styled, 59, walk, 59));
  EXPECT_FALSE(same_pose(styled, 170, walk, 170));
  panache_styled_clip_destroy(styled);
}

TEST_F(ClipApi, a_shape_of_nothing_is_the_input_and_a_region_is_its_own) {
  const Walk walk(skeleton_, 120, false);
  panache_shape shape = PANACHE_SHAPE;
  panache_stylize_options options = PANACHE_STYLIZE_OPTIONS;
  options.style_timing = 0;
  options.shape = &shape;
  shape.strength = 0;
  panache_styled_clip* nothing = stylize(walk, {{0, 1}}, &options);
  EXPECT_TRUE(same_pose(nothing, 119, walk, 119));
  panache_styled_clip_destroy(nothing);

  // The same on a character, which is stepped.
  panache_character* shaped = character("old");
  shape = PANACHE_SHAPE;
  shape.left_arm = 0;
  ASSERT_EQ(panache_character_set_shape(shaped, &shape), PANACHE_OK);
  panache_character* whole = character("old");
  const std::vector<stick_pose> with = StickApi::walk(whole, 120),
                                without = StickApi::walk(shaped, 120);
  const auto turned = [&](int joint, const stick_pose& pose) {
    stick_pose input;
    stick_walk(119 / 60.0, 0, &input);
    double dot = 0;
    for (int k = 0; k < 4; ++k) {
      dot += double(pose.rotations[joint][k]) * input.rotations[joint][k];
    }
    return 2 * std::acos(std::min(1.0, std::abs(dot)));
  };
  // Float rotations are apart by rounding: half a milliradian through acos near 1.
  EXPECT_LT(turned(6, without[119]), 1e-3);
  EXPECT_GT(turned(6, with[119]), 0.02);
  EXPECT_GT(turned(9, without[119]), 0.02);  // The right arm has its style.

  // NULL: all of it again.
  ASSERT_EQ(panache_character_set_shape(shaped, nullptr), PANACHE_OK);
  panache_character_reset(shaped);
  panache_character_reset(whole);
  StickApi::walk(shaped, 300), StickApi::walk(whole, 300);
  EXPECT_TRUE(same(StickApi::walk(shaped, 10), StickApi::walk(whole, 10)));
}

TEST_F(ClipApi, what_is_wrong_with_tracks_and_clips_is_said) {
  const Walk walk(skeleton_, 30, false);
  const auto rejection = [&](panache_status expected, const panache_clip& clip,
                             std::vector<panache_strength_key> keys, int32_t style) {
    const panache_strength_track track = {style, static_cast<int32_t>(keys.size()), keys.data()};
    panache_styled_clip* none = nullptr;
    EXPECT_EQ(panache_stylize_clip(model_, &clip, &track, 1, nullptr, &none), expected);
    EXPECT_EQ(none, nullptr);
    return std::string(panache_last_error());
  };
  const std::string count = std::to_string(panache_model_style_count(model_));
  EXPECT_EQ(rejection(PANACHE_BAD_ARGUMENT, walk.clip, {{0, 1}}, 300),
            "track 0: there is no style 300; the model has " + count);
  EXPECT_EQ(rejection(PANACHE_BAD_ARGUMENT, walk.clip, {}, 0),
            "track 0: expected at least one key, found none");
  EXPECT_EQ(rejection(PANACHE_BAD_ARGUMENT, walk.clip, {{1, 1}, {1, 0}}, 0),
            "track 0: key 1: is not later than the one before it");
  EXPECT_EQ(rejection(PANACHE_BAD_ARGUMENT, walk.clip, {{0, NAN}}, 0),
            "track 0: key 0: is not finite");
  for (const int32_t tracks : {-1, 1}) {
    panache_styled_clip* none = nullptr;
    EXPECT_EQ(panache_stylize_clip(model_, &walk.clip, nullptr, tracks, nullptr, &none),
              PANACHE_BAD_ARGUMENT);
    EXPECT_EQ(panache_last_error(),
              std::to_string(tracks) + " tracks; expected an array of 0 or more");
  }
  panache_clip clip = walk.clip;
  clip.frame_count = 0;
  EXPECT_EQ(rejection(PANACHE_BAD_CLIP, clip, {{0, 1}}, 0), "clip: has no frames");
  for (const int32_t frames : {-1, 1'000'001}) {
    clip.frame_count = frames;
    EXPECT_EQ(rejection(PANACHE_BAD_CLIP, clip, {{0, 1}}, 0),
              "clip: has " + std::to_string(frames) + " frames; expected up to 1000000");
  }
  clip = walk.clip;
  clip.frame_seconds = 1.5;
  EXPECT_EQ(rejection(PANACHE_BAD_CLIP, clip, {{0, 1}}, 0),
            "clip: has frames 1.500000 seconds apart; expected more than 0 and at most 1");
  clip.frame_seconds = 0;
  EXPECT_EQ(rejection(PANACHE_BAD_CLIP, clip, {{0, 1}}, 0),
            "clip: has frames 0.000000 seconds apart; expected more than 0 and at most 1");
  Walk bad(skeleton_, 3, false);
  bad.translations[3 * (2 * STICK_JOINTS + 5)] = INFINITY;
  EXPECT_EQ(rejection(PANACHE_BAD_CLIP, bad.clip, {{0, 1}}, 0),
            "clip: pose 2, joint 5: its translation is not finite");
  bad.rotations[4 * (STICK_JOINTS + 7) + 3] = 2;
  EXPECT_EQ(rejection(PANACHE_BAD_CLIP, bad.clip, {{0, 1}}, 0),
            "clip: pose 1, joint 7: its rotation is not a unit quaternion (x, y, z, w)");
  bad.clip.translations = nullptr;
  EXPECT_EQ(rejection(PANACHE_BAD_CLIP, bad.clip, {{0, 1}}, 0),
            "clip: poses need both rotations and translations");
}

}  // namespace
