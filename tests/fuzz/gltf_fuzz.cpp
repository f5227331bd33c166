// GLB, glTF with its data inside, VRM and VRMA. Half of the mutations of a GLB are of its JSON.

#include <algorithm>

#include "clip/gltf.h"
#include "framed_json.h"
#include "use_motion.h"

namespace {
constexpr size_t kHeader = 20;  // Of the file and of its first chunk.
}

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t most,
                                          unsigned int seed) {
  using namespace panache::fuzz;
  if (size < kHeader || std::memcmp(data, "glTF", 4) != 0 || seed % 2 == 0) {
    return LLVMFuzzerMutate(data, size, most);
  }
  const size_t length = std::min<size_t>(read_number<uint32_t>(data + 12), size - kHeader);
  std::string json(reinterpret_cast<char*>(data) + kHeader, length);
  const std::string rest(reinterpret_cast<char*>(data) + kHeader + length, size - kHeader - length);
  mutate(json, std::min(most, size + 64) - std::min(most, size) + length);
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const std::string file = "glTF" + bytes_of<uint32_t>(2) +
                           bytes_of(static_cast<uint32_t>(kHeader + json.size() + rest.size())) +
                           bytes_of(static_cast<uint32_t>(json.size())) + "JSON" + json + rest;
  return put(file, data, most);
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace panache;
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  fuzz::use(parse_gltf(bytes, "in.glb"), ".glb", parse_gltf);
  fuzz::use(parse_vrma(bytes, "in.vrma"), ".vrma", parse_vrma);
  return 0;
}
