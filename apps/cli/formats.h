#pragma once
// Which formats are written, and motions brought from one to another.

#include <span>
#include <string>

#include "base/quat.h"
#include "base/result.h"
#include "clip/motion_file.h"
#include "rig/rig.h"

namespace panache::cli {

// Whether a file with the ending `input` keeps its format where it is written with the ending
// `output`, and with it all that is in it beside motion. Those of glTF count as one: an FBX file is
// a GLB by then.
bool keeps_format(const std::string& input, const std::string& output);
// What a file gave that keeps its format, in the container that the output's ending asks for.
Result<std::string> in_container(std::string bytes, const std::string& input,
                                 const std::string& output);

// Refuses an output whose ending is none that its input can be written with.
Result<void> check_format(const std::string& input, const std::string& output);

// Refuses several motions where the output's format holds a single one.
Result<void> check_fits(const MotionFile& file, std::span<const int> clips,
                        const std::string& input, const std::string& output);

// How a clip stands in a world of metres with +Y up.
struct Placement {
  float metres_per_unit = 1;
  Quat y_up;
};
Placement placement_of(const Rig& rig);
// Of a skeleton that is no humanoid; what is not given is metres and +Y.
Placement placement_of(const RigOptions& options);

// A new file of this motion alone: ".bvh", whose rest pose is the skeleton's and whose units and
// axes are the clip's, or ".glb", in metres with +Y up.
std::string format_clip(const Clip& clip, const std::string& name, const Placement& placement,
                        const std::string& ending);

}  // namespace panache::cli
