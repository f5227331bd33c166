#pragma once
// A glTF file in memory: its JSON and data, unchanged, and their meaning for motion. Private
// to the folder.

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "clip/clip.h"
#include "clip/gltf_container.h"
#include "clip/gltf_track.h"
#include "clip/stretch.h"
#include "clip/unique_name.h"

namespace panache {

struct GltfNode {
  std::string name;  // "node 7" where the file has none.
  int parent = -1;
  std::vector<int> children;
  Vec3 translation;         // As in the file.
  Quat rotation;            // As in the file, perhaps not unit.
  Vec3d scale = {1, 1, 1};  // As in the file; of a matrix in `own` alone.
  NodeScale own;            // Its effect on the joint and those below it.
  bool matrix = false;      // Placed by a matrix, so that nothing may animate it.
  bool skinned = false;     // A joint of a skin.
  bool carrier = false;     // Its transform is the weight of an expression or a gaze: no joint.
  bool end = false;         // An End Site of its parent, which only points somewhere: no joint.
  bool moves = false;       // In a skin, named in a humanoid, animated, or above such a node.
  int joint = -1;           // In the clips' skeleton; -1 for one that does not move.
  std::string role;         // As in Joint.
  int skin = -1;            // As in Joint.
  float skin_weight = 0;
};

// The member of a node's extras that is true where the node is an End Site (Joint::ends). A skin
// has it as a joint, so that programs know where the last joint of a limb points.
inline constexpr const char* kEndSite = "panacheEndSite";

// The property that a channel of an animation moves.
enum class GltfPath { rotation, translation, scale, weights, other };

struct GltfChannel {
  int sampler = -1;
  int node = -1;
  // `other` where it is not ours to understand: such a channel stays as it is, whatever becomes of
  // the rest.
  GltfPath path = GltfPath::other;
};

struct GltfAnimation {
  std::string name;       // As MotionFile::clip_names() says it.
  double start = 0;       // Seconds in the file, of the clip's first frame.
  bool has_rate = false;  // Keys of joints say the clip's rate; else it is a usual one.
  Clip clip;
  std::vector<GltfChannel> channels;  // [channels of the file]
};

struct GltfDocument {
  GltfContainer container;
  std::vector<GltfNode> nodes;
  std::vector<int> joint_nodes;  // [joints]
  Skeleton skeleton;             // Of the rest pose.
  std::vector<GltfAnimation> animations;
  Clip rest;                       // One frame; the clip of a file without animations.
  std::vector<std::string> notes;  // As MotionFile::notes().
};

// Limits of a file, so that no small file makes a large motion or takes long to read.
inline constexpr size_t kGltfMaxNodes = 10'000;
inline constexpr int kGltfMaxDepth = 1'000;
inline constexpr size_t kGltfMaxNameBytes = 1'000;
inline constexpr size_t kGltfMaxFrames = 500'000;  // Of an animation.
inline constexpr size_t kGltfMaxAnimations = 10'000;
inline constexpr size_t kGltfMaxSkeletons = 1'000'000;  // Joints times animations.
// Joints times frames of all animations, where the file has `bytes`. Frames between keys take none.
inline size_t gltf_max_poses(size_t bytes) { return std::max<size_t>(3'000'000, 4 * bytes); }
// Numbers that all channels have, or those that all vertices have in the joints' weights; each
// byte may be read by several.
inline size_t gltf_max_values(size_t bytes) { return std::max<size_t>(10'000'000, 4 * bytes); }

// gltf_nodes.cpp: the tree of nodes, with what skins and humanoids say of them.
bool read_gltf_nodes(GltfDocument& document, GltfChecker& checker);
// gltf_weights.cpp: what of the meshes follows each node; `container` is the document's, or the
// same without packed data.
void read_gltf_weights(const GltfContainer& container, GltfDocument& document);
// gltf_animation.cpp: what the animations move.
bool read_gltf_channels(GltfDocument& document, GltfChecker& checker);
// gltf_nodes.cpp: the joints and the rest pose, once it is known which nodes move.
bool build_gltf_skeleton(GltfDocument& document, GltfChecker& checker);
// gltf_animation.cpp: the clips. Where `fps` is given, the frames of those whose keys say a rate
// lie so many a second.
bool read_gltf_clips(GltfDocument& document, GltfChecker& checker, std::optional<double> fps);

// gltf_retime.cpp: the file with other times: no sampler of an animation that begins before 0 does
// so any more, all of them moved together; and where `fps` is given, the frames of each animation
// whose keys say a rate (GltfAnimation::has_rate) lie so many a second. `bytes` stays empty where
// all is as it should be. Old keys stay in the data, unused.
struct RetimedGltf {
  std::string bytes;
  std::vector<std::string> notes;  // Which animations began before 0, as MotionFile::notes().
};
// Fails where the new keys were too many.
bool retime_gltf(const GltfDocument& document, std::optional<double> fps, const std::string& name,
                 GltfChecker& checker, RetimedGltf& out);

// The keys of a channel of animation `which`. Fails only while the file is being read: what was
// read once can be read again.
bool read_gltf_track(const GltfDocument& document, size_t which, const GltfChannel& channel,
                     GltfChecker& checker, GltfTrack& out);
// The same for a joint that no channel moves: where it rests.
GltfTrack rest_gltf_track(const GltfNode& node, GltfPath path);

// vrma_rest.cpp: the rest pose of a VRM animation. Players give an avatar what each joint of the
// humanoid turns by against its rest pose in the file, whatever that pose is: to them it is the
// T-pose, facing +z. `rest` is the file's own, one frame, with the roles of its joints. Returns the
// offsets [joints] with which the same rest rotations stand in a T-pose: arms along x, legs down,
// toes ahead; a torso that leans, curves or faces elsewhere by more than 30 degrees is upright and
// faces +z.
std::vector<Vec3> t_pose_offsets(const Clip& rest);

// Gives `clip`, of the same joints, these offsets. Of the joints that have a role, or hang below
// one, only the hips keep their translations: players ignore all others.
void stand_in_t_pose(const std::vector<Vec3>& offsets, Clip& clip);

// A rotation of the file as the clip has it: unit, with the half turn of the node's own scale.
Quat clip_rotation(Quat in_file, Quat scale_turn);
// The same back.
Quat file_rotation(Quat in_clip, Quat scale_turn);

}  // namespace panache
