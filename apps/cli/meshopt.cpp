#include "formats.h"

#include <meshoptimizer.h>

namespace panache::cli {
namespace {

bool decode(const MeshoptView& view, std::string_view packed, char* out) {
  const auto* bytes = reinterpret_cast<const unsigned char*>(packed.data());
  switch (view.mode) {
    case MeshoptMode::triangles:
      return meshopt_decodeIndexBuffer(out, view.count, view.stride, bytes, packed.size()) == 0;
    case MeshoptMode::indices:
      return meshopt_decodeIndexSequence(out, view.count, view.stride, bytes, packed.size()) == 0;
    case MeshoptMode::attributes:
      break;
  }
  if (meshopt_decodeVertexBuffer(out, view.count, view.stride, bytes, packed.size()) != 0) {
    return false;
  }
  switch (view.filter) {
    case MeshoptFilter::octahedral:
      meshopt_decodeFilterOct(out, view.count, view.stride);
      break;
    case MeshoptFilter::quaternion:
      meshopt_decodeFilterQuat(out, view.count, view.stride);
      break;
    case MeshoptFilter::exponential:
      meshopt_decodeFilterExp(out, view.count, view.stride);
      break;
    case MeshoptFilter::none:
      break;
  }
  return true;
}

}  // namespace

const MeshoptDecoder kMeshoptDecoder = decode;

}  // namespace panache::cli
