#pragma once
// The formats glTF 2.0, GLB, VRM and VRMA: a tree of nodes, animations of them, and a scene around
// it.
//
// The numbers of a clip are those of the file's nodes: a scale or a turn of a node above the body
// counts as in the file. Joints have no scale: the scales of the nodes above a joint, of any sign,
// even or not, animated or not, go into its translations on the way in, and out of them on the way
// out. A body that a scale of 0 takes away for a while keeps the size that it has at rest; a
// resting scale of 0 along one or two axes above other joints is rejected.
//
// Joints are the nodes that are in a skin, animated or named by a VRM humanoid, and all above them.
// Frames lie at the rate of the keys of the densest channel: keys at less than 20 a second get
// frames between them, keys that lie on no rate are read at 24 to 120 frames a second.
//
// The nodes of a VRM animation (.vrma) at rest are the T-pose, facing +z, whatever they look like.
// Those that carry the weights of expressions or the gaze are no joints.
//
// Everything else in a file stays: the JSON is edited in place, and new data goes to its end.

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "base/quat.h"
#include "base/result.h"
#include "clip/clip.h"
#include "clip/motion_file.h"
#include "clip/skinned_body.h"

namespace panache {

// Reads a GLB (and so a VRM) or the text of a .gltf. `name` is the file's path and stands in front
// of the message of a failure, followed by the place in the JSON. What the file points to is read
// from beside or below it, and is inside of what encode() gives; a picture that is not there stays
// an address.
//
// encode() keeps in EditMode::replace an animation's index and name, and the bytes that are no
// longer used; in add_beside the new animation goes to the end of the list. A channel whose joint
// is as it was keeps its keys, of whatever kind they are; others get linear keys at the frames, and
// a value that is as it was on a key has that key's bits. Where frames come from other times than
// their own, all channels but those of unknown extensions follow, scale and morph weights too.
//
// An animation with keys before 0, which glTF does not allow, is read with all its keys that much
// later, and so written; notes() says it.
Result<std::unique_ptr<MotionFile>> parse_gltf(std::string bytes, const std::string& name,
                                               const ReadOptions& options = {});

// The file as one skinned character, of which programs build an armature: where there is no skin,
// and no mesh on the joints, with what `make_body` makes for the motions of the file, or with
// sticks where that is nothing; where there is one skin and `completes_skin`, with the joints in it
// that no vertex follows. Others come back as they are.
Result<std::string> whole_character(
    std::string bytes, const std::string& name, bool completes_skin,
    const std::function<std::optional<SkinnedBody>(const MotionFile&)>& make_body);

// The same as parse_gltf() for a .vrma, which has to name a humanoid with hips. encode() puts an
// edit in the place of its motion whatever the mode: players take the first animation.
Result<std::unique_ptr<MotionFile>> parse_vrma(std::string bytes, const std::string& name,
                                               const ReadOptions& options = {});

// A new GLB for a clip that came from no glTF file, with a figure that any viewer shows: `body`, or
// sticks where that is null.
// Above the clip's roots stands a node named `clip_name`, which is also the animation's name, with
// the scale `metres_per_unit` (above zero) and the rotation `to_y_up`; so the numbers of the joints
// stay the clip's own. The translation of a joint with can_translate false is its offset in the
// file, whatever the poses say. End Sites become nodes without children.
std::string format_glb(const Clip& clip, const std::string& clip_name, double metres_per_unit,
                       Quat to_y_up, const SkinnedBody* body = nullptr);

// A new VRM animation, whose humanoid are the joints that have a role. The skeleton stands in
// T-pose with rest rotations of the identity, in metres, with +Y up and facing +z; there are hips,
// and of the joints with a role only they translate.
std::string format_vrma(const Clip& clip, const std::string& clip_name);

}  // namespace panache
