#pragma once
// What a model file is, a style file, and a folder of these, in words and as JSON.

#include <memory>
#include <string>
#include <vector>

#include "messages.h"
#include "net/safetensors.h"
#include "style/model.h"

namespace panache::cli {

struct LoadedModel {
  std::string path;
  std::shared_ptr<const Model> model;
  uint64_t bytes = 0;  // Of the file.
};
Result<LoadedModel> load_model(const std::string& path);

// A few lines about the model, then a line for each style, by groups where the model has them.
std::string describe(const LoadedModel& loaded);
// The same, but only the names of the styles.
std::string summarize(const LoadedModel& loaded);
Json to_json(const LoadedModel& loaded);

struct LoadedStyle {
  std::string path;
  StyleInfo info;
  std::vector<std::string> gestures;  // Their names.
  TensorFile file;
  uint64_t bytes = 0;  // Of the file.
};
Result<LoadedStyle> load_style(const std::string& path);

std::string describe(const LoadedStyle& loaded);
Json to_json(const LoadedStyle& loaded);

struct StyleLibrary {
  std::string folder;
  std::vector<LoadedStyle> styles;  // By their files' names.
  std::vector<Error> broken;        // Of files that end in .safetensors and cannot be read.
};

// The style files in a folder, not below it; models in it are left out. Fails where there is no
// such folder.
Result<StyleLibrary> read_library(const std::string& folder);

// A line for each style: its name, description, source, licence and file.
std::string describe(const StyleLibrary& library);
Json to_json(const StyleLibrary& library);

// The model with all styles of a library that are made for it; those of its own names are
// replaced. A message says which are not.
TensorFile with_library(TensorFile model, const std::string& name, const StyleLibrary& library);

// Prints what is known of a model, of a style file or of a folder of these.
template <class Loaded>
int report(const Loaded& loaded, bool json) {
  print(json ? dump(to_json(loaded)) : describe(loaded));
  return kDone;
}

}  // namespace panache::cli
