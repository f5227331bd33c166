// A clip on another skeleton.
#include "stick_api.h"

namespace {

using panache::test::Walk;

class RetargetApi : public panache::test::StickApi {
 protected:
  static panache_skeleton* figure(float size) {
    std::vector<panache_joint> joints(stick_figure, stick_figure + STICK_JOINTS);
    for (panache_joint& joint : joints) {
      for (float& x : joint.translation) x *= size;
    }
    panache_skeleton* out = nullptr;
    EXPECT_EQ(panache_skeleton_create(joints.data(), STICK_JOINTS, nullptr, &out), PANACHE_OK)
        << panache_last_error();
    return out;
  }
  static panache_styled_clip* put(const Walk& walk, const panache_skeleton* onto) {
    panache_styled_clip* out = nullptr;
    EXPECT_EQ(panache_retarget_clip(&walk.clip, onto, nullptr, &out), PANACHE_OK)
        << panache_last_error();
    return out;
  }
};

TEST_F(RetargetApi, a_larger_figure_goes_further) {
  const Walk walk(skeleton_, 90, false);
  panache_skeleton* twice = figure(2);
  panache_styled_clip* same = put(walk, skeleton_);
  panache_styled_clip* large = put(walk, twice);
  ASSERT_EQ(panache_styled_clip_frame_count(same), 90);
  ASSERT_EQ(panache_styled_clip_frame_count(large), 90);
  const float* a = panache_styled_clip_translations(same);
  const float* b = panache_styled_clip_translations(large);
  float far = 0;
  bool planted = false;
  for (int f = 0; f < 90; ++f) {
    for (int k = 0; k < 3; ++k) {
      const int at = 3 * STICK_JOINTS * f + k;
      EXPECT_NEAR(b[at], 2 * a[at], 2e-3f) << f;
      far = std::max(far, std::abs(a[at] - a[k]));
    }
    EXPECT_EQ(panache_styled_clip_source_frames(large)[f], f);
    EXPECT_EQ(panache_styled_clip_gates(large)[f], 1);
    planted |= panache_styled_clip_contacts(large)[2 * f] == 1;
  }
  EXPECT_GT(far, 0.2f);
  EXPECT_TRUE(planted);
  panache_styled_clip_destroy(same);
  panache_styled_clip_destroy(large);
  panache_skeleton_destroy(twice);
}

TEST_F(RetargetApi, bad_options_and_clips_are_rejected) {
  const Walk walk(skeleton_, 10, false);
  panache_styled_clip* out = nullptr;
  panache_retarget_options options = {};
  EXPECT_EQ(panache_retarget_clip(&walk.clip, skeleton_, &options, &out), PANACHE_BAD_ARGUMENT);
  EXPECT_STREQ(panache_last_error(),
               "panache_retarget_options: its struct_size is 0, expected "
               "sizeof(panache_retarget_options)");
  EXPECT_EQ(out, nullptr);
  panache_clip empty = walk.clip;
  empty.frame_count = 0;
  EXPECT_EQ(panache_retarget_clip(&empty, skeleton_, nullptr, &out), PANACHE_BAD_CLIP);
  EXPECT_STREQ(panache_last_error(), "clip: has no frames");
}

}  // namespace
