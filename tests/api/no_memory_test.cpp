// What the C interface does where there is no memory: it says so, and its host lives on.
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "../../samples/common/stick_figure.h"
#include "../count_allocations.h"
#include "panache/panache.h"

namespace {

using panache::test::allocations_left;

constexpr const char* kNoMemory = "out of memory";

// Calls `work` while no more than `count` allocations succeed.
template <class Work>
panache_status with_allocations(long count, Work&& work) {
  allocations_left = count;
  const panache_status status = work();
  allocations_left = LONG_MAX;
  return status;
}

std::string model_bytes() {
  std::ifstream file(PANACHE_SOURCE_DIR "/models/panache.safetensors", std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
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

}  // namespace
