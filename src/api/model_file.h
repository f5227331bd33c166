#pragma once
// A model file in memory, for functions that make a changed file from it.

#include <memory>
#include <string>

#include "base/result.h"
#include "net/safetensors.h"
#include "style/model/model.h"

namespace panache::api {

inline constexpr const char* kModelName = "the model";  // In messages.

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
