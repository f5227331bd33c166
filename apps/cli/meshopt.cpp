#include "formats.h"

#include <meshoptimizer.h>

namespace panache::cli {
namespace {

bool decode(const MeshoptView& view, std::string_view packed, char* out) {
  const auto [mode, filter, count, stride] = view;
  const auto* bytes = reinterpret_cast<const unsigned char*>(packed.data());
  if (mode == MeshoptMode::triangles) {
    return meshopt_decodeIndexBuffer(out, count, stride, bytes, packed.size()) == 0;
  }
  if (mode == MeshoptMode::indices) {
    return meshopt_decodeIndexSequence(out, count, stride, bytes, packed.size()) == 0;
  }
  if (meshopt_decodeVertexBuffer(out, count, stride, bytes, packed.size()) != 0) return false;
  if (filter == MeshoptFilter::octahedral) meshopt_decodeFilterOct(out, count, stride);
  if (filter == MeshoptFilter::quaternion) meshopt_decodeFilterQuat(out, count, stride);
  if (filter == MeshoptFilter::exponential) meshopt_decodeFilterExp(out, count, stride);
  return true;
}

}  // namespace

const MeshoptDecoder kMeshoptDecoder = decode;

}  // namespace panache::cli
