#pragma once
// Describes a model file, a style file or a folder of style files, in text and as JSON.

#include <memory>
#include <string>
#include <vector>

#include "messages.h"
#include "net/safetensors.h"
#include "style/model/model.h"

namespace panache::cli {

struct LoadedModel {
  std::string path;
  std::shared_ptr<const Model> model;
  uint64_t bytes = 0;  // Size of the file.
};
Result<LoadedModel> load_model(const std::string& path);

// A few lines about the model, then one per style, grouped if the model has groups.
std::string describe(const LoadedModel& loaded);
// The same with style names only.
std::string summarize(const LoadedModel& loaded);
Json to_json(const LoadedModel& loaded);

struct LoadedStyle {
  std::string path;
  StyleInfo info;
  std::vector<std::string> gestures;  // Names.
  TensorFile file;
  uint64_t bytes = 0;  // Size of the file.
};
Result<LoadedStyle> load_style(const std::string& path);

std::string describe(const LoadedStyle& loaded);
Json to_json(const LoadedStyle& loaded);

struct StyleLibrary {
  std::string folder;
  std::vector<LoadedStyle> styles;  // Sorted by file name.
  std::vector<Error> broken;        // Errors of unreadable .safetensors files.
};

// Reads the style files directly in a folder, without models. Fails if the folder does not exist.
Result<StyleLibrary> read_library(const std::string& folder);

// One line per style: its name, description, source, licence and file.
std::string describe(const StyleLibrary& library);
Json to_json(const StyleLibrary& library);

// The model with all matching styles of a library added; they replace styles of the same name.
// Prints a message for each style made for another model.
TensorFile with_library(TensorFile model, const std::string& name, const StyleLibrary& library);

// Prints a report on a model, a style file or a folder of these.
template <class Loaded>
int report(const Loaded& loaded, bool json) {
  print(json ? dump(to_json(loaded)) : describe(loaded));
  return kDone;
}

}  // namespace panache::cli
