#include "meshopt.h"

namespace panache::cli {

const MeshoptDecoder kMeshoptDecoder = nullptr;

}  // namespace panache::cli
