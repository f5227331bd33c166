#pragma once
// What a model file is, and a style file, in words and as JSON.

#include <memory>
#include <string>

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

// Where its motion comes from, and under which licence it is: its own, else what it was trained on
// and that data's licence; "not stated" without either.
std::string source_of(const LoadedStyle& loaded);
std::string licence_of(const LoadedStyle& loaded);

std::string describe(const LoadedStyle& loaded);
Json to_json(const LoadedStyle& loaded);

// Prints what is known of a model, of a style file or of a folder of these.
template <class Loaded>
int report(const Loaded& loaded, bool json) {
  if (json) {
    print(to_json(loaded));
  } else {
    print(describe(loaded));
  }
  return kDone;
}

}  // namespace panache::cli
