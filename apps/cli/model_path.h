#pragma once
// Model files on disk: finds those that are shipped with the program, and edits files in place.

#include <string>

#include "base/result.h"
#include "net/safetensors.h"

namespace panache::cli {

inline constexpr const char* kDefaultModel = "panache-int8.safetensors";
inline constexpr const char* kFloatModel = "panache.safetensors";  // The default model in float.
inline constexpr const char* kRemoverModel = "remover-int8.safetensors";
inline constexpr const char* kNeutralBank = "neutral.safetensors";
inline constexpr const char* kWalkerModel = "walker.safetensors";

// The path of the shipped model `file_name`: in share/panache/models next to an installed program's
// folder, in models/ next to the program, or in models/ of the checkout that it was built in.
// Failure messages list the searched paths.
Result<std::string> find_shipped(const std::string& file_name);

// The path of the model to use: `given` (--model) if not empty, else the environment variable
// PANACHE_MODEL, else the shipped model `file_name`. Does not read the file.
Result<std::string> find_model(const std::string& given,
                               const std::string& file_name = kDefaultModel);

// The tensors of a model or style file.
Result<TensorFile> read_tensors(const std::string& path);

// Rejects a read-only file: replacing it by renaming would not need write permission.
Result<void> check_writable(const std::string& path);

// Replaces a model file atomically; a link remains a link. The file must be writable.
Result<void> replace_model(const std::string& path, const TensorFile& model);

}  // namespace panache::cli
