#include "format_clip.h"

#include "clip/bvh.h"
#include "clip/gltf.h"
#include "clip/rest_axes.h"
#include "rig/rig_body.h"
#include "rig/up_axis.h"

namespace panache::web {

std::string format_clip(const Clip& clip, const Rig& rig, ConstPose reference,
                        const std::string& extension) {
  if (extension != ".bvh") {
    const Quat to_y_up = turn_up(rig.up_axis()).value_or(Quat{});
    const SkinnedBody body = make_rig_body(rig, reference);
    return format_glb(clip, "styled", static_cast<double>(rig.unit()), to_y_up, &body);
  }
  Clip out = without_still_root(in_rest_axes(clip));
  add_end_sites(out.skeleton);
  return format_bvh(out);
}

}  // namespace panache::web
