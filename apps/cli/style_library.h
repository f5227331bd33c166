#pragma once
// A folder of style files.

#include <string>
#include <vector>

#include "model_report.h"

namespace panache::cli {

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

}  // namespace panache::cli
