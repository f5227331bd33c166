#pragma once
// The objects behind the handles of panache.h.

#include <memory>
#include <string>
#include <vector>

#include "base/result.h"
#include "clip/motion_file.h"
#include "learn/learn_style.h"
#include "net/safetensors.h"
#include "panache/panache.h"
#include "rig/rig.h"
#include "style/live_stylizer.h"
#include "style/model/model.h"
#include "style/restyle.h"

struct panache_bytes {
  std::string bytes;
};
struct panache_model {
  std::shared_ptr<const panache::Model> model;
};
struct panache_skeleton {
  panache::Rig rig;
  panache::Skeleton joints;
  panache::Clip body;  // The target of retarget().
};
struct panache_character {
  panache::LiveStylizer live;
  std::vector<float> strengths;  // As set.
};
struct panache_styled_clip {
  panache::Restyled restyled;
  std::vector<uint8_t> contacts;  // [frames][2]
};
struct panache_learnt {
  std::string model;
  panache::LearntStyle style;
  std::string warnings;
};
struct panache_motion_file {
  std::shared_ptr<const panache::MotionFile> file;
  std::string path;
  std::vector<std::string> names;  // Names of its motions.
  std::vector<char> moves;         // Whether each motion moves the humanoid.
  panache::Clip rest;
};
struct panache_samples {
  int32_t count = 0;
  std::vector<float> windows, changes, log_rates, contacts;
};

namespace panache::api {

inline constexpr const char* kModelName = "the model";  // In messages.

// A model file in memory, for functions that make a changed file from it.
struct ModelFile {
  TensorFile file;
  std::shared_ptr<const Model> model;

  // Fails if the bytes are not a model.
  static Result<ModelFile> parse(const void* bytes, size_t size);
  // Fails if a style of this name exists and must not be replaced.
  Result<void> check_free(const std::string& style, bool replace) const;
};

inline Result<ModelFile> ModelFile::parse(const void* bytes, size_t size) {
  Result<TensorFile> file = parse_safetensors({static_cast<const char*>(bytes), size}, kModelName);
  if (!file) return file.error();
  auto model = Model::create(*file, kModelName);
  if (!model) return model.error();
  return ModelFile{*std::move(file), *std::move(model)};
}

inline Result<void> ModelFile::check_free(const std::string& style, bool replace) const {
  if (replace || !model->find_style(style)) return {};
  return Error{"the model has a style '" + style + "' already; give another name, or replace it",
               ErrorKind::style_exists};
}

}  // namespace panache::api
