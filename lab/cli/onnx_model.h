#pragma once
// A model as an ONNX graph.

#include <string>

#include "base/result.h"
#include "net/safetensors.h"

namespace panache::cli {

inline constexpr int kOnnxOpset = 17;

// The bytes of an ONNX file that computes what StyleNetworks does with the model of `file`, which
// is one that Model::create() reads; docs/onnx.md lists inputs and outputs. Fails for models of
// int8 weights, without styles, and of recipes whose style inputs it does not know. `name` stands
// in front of the message.
Result<std::string> to_onnx(const TensorFile& file, const std::string& name);

}  // namespace panache::cli
