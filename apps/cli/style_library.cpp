#include "style_library.h"

#include <algorithm>
#include <filesystem>

#include "learn/style_file.h"

namespace panache::cli {

Result<StyleLibrary> read_library(const std::string& folder) {
  namespace fs = std::filesystem;
  std::error_code status;
  std::vector<std::string> paths;
  for (const auto& entry : fs::directory_iterator(folder, status)) {
    if (entry.path().extension() == ".safetensors") paths.push_back(entry.path().string());
  }
  if (status) return Error{folder + ": is no folder that can be read: " + status.message()};
  std::ranges::sort(paths);
  StyleLibrary library{folder, {}, {}};
  for (const std::string& path : paths) {
    Result<LoadedStyle> style = load_style(path);
    if (style) {
      library.styles.push_back(*std::move(style));
    } else if (style.error().kind != ErrorKind::is_model) {
      library.broken.push_back(style.error());
    }
  }
  return library;
}

std::string describe(const StyleLibrary& library) {
  std::string text = library.folder + "\n" + plural(library.styles.size(), "style") + ":\n";
  size_t width = 0;
  for (const LoadedStyle& style : library.styles) width = std::max(width, style.info.name.size());
  for (const LoadedStyle& style : library.styles) {
    const std::string file = std::filesystem::path(style.path).filename().string();
    text += "  " + padded(style.info.name, width + 2) + style.info.description + "\n";
    text += "  " + padded("", width + 2) + "source: " + source_of(style) +
            "; licence: " + licence_of(style) + "; " + file + "\n";
  }
  return text;
}

Json to_json(const StyleLibrary& library) {
  Json styles = Json::array();
  for (const LoadedStyle& style : library.styles) styles.push_back(to_json(style));
  return {{"library", library.folder}, {"styles", styles}};
}

TensorFile with_library(TensorFile model, const std::string& name, const StyleLibrary& library) {
  for (const LoadedStyle& style : library.styles) {
    Result<TensorFile> merged = add_style(model, name, style.file, style.path, true);
    if (merged) {
      model = *std::move(merged);
    } else {
      print_message("warning: " + merged.error().message);
    }
  }
  return model;
}

}  // namespace panache::cli
