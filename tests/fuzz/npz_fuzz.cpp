// Archives of numpy's arrays. What is in the arrays is the target smpl's.

#include "npz.h"
#include "use_motion.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace panache;
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  fuzz::use(cli::parse_npz(bytes, "in.npz"), ".npz", cli::parse_npz);
  return 0;
}
