// An .asf, or behind a byte 0 an .amc for the skeleton of a walk.

#include <fstream>

#include "clip/acclaim.h"
#include "clip/bvh.h"
#include "clip/make_acclaim.h"
#include "make_clip.h"
#include "temporary_folder.h"
#include "use_motion.h"

namespace {

using namespace panache;

// The path of an .amc beside its skeleton, for as long as the program runs.
const std::string& amc_path() {
  static const test::TemporaryFolder folder;
  static const std::string path = [] {
    const Clip walk = test::walking_clip(1);
    std::ofstream(folder.path() + "in.asf") << test::AcclaimMaker(walk).asf();
    return folder.path() + "in.amc";
  }();
  return path;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  if (text.empty() || text[0] != '\0') {
    const Result<Skeleton> skeleton = parse_asf(text, "in.asf");
    if (skeleton && skeleton->joints.empty()) fuzz::fail("a skeleton without joints");
    return 0;
  }
  fuzz::use(parse_amc(text.substr(1), amc_path()), ".bvh", parse_bvh);
  return 0;
}
