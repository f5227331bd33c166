#pragma once
// Models that tests have changed, and windows of noise for their networks.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/random.h"
#include "net/safetensors.h"
#include "pose/features.h"
#include "style/model/model.h"

namespace panache {

inline std::shared_ptr<const Model> read(const TensorFile& file) {
  const auto model = Model::parse(format_safetensors(file), "m.safetensors");
  EXPECT_TRUE(model.ok()) << (model.ok() ? "" : model.error().message);
  return *model;
}

inline std::string failure(const TensorFile& file) {
  const auto model = Model::parse(format_safetensors(file), "m.safetensors");
  return model.ok() ? "" : model.error().message;
}

inline std::vector<float> window_of(uint64_t seed) {
  std::vector<float> window(size_t(kWindowPoses) * pose_feature_count(PoseLayout::positions));
  Random random(seed);
  for (float& w : window) w = random.normal();
  return window;
}

}  // namespace panache
