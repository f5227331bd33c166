// What the C interface does where there is no memory: it says so, and its host lives on.
#include <cstdio>
#include <string>
#include <vector>

#include "../count_allocations.h"
#include "stick_api.h"

namespace {

using panache::test::allocations_left;
using panache::test::model_bytes;

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

// A walk of the stick figure, `lean` radians forward above the hips.
struct Walk {
  static constexpr int kFrames = 180;
  std::vector<float> rotations, translations;
  explicit Walk(float lean) {
    for (int f = 0; f < kFrames; ++f) {
      stick_pose pose;
      stick_walk(f / 60.0, 0, &pose);
      stick_bend(&pose, 1, lean);
      const panache_input_pose in = stick_input(&pose);
      rotations.insert(rotations.end(), in.rotations, in.rotations + 4 * STICK_JOINTS);
      translations.insert(translations.end(), in.translations, in.translations + 3 * STICK_JOINTS);
    }
  }
  panache_clip clip(const panache_skeleton* skeleton) const {
    return {skeleton, kFrames, 1 / 60.0, rotations.data(), translations.data()};
  }
};

TEST(NoMemory, learning_says_so_in_any_of_its_threads_and_does_not_end_its_host) {
  const std::string bytes = model_bytes();
  panache_skeleton* skeleton = nullptr;
  ASSERT_EQ(panache_skeleton_create(stick_figure, STICK_JOINTS, nullptr, &skeleton), PANACHE_OK);
  const Walk neutral(0), bent(0.4f);
  const panache_pair pair = {neutral.clip(skeleton), bent.clip(skeleton)};
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
  panache_skeleton_destroy(skeleton);
}

// Each allocation of a call fails once, or each `step`-th where there are many. The call puts what
// it makes into `made`, which `destroy` takes back; the first one without a failure succeeds.
template <class Made, class Call, class Destroy>
void starve(const char* name, Call&& call, Destroy&& destroy, long step = 1) {
  SCOPED_TRACE(name);
  long allowed = 0, failed = 0;
  for (;; allowed += step, ++failed) {
    Made* made = nullptr;
    leave_another_error();
    const panache_status status = with_allocations(allowed, [&] { return call(&made); });
    if (status == PANACHE_OK) {
      EXPECT_NE(made, nullptr);
      destroy(made);
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
std::string with_style_alone(const void* data, size_t size, const std::string& style) {
  std::string bytes(static_cast<const char*>(data), size);
  panache_model* model = nullptr;
  EXPECT_EQ(panache_model_create(bytes.data(), bytes.size(), &model), PANACHE_OK);
  for (int i = 0; i < panache_model_style_count(model); ++i) {
    const char* name = panache_model_style_name(model, i);
    if (name == style) continue;
    panache_bytes* rest = nullptr;
    EXPECT_EQ(panache_styles_remove(bytes.data(), bytes.size(), name, &rest), PANACHE_OK)
        << panache_last_error();
    bytes.assign(static_cast<const char*>(panache_bytes_data(rest)), panache_bytes_size(rest));
    panache_bytes_destroy(rest);
  }
  panache_model_destroy(model);
  return bytes;
}

class Starved : public panache::test::StickApi {};

TEST_F(Starved, models_and_styles_say_so_at_every_allocation) {
  constexpr long kStep = 5;
  const std::string shipped = panache::test::model_bytes();
  const Walk neutral(0), bent(0.4f);
  const panache_pair pair = {neutral.clip(skeleton_), bent.clip(skeleton_)};
  panache_learnt* learnt = nullptr;
  ASSERT_EQ(panache_learn(shipped.data(), shipped.size(), &pair, 1, "bent", 0, &learnt), PANACHE_OK)
      << panache_last_error();
  size_t learnt_size = 0;
  const void* learnt_model = panache_learnt_model(learnt, &learnt_size);
  const std::string bytes = with_style_alone(learnt_model, learnt_size, "bent");
  const void* model = bytes.data();
  const size_t size = bytes.size();
  starve<panache_model>(
      "panache_model_create", [&](auto** out) { return panache_model_create(model, size, out); },
      panache_model_destroy, kStep);
  panache_bytes* style = nullptr;
  ASSERT_EQ(panache_styles_extract(model, size, "bent", &style), PANACHE_OK);
  starve<panache_bytes>(
      "panache_styles_extract",
      [&](auto** out) { return panache_styles_extract(model, size, "bent", out); },
      panache_bytes_destroy, kStep);
  starve<panache_bytes>(
      "panache_styles_add",
      [&](auto** out) {
        return panache_styles_add(model, size, panache_bytes_data(style), panache_bytes_size(style),
                                  1, out);
      },
      panache_bytes_destroy, kStep);
  panache_bytes_destroy(style);
  panache_learnt_destroy(learnt);
}

TEST_F(Starved, skeletons_characters_and_clips_say_so_at_every_allocation) {
  starve<panache_skeleton>(
      "panache_skeleton_create",
      [&](auto** out) { return panache_skeleton_create(stick_figure, STICK_JOINTS, nullptr, out); },
      panache_skeleton_destroy);
  panache_character_options options = PANACHE_CHARACTER_OPTIONS;
  options.max_lag = 1;
  options.max_lead = 0.1;
  options.skip_cycles = 1;
  starve<panache_character>(
      "panache_character_create",
      [&](auto** out) { return panache_character_create(model_, skeleton_, &options, out); },
      panache_character_destroy);
  const Walk walk(0);
  const panache_clip clip = walk.clip(skeleton_);
  const panache_strength_key key = {0, 1};
  const panache_strength_track track = {panache_model_find_style(model_, "old"), 1, &key};
  starve<panache_styled_clip>(
      "panache_stylize_clip",
      [&](auto** out) { return panache_stylize_clip(model_, &clip, &track, 1, nullptr, out); },
      panache_styled_clip_destroy);
  starve<panache_styled_clip>(
      "panache_retarget_clip",
      [&](auto** out) { return panache_retarget_clip(&clip, skeleton_, nullptr, out); },
      panache_styled_clip_destroy);
  const panache_pair pair = {clip, clip};
  starve<panache_samples>(
      "panache_samples_create", [&](auto** out) { return panache_samples_create(&pair, 1, out); },
      panache_samples_destroy);
}

TEST_F(Starved, motion_files_say_so_at_every_allocation) {
  const std::string bytes = panache::test::walk_bvh(20);
  starve<panache_motion_file>(
      "panache_motion_file_create",
      [&](auto** out) {
        return panache_motion_file_create(bytes.data(), bytes.size(), "walk.bvh", out);
      },
      panache_motion_file_destroy);
  panache_motion_file* file = nullptr;
  ASSERT_EQ(panache_motion_file_create(bytes.data(), bytes.size(), "walk.bvh", &file), PANACHE_OK);
  starve<panache_skeleton>(
      "panache_motion_file_create_skeleton",
      [&](auto** out) { return panache_motion_file_create_skeleton(file, 0, nullptr, out); },
      panache_skeleton_destroy);
  panache_clip_edit edit{};
  ASSERT_EQ(panache_motion_file_get_clip(file, 0, &edit.frames), PANACHE_OK);
  starve<panache_bytes>(
      "panache_motion_file_write",
      [&](auto** out) { return panache_motion_file_write(file, &edit, 1, PANACHE_REPLACE, out); },
      panache_bytes_destroy);
  panache_motion_file_destroy(file);
}

}  // namespace
