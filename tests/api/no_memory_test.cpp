// What the C interface does where there is no memory: it says so, and its host lives on.
#include <cstdio>
#include <string>

#include "../count_allocations.h"
#include "stick_api.h"

namespace {

using panache::test::allocations_left;
using panache::test::created;
using panache::test::model_bytes;
using panache::test::model_of;
using panache::test::text_of;
using panache::test::Walk;

constexpr const char* kNoMemory = "out of memory";

// Calls `work` while no more than `count` allocations succeed.
template <class Work>
panache_status with_allocations(long count, Work&& work) {
  allocations_left = count;
  const panache_status status = work();
  allocations_left = LONG_MAX;
  return status;
}

void leave_another_error() {
  panache_model* none = nullptr;
  ASSERT_EQ(panache_model_create("no model", 8, &none), PANACHE_BAD_MODEL);
  ASSERT_STRNE(panache_last_error(), kNoMemory);
}

TEST(NoMemory, is_what_the_last_error_says_whatever_was_thrown) {
  const std::string bytes = model_bytes();
  const auto usual = panache::test::out_of_memory.load();
  for (const auto failure : {usual, +[] { throw 1; }}) {
    leave_another_error();
    panache::test::out_of_memory = failure;
    panache_model* model = nullptr;
    EXPECT_EQ(with_allocations(
                  0, [&] { return panache_model_create(bytes.data(), bytes.size(), &model); }),
              PANACHE_NO_MEMORY);
    panache::test::out_of_memory = usual;
    EXPECT_EQ(model, nullptr);
    EXPECT_STREQ(panache_last_error(), kNoMemory);
  }
}

class Starved : public panache::test::StickApi {};

TEST_F(Starved, learning_says_so_in_any_of_its_threads_and_does_not_end_its_host) {
  const std::string bytes = model_bytes();
  const Walk neutral = clip(180), bent = clip(180, true);
  const panache_pair pair = {neutral.clip, bent.clip};
  panache_learnt* learnt = nullptr;
  const auto learn = [&] {
    return panache_learn(bytes.data(), bytes.size(), &pair, 1, "bent", 0, &learnt);
  };
  allocations_left = LONG_MAX;
  ASSERT_EQ(learn(), PANACHE_OK) << panache_last_error();
  const long needed = LONG_MAX - allocations_left;
  panache_learnt_destroy(learnt);
  // Learning takes part of a second, so not every one of its allocations has its turn.
  constexpr int kTimes = 12;
  for (int i = 0; i < kTimes; ++i) {
    leave_another_error();
    const long allowed = needed / kTimes * i;
    EXPECT_EQ(with_allocations(allowed, learn), PANACHE_NO_MEMORY) << allowed << " of " << needed;
    EXPECT_EQ(learnt, nullptr);
    EXPECT_STREQ(panache_last_error(), kNoMemory);
  }
}

// Each allocation of a call fails once, or each `step`-th where there are many; the first call
// without a failure succeeds.
template <class Made, class Call>
void starve(const char* name, Call&& call, long step = 1) {
  SCOPED_TRACE(name);
  long allowed = 0, failed = 0;
  for (;; allowed += step, ++failed) {
    Made* made = nullptr;
    leave_another_error();
    const panache_status status = with_allocations(allowed, [&] { return call(&made); });
    if (status == PANACHE_OK) {
      EXPECT_NE(made, nullptr);
      panache::test::Destroy()(made);
      break;
    }
    ASSERT_EQ(status, PANACHE_NO_MEMORY) << allowed << " allocations: " << panache_last_error();
    ASSERT_EQ(made, nullptr) << allowed;
    ASSERT_STREQ(panache_last_error(), kNoMemory) << allowed;
  }
  EXPECT_GT(failed, 0);
  std::printf("%s: %ld allocations failed\n", name, failed);
}

// A model of which nothing but one style is left: each call is repeated once per allocation, and
// each style costs some.
std::string with_style_alone(std::string bytes, const std::string& style) {
  const auto model = model_of(bytes);
  for (int i = 0; i < panache_model_style_count(model.get()); ++i) {
    const char* name = panache_model_style_name(model.get(), i);
    if (name == style) continue;
    bytes = text_of(created<panache_bytes>(
        [&](auto** out) { return panache_styles_remove(bytes.data(), bytes.size(), name, out); }));
  }
  return bytes;
}

TEST_F(Starved, models_and_styles_say_so_at_every_allocation) {
  constexpr long kStep = 5;
  const std::string shipped = model_bytes();
  const Walk neutral = clip(180), bent = clip(180, true);
  const panache_pair pair = {neutral.clip, bent.clip};
  const std::string bytes = with_style_alone(text_of(created<panache_learnt>([&](auto** out) {
                                               return panache_learn(shipped.data(), shipped.size(),
                                                                    &pair, 1, "bent", 0, out);
                                             })),
                                             "bent");
  const void* model = bytes.data();
  const size_t size = bytes.size();
  starve<panache_model>(
      "panache_model_create", [&](auto** out) { return panache_model_create(model, size, out); },
      kStep);
  const auto extract = [&](auto** out) { return panache_styles_extract(model, size, "bent", out); };
  starve<panache_bytes>("panache_styles_extract", extract, kStep);
  const std::string style = text_of(created<panache_bytes>(extract));
  starve<panache_bytes>(
      "panache_styles_add",
      [&](auto** out) {
        return panache_styles_add(model, size, style.data(), style.size(), 1, out);
      },
      kStep);
}

TEST_F(Starved, skeletons_characters_and_clips_say_so_at_every_allocation) {
  const panache_model* model = model_.get();
  const panache_skeleton* skeleton = skeleton_.get();
  starve<panache_skeleton>("panache_skeleton_create", [&](auto** out) {
    return panache_skeleton_create(stick_figure, STICK_JOINTS, nullptr, out);
  });
  panache_character_options options = PANACHE_CHARACTER_OPTIONS;
  options.max_lag = 1;
  options.max_lead = 0.1;
  options.skip_cycles = 1;
  starve<panache_character>("panache_character_create", [&](auto** out) {
    return panache_character_create(model, skeleton, &options, out);
  });
  const Walk walk = clip(180);
  const panache_strength_key key = {0, 1};
  const panache_strength_track track = {style_of("old"), 1, &key};
  starve<panache_styled_clip>("panache_stylize_clip", [&](auto** out) {
    return panache_stylize_clip(model, &walk.clip, &track, 1, nullptr, out);
  });
  starve<panache_styled_clip>("panache_retarget_clip", [&](auto** out) {
    return panache_retarget_clip(&walk.clip, skeleton, nullptr, out);
  });
  const panache_pair pair = {walk.clip, walk.clip};
  starve<panache_samples>("panache_samples_create",
                          [&](auto** out) { return panache_samples_create(&pair, 1, out); });
}

TEST_F(Starved, motion_files_say_so_at_every_allocation) {
  const std::string bytes = panache::test::walk_bvh(20);
  const auto create = [&](auto** out) {
    return panache_motion_file_create(bytes.data(), bytes.size(), "walk.bvh", out);
  };
  starve<panache_motion_file>("panache_motion_file_create", create);
  const auto file = created<panache_motion_file>(create);
  starve<panache_skeleton>("panache_motion_file_create_skeleton", [&](auto** out) {
    return panache_motion_file_create_skeleton(file.get(), 0, nullptr, out);
  });
  panache_clip_edit edit{};
  ASSERT_EQ(panache_motion_file_get_clip(file.get(), 0, &edit.frames), PANACHE_OK);
  starve<panache_bytes>("panache_motion_file_write", [&](auto** out) {
    return panache_motion_file_write(file.get(), &edit, 1, PANACHE_REPLACE, out);
  });
}

}  // namespace
