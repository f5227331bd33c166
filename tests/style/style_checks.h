#pragma once
// What the tests of styles share: models that they have changed, noise for networks, and walks.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/random.h"
#include "net/safetensors.h"
#include "pose/features.h"
#include "rig/canonical_body.h"
#include "style/model/model.h"
#include "walker/walker.h"

namespace panache {

inline std::shared_ptr<const Model> read(const TensorFile& file) {
  const auto model = Model::parse(format_safetensors(file), "m.safetensors");
  EXPECT_TRUE(model.ok()) << (model.ok() ? "" : model.error().message);
  return *model;
}

// Why the file is no model; "" if it is one.
inline std::string failure(const TensorFile& file) {
  const auto model = Model::parse(format_safetensors(file), "m.safetensors");
  return model.ok() ? "" : model.error().message;
}

// A model that comes with Panache, read once.
inline std::shared_ptr<const Model> shipped_model() {
  static const auto model = *Model::load(PANACHE_SOURCE_DIR "/models/panache.safetensors");
  return model;
}

// A window of random numbers, this many deviations large.
inline std::vector<float> window_of(float size = 1, uint64_t seed = 5) {
  std::vector<float> window(size_t(kWindowPoses) * pose_feature_count(PoseLayout::positions));
  Random random(seed);
  for (float& w : window) w = size * random.normal();
  return window;
}

// The walker from a standing start, 60 frames a second.
inline Clip walker_walk(int frames, float speed = 1.3f, float turn = 0.2f) {
  Walker walker(*WalkerModel::load(PANACHE_SOURCE_DIR "/models/walker.safetensors"));
  Clip clip{canonical_skeleton(), 1 / 60.0, 0, {}, {}};
  clip.resize(frames);
  for (int f = 0; f < frames; ++f) walker.step(speed, turn, clip.frame_time, clip.pose(f));
  return clip;
}

// What a character shows of a clip, step by step.
template <class Character>
Clip played(Character& character, const Clip& clip, const std::vector<float>& strengths) {
  Clip out = clip;
  for (int f = 0; f < clip.frames; ++f) {
    character.step(clip.pose(f), strengths, clip.frame_time, out.pose(f));
  }
  return out;
}

}  // namespace panache
