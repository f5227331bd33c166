#pragma once
// ONNX Runtime, loaded without its headers.

#include <memory>
#include <span>
#include <string>

#include "bench/networks.h"

namespace panache::bench {

// Opens the library at `path`, never to be closed: one thread, all graph optimisations,
// preallocated outputs. `int8`: see format_onnx(). Returns null and a message on failure.
std::unique_ptr<Evaluation> open_onnxruntime(const std::string& path,
                                             std::span<const Network> networks, bool int8,
                                             std::string& problem);

}  // namespace panache::bench
