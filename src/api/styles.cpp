#include "api/errors.h"
#include "api/model_file.h"
#include "api/objects.h"
#include "learn/style_file.h"

using namespace panache;
using namespace panache::api;

namespace {

panache_status give(const TensorFile& file, panache_bytes** out) {
  *out = new panache_bytes{format_safetensors(file)};
  return PANACHE_OK;
}

}  // namespace

panache_status panache_styles_add(const void* model_bytes, size_t model_size,
                                  const void* style_bytes, size_t style_size, int32_t replace,
                                  panache_bytes** out) {
  start(out);
  return guarded([&] {
    const Result<ModelFile> model = ModelFile::parse(model_bytes, model_size);
    if (!model) return fail(PANACHE_BAD_MODEL, model.error());
    const std::string_view bytes(static_cast<const char*>(style_bytes), style_size);
    const Result<TensorFile> style = parse_safetensors(bytes, "the style");
    if (!style) return fail(PANACHE_BAD_STYLE, style.error());
    const Result<StyleInfo> info = read_style_info(*style, "the style");
    if (!info) return fail(PANACHE_BAD_STYLE, info.error());
    if (auto free = model->check_free(info->name, replace != 0); !free) {
      return fail(PANACHE_BAD_ARGUMENT, free.error());
    }
    const Result<TensorFile> merged =
        add_style(model->file, kModelName, *style, "the style", replace != 0);
    if (!merged) return fail(PANACHE_BAD_STYLE, merged.error());
    return give(*merged, out);
  });
}

panache_status panache_styles_remove(const void* model_bytes, size_t model_size, const char* name,
                                     panache_bytes** out) {
  start(out);
  return guarded([&] {
    const Result<ModelFile> model = ModelFile::parse(model_bytes, model_size);
    if (!model) return fail(PANACHE_BAD_MODEL, model.error());
    const Result<TensorFile> rest = remove_style(model->file, name, kModelName);
    if (!rest) return fail(PANACHE_BAD_ARGUMENT, rest.error());
    return give(*rest, out);
  });
}

panache_status panache_styles_extract(const void* model_bytes, size_t model_size, const char* name,
                                      panache_bytes** out) {
  start(out);
  return guarded([&] {
    const Result<ModelFile> model = ModelFile::parse(model_bytes, model_size);
    if (!model) return fail(PANACHE_BAD_MODEL, model.error());
    const Result<TensorFile> style = extract_style(model->file, name, kModelName);
    if (!style) return fail(PANACHE_BAD_ARGUMENT, style.error());
    return give(*style, out);
  });
}
