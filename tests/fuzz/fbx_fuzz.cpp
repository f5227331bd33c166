// FBX, binary and text, of versions 6 and 7: read, styled, written in every way and read again.

#include "clip/fbx.h"
#include "clip/fbx_nodes.h"
#include "use_motion.h"

namespace {

using namespace panache;

// What is written must be readable, and have the motions that it should have.
void write_in_every_mode(const std::string& bytes) {
  const auto file = parse_fbx(bytes, "in.fbx");
  if (!file) return;
  const Clip& clip = (*file)->clip(0);
  if (clip.joints() > 100 || clip.frames > 60) return;
  const size_t count = (*file)->clip_names().size();
  if ((*file)->encode({}, EditMode::replace) != bytes) fuzz::fail("an unchanged file has changed");
  Clip changed = clip;
  std::vector<double> frames;
  for (int f = 0; f < clip.frames; ++f) {
    frames.push_back(0.7 * f);
    const Pose pose = changed.pose(f);
    pose.rotations[0] = normalized(pose.rotations[0] * Quat{0.1f, 0.2f, 0.3f, 0.9f});
    pose.translations.back().x += 0.1f;
  }
  const Clip rest = (*file)->rest();
  for (const ClipEdit& edit :
       {ClipEdit{0, &changed, frames, "a"}, ClipEdit{kNewClip, &rest, {}, ""}}) {
    for (const EditMode mode : {EditMode::replace, EditMode::add_beside, EditMode::add_first}) {
      const std::string written = (*file)->encode({&edit, 1}, mode);
      const auto again = parse_fbx(written, "again.fbx");
      if (!again) fuzz::fail("what was written cannot be read: " + again.error().message);
      if (mode == EditMode::replace) continue;
      if ((*again)->clip_names().size() < count) fuzz::fail("a motion is lost");
    }
  }
  const auto slow = parse_fbx(bytes, "in.fbx", {.fps = 12.0});
  if (!slow && slow.error().message.empty()) fuzz::fail("an error without a message");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  fuzz::use(parse_fbx(bytes, "in.fbx"), ".fbx", parse_fbx);
  write_in_every_mode(bytes);
  const Result<FbxScene> scene = read_fbx_scene(bytes, "in.fbx");
  if (!scene && scene.error().message.empty()) fuzz::fail("an error without a message");
  return 0;
}
