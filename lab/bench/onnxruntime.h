#pragma once
// ONNX Runtime, whose library comes without headers.

#include <memory>
#include <span>
#include <string>

#include "bench/networks.h"

namespace panache::bench {

// Opens the library at `path`, for good: one thread, all optimisations of the graph, outputs in
// memory that is there. `int8`: see format_onnx(). Null, and a message, where that does not work.
std::unique_ptr<Evaluation> open_onnxruntime(const std::string& path,
                                             std::span<const Network> networks, bool int8,
                                             std::string& problem);

}  // namespace panache::bench
