// An .asf, or behind a byte 0 an .amc for a skeleton of three bones.

#include <fstream>

#include "clip/acclaim.h"
#include "clip/bvh.h"
#include "temporary_folder.h"
#include "use_motion.h"

namespace {

// The path of an .amc beside its skeleton, for as long as the program runs.
const std::string& amc_path() {
  static const panache::test::TemporaryFolder folder;
  static const std::string path = [] {
    std::ofstream(folder.path() + "in.asf") << R"(:version 1.10
:name skeleton
:units
  mass 1.0
  length 0.45
  angle deg
:root
  order TX TY TZ RX RY RZ
  axis XYZ
  position 0 0 0
  orientation 0 0 0
:bonedata
  begin
    id 1
    name thigh
    direction 0 -1 0
    length 7
    axis 0 0 20 XYZ
    dof rx ry rz
  end
  begin
    id 2
    name shin
    direction 0 -1 0
    length 7
    axis 0 0 20 XYZ
    dof rx
  end
:hierarchy
  begin
    root thigh
    thigh shin
  end
)";
    return folder.path() + "in.amc";
  }();
  return path;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace panache;
  const std::string text(reinterpret_cast<const char*>(data), size);
  if (text.empty() || text[0] != '\0') {
    const Result<Skeleton> skeleton = parse_asf(text, "in.asf");
    if (skeleton && skeleton->joints.empty()) fuzz::fail("a skeleton without joints");
    return 0;
  }
  fuzz::use(parse_amc(text.substr(1), amc_path()), ".bvh", parse_bvh);
  return 0;
}
