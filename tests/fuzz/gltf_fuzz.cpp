// GLB, glTF with its data inside, VRM and VRMA. Half of the mutations of a GLB are of its JSON.

#include "clip/gltf.h"
#include "framed_json.h"
#include "use_motion.h"

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t max,
                                          unsigned int seed) {
  return panache::fuzz::mutate_glb(data, size, max, seed);
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace panache;
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  fuzz::use(parse_gltf(bytes, "in.glb"), ".glb", parse_gltf);
  fuzz::use(parse_vrma(bytes, "in.vrma"), ".vrma", parse_vrma);
  return 0;
}
