// What only the page needs beside panache.h: models, and styles that are learnt or opened. See
// exports.h. Messages have the names that the page gives to files.

#include "exports.h"
#include "learn/style_file.h"
#include "learning.h"
#include "style/removal.h"

using namespace panache;
using namespace panache::web;

PANACHE_EXPORT panache_model* panache_page_model_create(const char* data, uint32_t size,
                                                        const char* name) {
  auto model = Model::parse(bytes_at(data, size), name);
  if (model) return new panache_model{*std::move(model)};
  return fail(model.error());
}
// A model that takes styles off.
PANACHE_EXPORT panache_model* panache_page_remover_create(const char* data, uint32_t size) {
  const std::string name = "the remover";
  auto model = Model::parse(bytes_at(data, size), name);
  if (!model) return fail(model.error());
  if (const auto any = find_removal(**model, ""); !any) return fail(located(name, any.error()));
  return new panache_model{*std::move(model)};
}
PANACHE_EXPORT const char* panache_page_style_description(const panache_model* model,
                                                          int32_t style) {
  return model->model->styles()[static_cast<size_t>(style)].description.c_str();
}
// SVG; empty of most styles.
PANACHE_EXPORT const char* panache_page_style_thumbnail(const panache_model* model, int32_t style) {
  return model->model->styles()[static_cast<size_t>(style)].thumbnail.c_str();
}
PANACHE_EXPORT int32_t panache_page_style_learnt(const panache_model* model, int32_t style) {
  return model->model->styles()[static_cast<size_t>(style)].learnt;
}

// Whether the bytes say that they are a style, and not a model.
PANACHE_EXPORT int32_t panache_page_is_style(const char* data, uint32_t size) {
  const Result<TensorFile> file = parse_safetensors(bytes_at(data, size), "");
  return file && is_style_file(*file);
}
// The bytes of the model with the style of a style file.
PANACHE_EXPORT panache_bytes* panache_page_style_add(const char* model, uint32_t model_size,
                                                     const char* style, uint32_t style_size,
                                                     const char* style_name, int32_t replace) {
  const std::string model_name = "the model";
  const Result<TensorFile> to = parse_safetensors(bytes_at(model, model_size), model_name);
  if (!to) return fail(to.error());
  const Result<TensorFile> from = parse_safetensors(bytes_at(style, style_size), style_name);
  if (!from) return fail(from.error());
  const Result<TensorFile> merged = add_style(*to, model_name, *from, style_name, replace != 0);
  if (!merged) return fail(merged.error());
  return new panache_bytes{format_safetensors(*merged)};
}

// The bytes of a style file; those of the report come into *report. Without a neutral file the bank
// of neutral motion in `bank` stands in for it.
PANACHE_EXPORT panache_bytes* panache_page_learn(const char* model, uint32_t model_size,
                                                 FileHandle* neutral, int32_t neutral_clip,
                                                 const char* neutral_name, const char* bank,
                                                 uint32_t bank_size, FileHandle* styled,
                                                 int32_t styled_clip, const char* styled_name,
                                                 const char* style, panache_bytes** report) {
  const std::string_view bytes = bytes_at(model, model_size);
  const Motion after = {**styled, styled_clip, styled_name};
  Result<Learnt> learnt = neutral
                              ? learn(bytes, {**neutral, neutral_clip, neutral_name}, after, style)
                              : learn_alone(bytes, bytes_at(bank, bank_size), after, style);
  if (!learnt) return fail(learnt.error());
  *report = new panache_bytes{std::move(learnt->report)};
  return new panache_bytes{std::move(learnt->style)};
}
