#pragma once
// The format FBX, versions 6 and 7, binary and text: skeletons and their motions.
//
// A clip is in metres with +Y up, as the file's settings have it. Joints are the models that are
// called so (LimbNode), that move vertices or that are animated, and all above them. A joint's
// place follows from the whole chain of FBX (pivots, offsets, rotations before and after its own,
// orders of rotation, InheritType); joints have no scale, as in glTF (clip/gltf.h). Layers of
// animation are added up. The rest pose is that to which a skin is bound, if the motions animate
// the joint anyhow, else that in which the file was saved.
//
// Frames have the rate of the keys if they are at most 1/20 s apart, else that of the file.

#include <memory>
#include <string>
#include <vector>

#include "base/quat.h"
#include "base/result.h"
#include "clip/clip.h"
#include "clip/motion_file.h"

namespace panache {

// Reads an FBX file from its bytes. Error messages start with `name`.
//
// encode() keeps all of a file of version 7 but the curves of joints that change: those get a key
// per frame in the base layer, and other layers let go of them. If frames come from other times
// than their own, everything that the motion's layers animate follows. A changed file of version 6
// becomes a new one of version 7.4 with skeleton and motions alone.
Result<std::unique_ptr<MotionFile>> parse_fbx(std::string bytes, const std::string& name,
                                              const ReadOptions& options = {});

// A motion of a new file.
struct FbxMotion {
  const Clip* clip = nullptr;
  std::string name;
};
// A new binary file of version 7.4 with the skeleton of `rest`, in centimetres with +Y up, and
// motions of it. `rest` and the clips have `metres_per_unit` (above zero) and become +Y up by
// `to_y_up`. The rotation at rest goes into PreRotation, so that joints at rest have angles of 0.
std::string format_fbx(const Skeleton& rest, const std::vector<FbxMotion>& motions,
                       double metres_per_unit, Quat to_y_up);

}  // namespace panache
