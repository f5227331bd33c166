#pragma once
// A model as a file in memory, for what makes another file of it.

#include <memory>
#include <string>

#include "base/result.h"
#include "net/safetensors.h"
#include "style/model.h"

namespace panache::api {

inline constexpr const char* kModelName = "the model";  // In messages.

struct ModelFile {
  TensorFile file;
  std::shared_ptr<const Model> model;

  // Fails where the bytes are no model.
  static Result<ModelFile> parse(const void* bytes, size_t size);
  // Fails where a style of this name would be in the way.
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
  return Error{"the model has a style '" + style + "' already; give another name, or replace it"};
}

}  // namespace panache::api
