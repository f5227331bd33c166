#pragma once
// The shipped model and the samples' stick figure, for tests of the C interface.

#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "../../samples/common/stick_figure.h"

namespace panache::test {

inline std::string model_bytes() {
  std::ifstream file(PANACHE_SOURCE_DIR "/models/panache.safetensors", std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

class StickApi : public testing::Test {
 protected:
  void SetUp() override {
    const std::string bytes = model_bytes();
    ASSERT_EQ(panache_model_create(bytes.data(), bytes.size(), &model_), PANACHE_OK)
        << panache_last_error();
    ASSERT_EQ(panache_skeleton_create(stick_figure, STICK_JOINTS, nullptr, &skeleton_), PANACHE_OK)
        << panache_last_error();
  }
  void TearDown() override {
    panache_skeleton_destroy(skeleton_);
    panache_model_destroy(model_);
  }
  panache_character* character(const char* style = nullptr, float strength = 1) const {
    panache_character* out = nullptr;
    EXPECT_EQ(panache_character_create(model_, skeleton_, nullptr, &out), PANACHE_OK);
    if (style) {
      panache_character_set_strength(out, panache_model_find_style(model_, style), strength);
    }
    return out;
  }
  static std::vector<stick_pose> walk(panache_character* character, int frames, double phase = 0) {
    std::vector<stick_pose> out(static_cast<size_t>(frames));
    for (int f = 0; f < frames; ++f) {
      stick_pose in;
      stick_walk(f / 60.0, phase, &in);
      panache_character_step(character, stick_input(&in), 1 / 60.0, stick_output(&out[f]));
    }
    return out;
  }
  static bool same(const std::vector<stick_pose>& a, const std::vector<stick_pose>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0;
  }

  panache_model* model_ = nullptr;
  panache_skeleton* skeleton_ = nullptr;
};

inline panache_report report_of(const panache_character* character) {
  panache_report report = PANACHE_REPORT;
  EXPECT_EQ(panache_character_get_report(character, &report), PANACHE_OK);
  return report;
}

// A walk of the stick figure, and the same bent forward at its first joint above the hips.
struct Walk {
  std::vector<float> rotations, translations;
  panache_clip clip{};
  Walk(const panache_skeleton* skeleton, int frames, bool bent) {
    for (int f = 0; f < frames; ++f) {
      stick_pose pose;
      stick_walk(f / 60.0, 0, &pose);
      const panache_input_pose in = stick_input(&pose);
      rotations.insert(rotations.end(), in.rotations, in.rotations + 4 * STICK_JOINTS);
      translations.insert(translations.end(), in.translations, in.translations + 3 * STICK_JOINTS);
      if (bent) {  // By 0.4 radians about x; the walk leaves this joint alone.
        float* q = &rotations[rotations.size() - 4 * (STICK_JOINTS - 1)];
        q[0] = std::sin(0.2f), q[1] = 0, q[2] = 0, q[3] = std::cos(0.2f);
      }
    }
    clip = {skeleton, frames, 1 / 60.0, rotations.data(), translations.data()};
  }
};

}  // namespace panache::test
