#include "format_clip.h"

#include "clip/bvh.h"
#include "clip/gltf.h"
#include "clip/rest_axes.h"
#include "retarget/retarget.h"
#include "retarget/t_pose_body.h"
#include "rig/rig_body.h"
#include "rig/up_axis.h"

namespace panache::web {
namespace {

constexpr const char* kName = "styled";

// As panache convert writes it: the body is as long in arms and legs as the rig.
Result<std::string> vrma_of(const Clip& clip, const Rig& rig) {
  const Clip body = t_pose_body(clip, rig);
  const Result<Rig> onto = Rig::create(body);
  if (!onto) return onto.error();
  const Result<Retargeted> done = retarget(clip, rig, body, *onto, {.feet = false, .hands = false});
  if (!done) return done.error();
  return format_vrma(done->clip, kName);
}

}  // namespace

Result<std::string> format_clip(const Clip& clip, const Rig& rig, ConstPose reference,
                                const std::string& extension) {
  if (extension == ".vrma") return vrma_of(clip, rig);
  if (extension != ".bvh") {
    const Quat to_y_up = turn_up(rig.up_axis()).value_or(Quat{});
    const SkinnedBody body = make_rig_body(rig, reference);
    return format_glb(clip, kName, static_cast<double>(rig.unit()), to_y_up, &body);
  }
  Clip out = in_rest_axes(clip);
  add_end_sites(out.skeleton);
  return format_bvh(out);
}

}  // namespace panache::web
