#pragma once
// Where results go.

#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"
#include "find_inputs.h"

namespace panache::cli {

// A file to be made, and the one that it is made of.
struct FilePair {
  std::string input, output;
};

// `name` with `extension` for its own where that is not empty, and with .glb for .fbx, which nobody
// writes here.
std::filesystem::path with_extension(std::filesystem::path name, const std::string& extension);

// The output file of each input. `output` is a folder where the inputs are a batch, where it ends
// in '/' and where it is one; files in it are called as the inputs, see with_extension(). Two
// inputs with one output are rejected.
Result<std::vector<FilePair>> name_outputs(const FoundFiles& inputs, const std::string& output,
                                           const std::string& extension = "");

// Rejects all outputs that exist, in one message, unless `force`: before any work is done. The
// message says where one of them is its very input.
Result<void> check_outputs(const std::vector<FilePair>& files, bool force);
// The same for a single file.
Result<void> check_output(const std::string& input, const std::string& output, bool force);

}  // namespace panache::cli
