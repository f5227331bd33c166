// The GLB that the process answers which reads FBX, and a .gltf on its way into a GLB: what the
// program itself does to them.

#include "clip/gltf.h"
#include "framed_json.h"
#include "glb.h"
#include "temporary_folder.h"
#include "use_motion.h"

namespace {

using namespace panache;

// As panache convert in.gltf -o out.glb has it.
void put_into_glb(const std::string& bytes) {
  const Result<std::unique_ptr<MotionFile>> file = parse_gltf(bytes, "in.gltf");
  if (!file || bytes.empty() || bytes[0] == 'g') return;
  const Result<std::string> glb =
      cli::gltf_to_glb((*file)->encode({}, EditMode::replace), "in.gltf");
  if (!glb) {
    if (glb.error().message.empty()) fuzz::fail("an error without a message");
    return;
  }
  const Result<std::unique_ptr<MotionFile>> again = parse_gltf(*glb, "out.glb");
  if (!again) fuzz::fail("what was put into a GLB cannot be read: " + again.error().message);
}

}  // namespace

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t max,
                                          unsigned int seed) {
  return fuzz::mutate_glb(data, size, max, seed);
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const test::TemporaryFolder folder;
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  const std::string path = folder.path() + "in.fbx";
  std::vector<std::string> notes;
  const auto no_png = [](const std::string&) { return Result<std::string>(Error{"no picture"}); };
  fuzz::use(parse_gltf(cli::with_pictures(bytes, path, no_png, notes), path), ".glb", parse_gltf);
  put_into_glb(bytes);
  return 0;
}
