#pragma once
// Model files that are changed in their place.

#include <string>

#include "base/result.h"
#include "net/safetensors.h"

namespace panache::cli {

// The tensors of a model or style file.
Result<TensorFile> read_tensors(const std::string& path);

// Rejects a read-only file: renaming over it would need no permission.
Result<void> check_writable(const std::string& path);

// Puts a changed model into the place of the old one, whole or not at all; a link stays one. The
// file is writable.
Result<void> replace_model(const std::string& path, const TensorFile& model);

}  // namespace panache::cli
