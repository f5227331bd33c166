// Training samples of clips.
#include "stick_api.h"

namespace {

using panache::test::created;
using panache::test::rejection;
using panache::test::Walk;

class SamplesApi : public panache::test::StickApi {};

auto create(const panache_pair& pair) {
  return [&](panache_samples** out) { return panache_samples_create(&pair, 1, out); };
}

TEST_F(SamplesApi, a_neutral_clip_gives_a_window_of_each_instant) {
  const Walk walk = clip(121);  // 2 s at 60 Hz.
  const auto owned = created<panache_samples>(create({walk.clip, {}}));
  const panache_samples* samples = owned.get();
  ASSERT_EQ(panache_samples_count(samples), 61);
  const float* windows = panache_samples_windows(samples);
  for (int i = 0; i < 63; ++i) EXPECT_EQ(windows[i], windows[66 + i]) << "before the first pose";
  const float* last = windows + 60 * PANACHE_WINDOW_SIZE;
  // It goes ahead; slower than the figure's 1.2 m/s, as the canonical body is smaller.
  EXPECT_NEAR(last[63], 0, 0.05);
  EXPECT_NEAR(last[64], 1.15, 0.05);
  // Three frames of 30 a second are two poses of 20 a second.
  const float* earlier = windows + 57 * PANACHE_WINDOW_SIZE;
  for (int i = 0; i < 66; ++i) EXPECT_EQ(last[2 * 66 + i], earlier[i]) << i;
  for (int i = 0; i < 61 * PANACHE_CHANGE_SIZE; ++i) {
    ASSERT_EQ(panache_samples_changes(samples)[i], 0) << i;
  }
  bool planted = false;
  for (int i = 0; i < 122; ++i) planted |= panache_samples_contacts(samples)[i] == 1;
  EXPECT_TRUE(planted);
}

TEST_F(SamplesApi, a_pair_shows_what_its_style_does) {
  const Walk walk = clip(150), bent = clip(150, true);  // By 0.4 rad at the spine.
  const auto owned = created<panache_samples>(create({walk.clip, bent.clip}));
  const panache_samples* samples = owned.get();
  const int32_t count = panache_samples_count(samples);
  ASSERT_GT(count, 30);
  for (int32_t s = 0; s < count; ++s) {
    const float* change = panache_samples_changes(samples) + s * PANACHE_CHANGE_SIZE;
    EXPECT_NEAR(change[3 * 1], 0.4f, 0.02) << "spine, about x";
    EXPECT_NEAR(change[3 * 13], 0, 0.1) << "leftUpperLeg";
    EXPECT_NEAR(panache_samples_log_rates(samples)[s], 0, 0.1);
    // Windows show the neutral walk, which goes ahead.
    const float* window = panache_samples_windows(samples) + s * PANACHE_WINDOW_SIZE;
    EXPECT_NEAR(window[64], 1.15f, 0.05) << s;
  }
  bool planted = false;
  for (int32_t i = 0; i < 2 * count; ++i) planted |= panache_samples_contacts(samples)[i] == 1;
  EXPECT_TRUE(planted);
}

TEST_F(SamplesApi, what_is_wrong_with_a_pair_is_said) {
  const Walk walk = clip(60), brief = clip(3, true);
  const auto message = [](const panache_pair& pair) {
    return rejection<panache_samples>(PANACHE_BAD_CLIP, create(pair));
  };
  EXPECT_EQ(message({walk.clip, brief.clip}).substr(0, 32), "pair 1, styled: has 0.05 s of mo");
  panache_clip empty = walk.clip;
  empty.frame_count = 0;
  EXPECT_EQ(message({empty, walk.clip}), "pair 1, neutral: has no frames");
  panache_clip unknown = walk.clip;
  unknown.translations = nullptr;
  EXPECT_EQ(message({unknown, walk.clip}),
            "pair 1, neutral: poses need both rotations and translations");
  EXPECT_EQ(message({walk.clip, unknown}),
            "pair 1, styled: poses need both rotations and translations");
}

}  // namespace
