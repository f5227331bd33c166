// A whole clip in one call, and the shape of a style.
#include "stick_api.h"

#include <cstddef>

namespace {

using panache::test::created;
using panache::test::Owned;
using panache::test::rejection;
using panache::test::Walk;

class ClipApi : public panache::test::StickApi {
 protected:
  using Keys = std::vector<panache_strength_key>;

  Owned<panache_styled_clip> styled_walk(const Walk& walk, const Keys& keys,
                                         const panache_stylize_options* options = nullptr) const {
    return stylize(walk.clip, "old", keys, options);
  }
  std::string message(panache_status status, const Walk& walk,
                      const panache_stylize_options& options) const {
    return rejection<panache_styled_clip>(status, [&](auto** out) {
      return panache_stylize_clip(model_.get(), &walk.clip, nullptr, 0, &options, out);
    });
  }
  static bool same_pose(const Owned<panache_styled_clip>& styled, int frame, const float* rotations,
                        const float* translations) {
    return std::memcmp(panache_styled_clip_rotations(styled.get()) + frame * 4 * STICK_JOINTS,
                       rotations, 4 * STICK_JOINTS * sizeof(float)) == 0 &&
           std::memcmp(panache_styled_clip_translations(styled.get()) + frame * 3 * STICK_JOINTS,
                       translations, 3 * STICK_JOINTS * sizeof(float)) == 0;
  }
  static bool same_pose(const Owned<panache_styled_clip>& styled, int frame, const Walk& walk) {
    return same_pose(styled, frame, &walk.rotations[static_cast<size_t>(4 * STICK_JOINTS * frame)],
                     &walk.translations[static_cast<size_t>(3 * STICK_JOINTS * frame)]);
  }
};

TEST_F(ClipApi, a_clip_without_a_style_stays_bit_for_bit) {
  const Walk walk = clip(90);
  const auto styled = styled_walk(walk, {{0, 0}});
  ASSERT_EQ(panache_styled_clip_frame_count(styled.get()), 90);
  for (int f = 0; f < 90; ++f) {
    EXPECT_TRUE(same_pose(styled, f, walk)) << f;
    EXPECT_EQ(panache_styled_clip_source_frames(styled.get())[f], f);
  }
  const auto without = created<panache_styled_clip>([&](auto** out) {
    return panache_stylize_clip(model_.get(), &walk.clip, nullptr, 0, nullptr, out);
  });
  EXPECT_TRUE(same_pose(without, 89, walk));
}

TEST_F(ClipApi, a_style_is_taken_off_by_a_remover_and_by_no_other_model) {
  const Walk walk = clip(90);
  const auto remover = panache::test::shipped_remover();
  panache_stylize_options options = PANACHE_STYLIZE_OPTIONS;
  options.remover = remover.get();
  options.removed = panache_model_find_style(remover.get(), "any");
  EXPECT_FALSE(same_pose(styled_walk(walk, {{0, 0}}, &options), 60, walk));
  options.removed = panache_model_style_count(remover.get());
  message(PANACHE_BAD_ARGUMENT, walk, options);
  options.remover = nullptr;
  message(PANACHE_BAD_ARGUMENT, walk, options);
  options.remover = model_.get();
  options.removed = 0;
  message(PANACHE_BAD_ARGUMENT, walk, options);
}

TEST_F(ClipApi, the_styles_of_a_clip_are_recognised) {
  const Walk walk = clip(90);
  const auto remover = panache::test::shipped_remover();
  const auto recognise = [&](const panache_model* model, std::vector<float>& shares) {
    return panache_recognise_styles(model, &walk.clip, shares.data(),
                                    static_cast<int32_t>(shares.size()));
  };
  std::vector<float> shares(static_cast<size_t>(panache_model_style_count(remover.get()) + 1)),
      of_styles(static_cast<size_t>(panache_model_style_count(model_.get()) + 1));
  EXPECT_EQ(recognise(remover.get(), shares), PANACHE_OK) << panache_last_error();
  float sum = 0;
  for (const float share : shares) sum += share;
  EXPECT_NEAR(sum, 1, 0.01);
  EXPECT_EQ(recognise(model_.get(), of_styles), PANACHE_BAD_MODEL);
  shares.pop_back();
  EXPECT_EQ(recognise(remover.get(), shares), PANACHE_BAD_ARGUMENT);
}

TEST_F(ClipApi, a_clip_gets_the_tempo_of_its_style_unless_timing_is_off) {
  const Walk walk = clip(240);
  const auto owned = styled_walk(walk, {{0, 1}});
  const panache_styled_clip* styled = owned.get();
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

  panache_stylize_options options = PANACHE_STYLIZE_OPTIONS;
  options.style_timing = 0;
  const auto in_time = styled_walk(walk, {{0, 1}}, &options);
  EXPECT_EQ(panache_styled_clip_frame_count(in_time.get()), 240);
  // Frame by frame it is what a character does live.
  const std::vector<stick_pose> live = StickApi::walk(character("old"), 240);
  EXPECT_TRUE(same_pose(in_time, 239, live[239].rotations[0], live[239].translations[0]));
}

TEST_F(ClipApi, a_loop_stays_one_unless_told_otherwise_or_asked_by_an_old_program) {
  const Walk strides = clip(201), part = clip(220);  // 3 and 3.3 strides.
  const auto is_loop = [&](const Walk& walk, const panache_stylize_options* options) {
    return panache_styled_clip_is_loop(styled_walk(walk, {{0, 1}}, options).get());
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
  options.loop = 2;
  const std::string no_loop = message(PANACHE_BAD_ARGUMENT, part, options);
  EXPECT_TRUE(no_loop.starts_with("the motion is not a loop: its last pose is ")) << no_loop;
  options.loop = 3;
  message(PANACHE_BAD_ARGUMENT, part, options);
}

TEST_F(ClipApi, strength_goes_along_its_keys) {
  const Walk walk = clip(180);
  panache_stylize_options options = PANACHE_STYLIZE_OPTIONS;
  options.style_timing = 0;
  const auto styled = styled_walk(walk, {{1, 0}, {2, 1}}, &options);
  EXPECT_TRUE(same_pose(styled, 59, walk));
  EXPECT_FALSE(same_pose(styled, 170, walk));
}

TEST_F(ClipApi, a_shape_of_nothing_is_the_input_and_a_region_is_its_own) {
  const Walk walk = clip(120);
  panache_shape shape = PANACHE_SHAPE;
  panache_stylize_options options = PANACHE_STYLIZE_OPTIONS;
  options.style_timing = 0;
  options.shape = &shape;
  shape.strength = 0;
  EXPECT_TRUE(same_pose(styled_walk(walk, {{0, 1}}, &options), 119, walk));

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
  const Walk walk = clip(30);
  const auto of_track = [&](int32_t style, Keys keys) {
    const panache_strength_track track = {style, static_cast<int32_t>(keys.size()), keys.data()};
    return rejection<panache_styled_clip>(PANACHE_BAD_ARGUMENT, [&](auto** out) {
      return panache_stylize_clip(model_.get(), &walk.clip, &track, 1, nullptr, out);
    });
  };
  EXPECT_EQ(of_track(300, {{0, 1}}), "track 0: there is no style 300; the model has " +
                                         std::to_string(panache_model_style_count(model_.get())));
  EXPECT_EQ(of_track(0, {}), "track 0: expected at least one key, found none");
  EXPECT_EQ(of_track(0, {{1, 1}, {1, 0}}), "track 0: key 1: is not later than the one before it");
  EXPECT_EQ(of_track(0, {{0, NAN}}), "track 0: key 0: is not finite");
  for (const int32_t tracks : {-1, 1}) {
    EXPECT_EQ(rejection<panache_styled_clip>(PANACHE_BAD_ARGUMENT,
                                             [&](auto** out) {
                                               return panache_stylize_clip(model_.get(), &walk.clip,
                                                                           nullptr, tracks, nullptr,
                                                                           out);
                                             }),
              std::to_string(tracks) + " tracks; expected an array of 0 or more");
  }

  constexpr struct {
    const char* message;
    void (*change)(Walk&);
  } kClips[] = {
      {"has no frames", [](Walk& w) { w.clip.frame_count = 0; }},
      {"has -1 frames; expected up to 1000000", [](Walk& w) { w.clip.frame_count = -1; }},
      {"has 1000001 frames; expected up to 1000000",
       [](Walk& w) { w.clip.frame_count = 1'000'001; }},
      {"has frames 1.500000 seconds apart; expected more than 0 and at most 1",
       [](Walk& w) { w.clip.frame_seconds = 1.5; }},
      {"has frames 0.000000 seconds apart; expected more than 0 and at most 1",
       [](Walk& w) { w.clip.frame_seconds = 0; }},
      {"pose 2, joint 5: its translation is not finite",
       [](Walk& w) { w.translations[3 * (2 * STICK_JOINTS + 5)] = INFINITY; }},
      {"pose 1, joint 7: its rotation is not a unit quaternion (x, y, z, w)",
       [](Walk& w) { w.rotations[4 * (STICK_JOINTS + 7) + 3] = 2; }},
      {"poses need both rotations and translations",
       [](Walk& w) { w.clip.translations = nullptr; }},
  };
  for (const auto& row : kClips) {
    Walk bad = clip(3);
    row.change(bad);
    EXPECT_EQ(message(PANACHE_BAD_CLIP, bad, PANACHE_STYLIZE_OPTIONS),
              "clip: " + std::string(row.message));
  }
}

}  // namespace
