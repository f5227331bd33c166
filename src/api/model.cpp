#include "api/errors.h"
#include "api/objects.h"
#include "api/options.h"
#include "learn/style_file.h"
#include "style/model/model.h"
#include "style/play/removal.h"

using namespace panache;
using namespace panache::api;

panache_status panache_model_create(const void* bytes, size_t size, panache_model** out) {
  start(out);
  return guarded([&] {
    auto model = Model::parse({static_cast<const char*>(bytes), size}, "model");
    if (!model) return fail(PANACHE_BAD_MODEL, model.error());
    *out = new panache_model{*std::move(model)};
    return PANACHE_OK;
  });
}

void panache_model_destroy(panache_model* model) { delete model; }

int32_t panache_model_style_count(const panache_model* model) {
  return static_cast<int32_t>(model->model->styles().size());
}

const char* panache_model_style_name(const panache_model* model, int32_t style) {
  if (style < 0 || style >= panache_model_style_count(model)) return nullptr;
  return model->model->styles()[style].name.c_str();
}

static Result<void> check_style(const panache_model* model, int32_t style) {
  const int32_t count = panache_model_style_count(model);
  if (style >= 0 && style < count) return {};
  return Error{"there is no style " + std::to_string(style) + "; the model has " +
               std::to_string(count)};
}

panache_status panache_model_get_style_info(const panache_model* model, int32_t style,
                                            panache_style_info* info) {
  return guarded([&] {
    Result<void> done = check_style(model, style);
    if (done) {
      const StyleInfo& from = model->model->styles()[style];
      const panache_style_info found = {0,
                                        is_remover(*model->model),
                                        from.learnt,
                                        check_has_sides(*model->model).ok(),
                                        static_cast<int32_t>(model->model->gestures(style).size()),
                                        from.description.c_str(),
                                        from.group.c_str(),
                                        from.words.c_str(),
                                        from.side.c_str(),
                                        from.thumbnail.c_str()};
      done = write_struct(found, info, "panache_style_info");
    }
    return done ? PANACHE_OK : fail(PANACHE_BAD_ARGUMENT, done.error());
  });
}

panache_status panache_model_find_side(const panache_model* model, int32_t style, const char* word,
                                       float* side) {
  return guarded([&] {
    if (auto good = check_style(model, style); !good) {
      return fail(PANACHE_BAD_ARGUMENT, good.error());
    }
    const Result<float> found = find_side(*model->model, style, word);
    if (!found) return fail(PANACHE_BAD_ARGUMENT, found.error());
    *side = *found;
    return PANACHE_OK;
  });
}

const char* panache_model_gesture_name(const panache_model* model, int32_t style, int32_t gesture) {
  if (style < 0 || style >= panache_model_style_count(model) || gesture < 0) return nullptr;
  const auto& all = model->model->gestures(style);
  return static_cast<size_t>(gesture) < all.size() ? all[gesture].name().c_str() : nullptr;
}

int32_t panache_model_person_axis_count(const panache_model* model) {
  const PersonSpace* persons = model->model->persons();
  return persons ? static_cast<int32_t>(persons->axes()) : 0;
}

const char* panache_model_person_axis_name(const panache_model* model, int32_t axis) {
  if (axis < 0 || axis >= panache_model_person_axis_count(model)) return nullptr;
  return model->model->persons()->names()[axis].c_str();
}

panache_status panache_model_draw_person(const panache_model* model, uint32_t seed, float* numbers,
                                         int32_t count) {
  return guarded([&] {
    if (Result<void> good = check_person_count(*model->model, count); !good) {
      return fail(PANACHE_BAD_ARGUMENT, good.error());
    }
    draw_person(seed, {numbers, static_cast<size_t>(count)});
    return PANACHE_OK;
  });
}

uint32_t panache_person_seed(const char* word) { return person_seed(word); }

int32_t panache_model_find_style(const panache_model* model, const char* name) {
  int32_t index = -1;
  guarded([&] {
    const Result<int> found = model->model->find_style_by_any_name(name);
    if (!found) return fail(PANACHE_BAD_ARGUMENT, found.error());
    index = *found;
    return PANACHE_OK;
  });
  return index;
}

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
    const Result<TensorFile> merged =
        add_style(model->file, kModelName, *style, "the style", replace != 0);
    if (!merged) {
      const bool exists = merged.error().kind == ErrorKind::style_exists;
      return fail(exists ? PANACHE_BAD_ARGUMENT : PANACHE_BAD_STYLE, merged.error());
    }
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
