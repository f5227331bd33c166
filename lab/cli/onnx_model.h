#pragma once
// Exports a model as an ONNX graph.

#include <string>

#include "base/result.h"
#include "net/safetensors.h"

namespace panache::cli {

inline constexpr int kOnnxOpset = 17;

// The bytes of an ONNX file that computes the same as StyleNetworks for the model of `file`, which
// Model::create() must accept; docs/onnx.md lists inputs and outputs. Fails for int8 models, models
// without styles, and recipes with unknown style inputs. `name` is the prefix of messages.
Result<std::string> to_onnx(const TensorFile& file, const std::string& name);

}  // namespace panache::cli
