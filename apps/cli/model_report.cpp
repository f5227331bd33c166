#include "model_report.h"

#include <algorithm>

#include "base/file.h"

namespace panache::cli {
namespace {

// A metadata entry; empty where the model has none.
std::string entry(const Model& model, const std::string& key) {
  const auto found = model.metadata().find(key);
  return found == model.metadata().end() ? "" : found->second;
}

}  // namespace

Result<LoadedModel> load_model(const std::string& path) {
  Result<std::string> bytes = read_file(path);
  if (!bytes) return bytes.error();
  Result<std::shared_ptr<const Model>> model = Model::parse(*bytes, path);
  if (!model) return model.error();
  return LoadedModel{path, *model, bytes->size()};
}

std::string describe(const LoadedModel& loaded) {
  const Model& model = *loaded.model;
  const std::string licence = entry(model, "licence");
  std::string text = loaded.path + "\n";
  text += "  recipe       " + entry(model, "recipe") + "\n";
  text += "  size         " + fixed(static_cast<double>(loaded.bytes) / 1000, 0) + " KB, " +
          std::to_string(model.parameter_count()) + " numbers\n";
  const std::string data = entry(model, "data");
  text += "  trained on   " + (data.empty() ? "not stated" : data) + "\n";
  text += "  data licence " + (licence.empty() ? "not stated" : licence) + "\n\n";
  size_t width = 0;
  for (const StyleInfo& style : model.styles()) width = std::max(width, style.name.size());
  text += plural(model.styles().size(), "style") + ":\n";
  for (const StyleInfo& style : model.styles()) {
    text += "  " + (style.description.empty() ? style.name : padded(style.name, width + 2)) +
            style.description + "\n";
  }
  return text;
}

Json to_json(const LoadedModel& loaded) {
  const Model& model = *loaded.model;
  Json styles = Json::array();
  for (const StyleInfo& style : model.styles()) {
    styles.push_back({{"name", style.name}, {"description", style.description}});
  }
  return {{"model", loaded.path},
          {"recipe", entry(model, "recipe")},
          {"data", entry(model, "data")},
          {"licence", entry(model, "licence")},
          {"bytes", loaded.bytes},
          {"parameters", model.parameter_count()},
          {"styles", styles}};
}

}  // namespace panache::cli
