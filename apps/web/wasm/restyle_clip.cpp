#include "restyle_clip.h"

#include <algorithm>

#include "clip/bvh.h"
#include "clip/gltf.h"
#include "clip/rest_axes.h"
#include "rig/up_axis.h"

namespace panache::web {
namespace {

void append(Clip& clip, ConstPose pose) {
  clip.rotations.insert(clip.rotations.end(), pose.rotations.begin(), pose.rotations.end());
  clip.translations.insert(clip.translations.end(), pose.translations.begin(),
                           pose.translations.end());
  ++clip.frames;
}

}  // namespace

Result<RestyledClip> restyle_clip(const Clip& clip, const Rig& rig,
                                  std::shared_ptr<const Model> model,
                                  std::span<const float> strengths, const Shape& shape) {
  Result<Character> character = Character::create(std::move(model), rig);
  if (!character) return character.error();
  RestyledClip result;
  result.clip.skeleton = clip.skeleton;
  result.clip.frame_time = clip.frame_time;
  // A calibration pose in front is no motion: it stays what it is.
  const int first = std::min(rig.first_frame(), clip.frames - 1);
  for (int f = 0; f < first; ++f) {
    append(result.clip, clip.pose(f));
    result.source_frames.push_back(f);
  }
  std::vector<Quat> in_rotations(clip.joints()), out_rotations(clip.joints());
  std::vector<Vec3> in_translations(clip.joints()), out_translations(clip.joints());
  const Pose in{in_rotations, in_translations}, out{out_rotations, out_translations};
  double frame = first, advance = 0;
  while (frame <= clip.frames - 1 + 1e-6) {
    sample(clip, frame, in);
    character->step(in, strengths, shape, advance * clip.frame_time, clip.frame_time, out);
    append(result.clip, out);
    result.source_frames.push_back(frame);
    advance = character->rate();
    frame += advance;
  }
  return result;
}

std::string format_clip(const Clip& clip, const Rig& rig, const std::string& ending) {
  if (ending != ".bvh") {
    const Quat to_y_up = turn_up(rig.up_axis()).value_or(Quat{});
    return format_glb(clip, "styled", static_cast<double>(rig.scale()), to_y_up);
  }
  Clip out = in_rest_axes(clip);
  add_end_sites(out.skeleton);
  return format_bvh(out);
}

}  // namespace panache::web
