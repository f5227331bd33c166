// BVH files.

#include "clip/bvh.h"
#include "use_motion.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace panache;
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  fuzz::use(parse_bvh(bytes, "in.bvh"), ".bvh", parse_bvh);
  return 0;
}
