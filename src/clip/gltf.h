#pragma once
// The formats glTF 2.0, GLB, VRM and VRMA: a tree of nodes, their animations, and the scene around
// them.
//
// The numbers of a clip are those of the file's nodes: scales and rotations of nodes above the body
// apply as in the file. Joints have no scale: the scales of the nodes above a joint (of any sign,
// uniform or not, animated or not) are applied to its translations on reading, and removed on
// writing. A body that is temporarily scaled to 0 keeps its size at rest; a resting scale of 0
// along one or two axes above other joints is rejected.
//
// Joints are the nodes that are in a skin, animated or named by a VRM humanoid, and all above them.
// Frames have the rate of the keys of the densest channel: keys at less than 20 a second get frames
// between them, keys without a constant rate are read at 24 to 120 frames a second.
//
// The rest pose of a VRM animation (.vrma) is the T-pose, facing +z, whatever its nodes look like.
// Nodes that carry the weights of expressions or the gaze are not joints.
//
// Everything else in a file stays: the JSON is edited in place, and new data is appended.

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "base/quat.h"
#include "base/result.h"
#include "clip/clip.h"
#include "clip/motion_file.h"

namespace panache {

// Reads a GLB (and so a VRM) or the text of a .gltf. `name` is the file's path; error messages
// start with it and the path in the JSON. Referenced files are read from the file's folder or
// below, and are embedded in what encode() returns; a missing picture stays a reference.
//
// In EditMode::replace, encode() keeps an animation's index and name, and the bytes that are no
// longer used; in add_beside the new animation goes to the end of the list. A channel whose joint
// is unchanged keeps its keys, of whatever kind; others get linear keys at the frames, and a value
// that is unchanged on a key has the bits of that key. If frames come from other times than their
// own, all channels but those of unknown extensions follow, including scale and morph weights.
//
// An animation with keys before 0, which glTF does not allow, is shifted to start at 0, in the
// output too; notes() says so.
Result<std::unique_ptr<MotionFile>> parse_gltf(std::string bytes, const std::string& name,
                                               const ReadOptions& options = {});

// The file as one skinned character, from which programs build an armature. Without a skin, and
// without a mesh on the joints, it gets what `make_body` makes for the file's motions, or sticks if
// that is nothing. With a single skin and `completes_skin`, the skin gets the joints that no vertex
// follows. Other files are returned unchanged.
Result<std::string> whole_character(
    std::string bytes, const std::string& name, bool completes_skin,
    const std::function<std::optional<SkinnedBody>(const MotionFile&)>& make_body);

// The same as parse_gltf() for a .vrma, which must name a humanoid with hips. encode() always
// replaces the motion, whatever the mode, because players take the first animation.
Result<std::unique_ptr<MotionFile>> parse_vrma(std::string bytes, const std::string& name,
                                               const ReadOptions& options = {});

// A new GLB for a clip that came from no glTF file, with a figure for viewers: `body`, or sticks if
// that is null. Above the clip's roots is a node named `clip_name`, which is also the animation's
// name, with the scale `metres_per_unit` (above zero) and the rotation `to_y_up`, so that joints
// keep the clip's numbers. The translation of a joint with can_translate false is its offset,
// whatever the poses say. End Sites become nodes without children.
std::string format_glb(const Clip& clip, const std::string& clip_name, double metres_per_unit,
                       Quat to_y_up, const SkinnedBody* body = nullptr);

// A new VRM animation, whose humanoid consists of the joints that have a role. The skeleton must be
// in T-pose with identity rest rotations, in metres, with +Y up and facing +z; it must have hips,
// and of the joints with a role only they translate.
std::string format_vrma(const Clip& clip, const std::string& clip_name);

// Packed data in glTF files (EXT_meshopt_compression), which a program may decode.

enum class MeshoptMode { attributes, triangles, indices };
enum class MeshoptFilter { none, octahedral, quaternion, exponential };

// A packed part of a buffer, with values that the extension allows.
struct MeshoptView {
  MeshoptMode mode = MeshoptMode::attributes;
  MeshoptFilter filter = MeshoptFilter::none;  // For attributes only.
  size_t count = 0;                            // Elements, at least one; whole triangles.
  size_t stride = 0;  // Bytes of an element: attributes 4 to 256, a multiple of 4; indices 2 or 4.
};

// Decodes `packed`, which may be any bytes, to view.count * view.stride bytes at `out`; false if
// that fails.
using MeshoptDecoder = bool (*)(const MeshoptView& view, std::string_view packed, char* out);

// Sets the decoder of packed motion; null, the default, rejects packed motion. Called before any
// thread reads.
void set_meshopt_decoder(MeshoptDecoder decoder);

}  // namespace panache
