#pragma once
// What a model file is, in words and as JSON.

#include <memory>
#include <string>

#include "report.h"
#include "style/model.h"

namespace panache::cli {

struct LoadedModel {
  std::string path;
  std::shared_ptr<const Model> model;
  uint64_t bytes = 0;  // Of the file.
};
Result<LoadedModel> load_model(const std::string& path);

// A few lines about the model, then a line for each style.
std::string describe(const LoadedModel& loaded);
Json to_json(const LoadedModel& loaded);

}  // namespace panache::cli
