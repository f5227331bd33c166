#include "formats.h"

#include "clip/bvh.h"
#include "clip/gltf.h"
#include "clip/rest_axes.h"
#include "glb.h"
#include "input.h"
#include "report.h"
#include "rig/up_axis.h"

namespace panache::cli {
namespace {

// Whether the nodes of the file stand as in the first frame, so that nothing is known of a rest.
bool rests_as_it_starts(const Clip& clip) {
  const ConstPose pose = clip.pose(0);
  for (size_t j = 0; j < clip.joints(); ++j) {
    const Quat rest = clip.skeleton.joints[j].rest;
    if (length((conjugate(rest) * pose.rotations[j]).xyz()) > 1e-5f) return false;
  }
  return true;
}

// Axes stay where the rest is not known.
std::string format_as_bvh(const Clip& clip) {
  Clip out = rests_as_it_starts(clip) ? clip : in_rest_axes(clip);
  add_end_sites(out.skeleton);
  return format_bvh(out);
}

}  // namespace

bool keeps_format(const std::string& input, const std::string& output) {
  return input == output ||
         (output == ".glb" && (input == ".vrm" || input == ".fbx" || input == ".gltf"));
}

Result<std::string> in_container(std::string bytes, const std::string& input,
                                 const std::string& output) {
  if (ending_of(input) != ".gltf" || ending_of(output) != ".glb") return bytes;
  return gltf_to_glb(bytes, input);
}

Result<void> check_format(const std::string& input, const std::string& output) {
  const std::string from = ending_of(input), to = ending_of(output);
  if (!is_motion_ending(from)) return {};  // Opening it says what is wrong.
  const bool is_own = to == from && from != ".fbx";
  if (is_own || to == ".bvh" || to == ".glb") return {};
  const bool has_own = from == ".gltf" || from == ".vrm";
  return Error{output + ": expected a name that ends in " + (has_own ? from + ", " : "") +
               ".bvh or .glb, or a folder (with a '/' at its end)"};
}

Result<void> check_fits(const MotionFile& file, std::span<const int> clips,
                        const std::string& input, const std::string& output) {
  if (clips.size() == 1 || keeps_format(ending_of(input), ending_of(output))) return {};
  return Error{input + ": holds " + plural(clips.size(), "motion") + " (" + list_clips(file) +
               ") and " + output + " takes one; --clip NAME picks it"};
}

Placement placement_of(const Rig& rig) { return {rig.scale(), *turn_up(rig.up_axis())}; }

Placement placement_of(const RigOptions& options) {
  return {options.metres_per_unit.value_or(1),
          turn_up(options.up_axis.value_or("+Y")).value_or(Quat{})};
}

std::string format_clip(const Clip& clip, const std::string& name, const Placement& placement,
                        const std::string& ending) {
  if (ending == ".bvh") return format_as_bvh(clip);
  return format_glb(clip, name, static_cast<double>(placement.metres_per_unit), placement.y_up);
}

}  // namespace panache::cli
