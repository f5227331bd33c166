#pragma once
// A glTF file in memory: its JSON and data, unchanged, and their meaning for motion. Private to the
// folder.

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "clip/clip.h"
#include "clip/gltf_container.h"
#include "clip/gltf_track.h"
#include "clip/motion_file.h"
#include "clip/stretch.h"

namespace panache {

struct GltfNode {
  std::string name;  // "node 7" if the file has none.
  int parent = -1;
  std::vector<int> children;
  Vec3 translation;         // As in the file.
  Quat rotation;            // As in the file, perhaps not unit.
  Vec3d scale = {1, 1, 1};  // As in the file; a matrix's scale is only in `own`.
  NodeScale own;            // Its effect on the joint and those below it.
  bool matrix = false;      // Placed by a matrix, so it cannot be animated.
  bool skinned = false;     // A joint of a skin.
  bool carrier = false;     // Its transform is the weight of an expression or a gaze: not a joint.
  bool end = false;         // An End Site of its parent, which only marks a direction: not a joint.
  bool moves = false;       // In a skin, named in a humanoid, animated, or above such a node.
  int joint = -1;           // In the clips' skeleton; -1 if it does not move.
  std::string role;         // See Joint.
  int skin = -1;            // See Joint.
  float skin_weight = 0;
};

// The member of a node's extras that is true for an End Site (Joint::ends). A skin includes it as a
// joint, so that programs know the direction of the last joint of a limb.
inline constexpr const char* kEndSite = "panacheEndSite";

// The property that an animation channel moves.
enum class GltfPath { rotation, translation, scale, weights, other };

struct GltfChannel {
  int sampler = -1;
  int node = -1;
  // `other` for unsupported channels: they stay as they are, whatever happens to the rest.
  GltfPath path = GltfPath::other;
};

struct GltfAnimation {
  std::string name;       // See MotionFile::clip_names().
  double start = 0;       // Time of the clip's first frame in the file, seconds.
  bool has_rate = false;  // The keys of joints give the clip's rate; otherwise it is a usual one.
  Clip clip;
  std::vector<GltfChannel> channels;  // [channels of the file]
};

struct GltfDocument {
  GltfContainer container;
  std::vector<GltfNode> nodes;
  std::vector<int> joint_nodes;  // [joints]
  Skeleton skeleton;             // In the rest pose.
  std::vector<GltfAnimation> animations;
  Clip rest;                       // One frame; the clip of a file without animations.
  std::vector<std::string> notes;  // See MotionFile::notes().
};

// Limits, so that no small file gives a large motion or takes long to read.
inline constexpr size_t kGltfMaxNodes = 10'000;
inline constexpr int kGltfMaxDepth = 1'000;
inline constexpr size_t kGltfMaxNameBytes = 1'000;
inline constexpr size_t kGltfMaxFrames = 500'000;  // In an animation.
inline constexpr size_t kGltfMaxAnimations = 10'000;
inline constexpr size_t kGltfMaxSkeletons = 1'000'000;  // Joints times animations.
// Joints times frames of all animations of a file of `bytes`. Frames between keys take no bytes.
inline size_t gltf_max_poses(size_t bytes) { return std::max<size_t>(3'000'000, 4 * bytes); }
// Numbers in all channels together, or in the joint weights of all vertices; a byte may be read
// several times.
inline size_t gltf_max_values(size_t bytes) { return std::max<size_t>(10'000'000, 4 * bytes); }

// gltf_nodes.cpp: the tree of nodes, and what skins and humanoids say about them.
bool read_gltf_nodes(GltfDocument& document, GltfChecker& checker);
// gltf_animation.cpp: the mesh vertices that follow each node; `container` is the document's, or an
// unpacked one.
void read_gltf_weights(const GltfContainer& container, GltfDocument& document);
// gltf_animation.cpp: the targets of the animations.
bool read_gltf_channels(GltfDocument& document, GltfChecker& checker);
// gltf_nodes.cpp: the joints and the rest pose, once it is known which nodes move.
bool build_gltf_skeleton(GltfDocument& document, GltfChecker& checker);
// gltf_animation.cpp: the clips. With `fps`, clips whose keys give a rate get this many frames a
// second.
bool read_gltf_clips(GltfDocument& document, GltfChecker& checker, std::optional<double> fps);

// gltf_retime.cpp: the file with corrected times: all samplers of an animation that begins before 0
// are shifted together to begin at 0; of keys at one time, the later ones follow at the next
// instants; and with `fps`, each animation whose keys give a rate (GltfAnimation::has_rate) gets
// this rate. `bytes` stays empty if nothing changes. Old keys stay in the data, unused.
struct RetimedGltf {
  std::string bytes;
  std::vector<std::string> notes;  // What was wrong, for MotionFile::notes().
};
// Fails if there would be too many new keys.
bool retime_gltf(const GltfDocument& document, std::optional<double> fps, const std::string& name,
                 GltfChecker& checker, RetimedGltf& out);

// The keys of a channel of animation `which`. Fails only while the file is being read: keys that
// were read once can be read again.
bool read_gltf_track(const GltfDocument& document, size_t which, const GltfChannel& channel,
                     GltfChecker& checker, GltfTrack& out);
// The same for a joint without a channel: its rest value.
GltfTrack rest_gltf_track(const GltfNode& node, GltfPath path);

// vrma_rest.cpp: the rest pose of a VRM animation. Players apply to an avatar the rotation of each
// humanoid joint relative to its rest pose in the file, which they take for the T-pose, facing +z,
// whatever it is. `rest` is the file's own, one frame, with the roles of its joints. Returns the
// offsets [joints] that put the same rest rotations in a T-pose: arms along x, legs down, toes
// ahead; a torso that leans, curves or turns away by more than 30 degrees is made upright and faces
// +z.
std::vector<Vec3> t_pose_offsets(const Clip& rest);

// Gives `clip`, which has the same joints, these offsets. Of the joints that have a role, or are
// below one, only the hips keep their translations: players ignore all others.
void stand_in_t_pose(const std::vector<Vec3>& offsets, Clip& clip);

// A rotation of the file as in the clip: unit, with the half turn of the node's own scale.
Quat clip_rotation(Quat in_file, Quat scale_turn);
// The inverse.
Quat file_rotation(Quat in_clip, Quat scale_turn);

}  // namespace panache
