#include "format_clip.h"

#include "clip/bvh.h"
#include "clip/gltf.h"
#include "clip/rest_axes.h"
#include "rig/up_axis.h"

namespace panache::web {

std::string format_clip(const Clip& clip, const Rig& rig, const std::string& extension) {
  if (extension != ".bvh") {
    const Quat to_y_up = turn_up(rig.up_axis()).value_or(Quat{});
    return format_glb(clip, "styled", static_cast<double>(rig.unit()), to_y_up);
  }
  Clip out = in_rest_axes(clip);
  add_end_sites(out.skeleton);
  return format_bvh(out);
}

}  // namespace panache::web
