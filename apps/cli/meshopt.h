#pragma once
// Packed data of glTF files.

#include "clip/meshopt.h"

namespace panache::cli {

// Null in a build without meshoptimizer.
extern const MeshoptDecoder kMeshoptDecoder;

}  // namespace panache::cli
