#include "api/errors.h"
#include "api/objects.h"
#include "style/side.h"

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

const char* panache_model_style_group(const panache_model* model, int32_t style) {
  if (style < 0 || style >= panache_model_style_count(model)) return nullptr;
  return model->model->styles()[style].group.c_str();
}

const char* panache_model_style_side(const panache_model* model, int32_t style) {
  if (style < 0 || style >= panache_model_style_count(model)) return nullptr;
  return model->model->styles()[style].side.c_str();
}

panache_status panache_model_find_side(const panache_model* model, int32_t style, const char* word,
                                       float* side) {
  return guarded([&] {
    const int32_t count = panache_model_style_count(model);
    if (style < 0 || style >= count) {
      return fail(PANACHE_BAD_ARGUMENT, {"there is no style " + std::to_string(style) +
                                         "; the model has " + std::to_string(count)});
    }
    const Result<float> found = find_side(*model->model, style, word);
    if (!found) return fail(PANACHE_BAD_ARGUMENT, found.error());
    *side = *found;
    return PANACHE_OK;
  });
}

int32_t panache_model_gesture_count(const panache_model* model, int32_t style) {
  if (style < 0 || style >= panache_model_style_count(model)) return 0;
  return static_cast<int32_t>(model->model->gestures(style).size());
}

const char* panache_model_gesture_name(const panache_model* model, int32_t style, int32_t gesture) {
  if (gesture < 0 || gesture >= panache_model_gesture_count(model, style)) return nullptr;
  return model->model->gestures(style)[gesture].name().c_str();
}

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
