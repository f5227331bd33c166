#pragma once
// Names and checks output files.

#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"
#include "find_inputs.h"

namespace panache::cli {

// An output file and the input that it is made from.
struct FilePair {
  std::string input, output;
};

// `name` with its extension replaced by `extension` unless that is empty, and .amc by .bvh, as AMC
// is not written.
std::filesystem::path with_extension(std::filesystem::path name, const std::string& extension);

// The output file of each input. `output` is a folder for a batch, if it ends in '/' or if it is an
// existing folder; files in it are named after the inputs, see with_extension(). Rejects two inputs
// with one output.
Result<std::vector<FilePair>> name_outputs(const FoundFiles& inputs, const std::string& output,
                                           const std::string& extension = "");

// Rejects all outputs that exist, in one message, unless `force`; called before any work is done.
// The message says if an output is its own input.
Result<void> check_outputs(const std::vector<FilePair>& files, bool force);
// For a single file.
Result<void> check_output(const std::string& input, const std::string& output, bool force);

}  // namespace panache::cli
