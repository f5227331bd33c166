#pragma once
// Edits model files in place.

#include <string>

#include "base/result.h"
#include "net/safetensors.h"

namespace panache::cli {

// The tensors of a model or style file.
Result<TensorFile> read_tensors(const std::string& path);

// Rejects a read-only file: replacing it by renaming would not need write permission.
Result<void> check_writable(const std::string& path);

// Replaces a model file atomically; a link remains a link. The file must be writable.
Result<void> replace_model(const std::string& path, const TensorFile& model);

}  // namespace panache::cli
