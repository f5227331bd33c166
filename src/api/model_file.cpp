#include "api/model_file.h"

namespace panache::api {

Result<ModelFile> ModelFile::parse(const void* bytes, size_t size) {
  Result<TensorFile> file = parse_safetensors({static_cast<const char*>(bytes), size}, kModelName);
  if (!file) return file.error();
  auto model = Model::create(*file, kModelName);
  if (!model) return model.error();
  return ModelFile{*std::move(file), *std::move(model)};
}

Result<void> ModelFile::check_free(const std::string& style, bool replace) const {
  if (replace || !model->find_style(style)) return {};
  return Error{"the model has a style '" + style + "' already; give another name, or replace it"};
}

}  // namespace panache::api
