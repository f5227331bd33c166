#pragma once
// What a user does with a motion file: looks at it, styles it, writes it and reads it again.

#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>

#include "clip/motion_format.h"
#include "make_model.h"
#include "net/safetensors.h"
#include "rig/rig.h"
#include "style/restyle.h"

namespace panache::fuzz {

// A small model with two styles, made once.
inline const std::shared_ptr<const Model>& small_model() {
  static const std::shared_ptr<const Model> model =
      *Model::parse(format_safetensors(test::make_model({"old", "proud"})), "model");
  return model;
}

[[noreturn]] inline void fail(const std::string& what) {
  std::fprintf(stderr, "fuzz: %s\n", what.c_str());
  std::abort();
}

// The file, if it was read, to the end. What this writes must be readable.
inline void use(Result<std::unique_ptr<MotionFile>> file, const std::string& extension,
                Result<std::unique_ptr<MotionFile>> (*parse)(std::string, const std::string&,
                                                             const ReadOptions&)) {
  if (!file) {
    if (file.error().message.empty()) fail("an error without a message");
    return;
  }
  // So that an input takes milliseconds.
  constexpr size_t kMaxJoints = 200;
  constexpr int kMaxFrames = 120;
  const size_t count = (*file)->clip_names().size();
  const Clip& clip = (*file)->clip(0);
  if (clip.joints() == 0 || clip.frames < 1) fail("a clip without joints or frames");
  const Result<Rig> rig = Rig::create(clip);
  if (clip.joints() > kMaxJoints || clip.frames > kMaxFrames || count == 0) return;
  std::vector<double> frames;
  for (int f = 0; f < clip.frames; ++f) frames.push_back(f);
  Clip changed = clip;
  if (rig) {
    Result<Restyled> styled = restyle(clip, *rig, small_model(), {{0, {{0, 1}}}}, {});
    if (!styled) return;
    changed = std::move(styled->clip);
    frames = std::move(styled->source_frames);
  }
  const std::string bytes = (*file)->encode(changed, frames);
  const Result<std::unique_ptr<MotionFile>> again = parse(bytes, "again" + extension, {});
  if (!again) fail("what was written cannot be read: " + again.error().message);
  if ((*again)->clip(0).joints() != clip.joints()) fail("another number of joints");
}

}  // namespace panache::fuzz
