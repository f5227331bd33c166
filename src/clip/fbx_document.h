#pragma once
// What an FBX file says about motion: its models, which include the joints, and its animation.
// Private to the folder.

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/quat.h"
#include "clip/clip.h"
#include "clip/euler.h"
#include "clip/fbx_tree.h"
#include "clip/stretch.h"

namespace panache {

// The curves of an FBX file: numbers as functions of time. Private to the folder.

inline constexpr double kFbxSecond = 46'186'158'000;  // In FBX time units.
// 18 days, which keeps differences of times far from overflow.
inline constexpr int64_t kFbxLatest = int64_t{1} << 56;

struct FbxKey {
  // Up to the next key: its value, the next key's value, a straight line, or a Bezier curve.
  enum class Kind : uint8_t { constant, next, linear, cubic };

  int64_t time = 0;
  double value = 0;
  Kind kind = Kind::linear;
  bool is_auto = false;     // A cubic whose slopes come from the keys around it.
  bool is_clamped = false;  // Such a slope is 0 where the key is as high as one beside it.
  // Slopes (per second) at this key and at the next, and how far in time the handles reach, of the
  // time between the keys.
  float slope = 0, next_slope = 0, weight = 1.0f / 3, next_weight = 1.0f / 3;
};

struct FbxCurve {
  std::vector<FbxKey> keys;  // By time, each later than the one before.

  // Constant before the first key and behind the last; `fallback` without keys.
  double at(int64_t time, double fallback) const;
  // Whether it jumps only, and so stays a step in other keys.
  bool is_step() const;
};

// An AnimationCurve of FBX 7.
Result<FbxCurve> read_fbx_curve(const FbxTree& tree, const FbxNode& node);
// A channel of FBX 6 that has keys, or none.
Result<FbxCurve> read_fbx6_channel(const FbxTree& tree, const FbxNode& node);

// What curves animate of a model.
enum FbxPart : size_t { kFbxTranslation, kFbxRotation, kFbxScale };
inline constexpr const char* kFbxPartNames[] = {"Lcl Translation", "Lcl Rotation", "Lcl Scaling"};

// "OO", "OP": child, parent, and for "OP" the parent's property. Objects have numbers as IDs in FBX
// 7, and names in FBX 6.
struct FbxConnection {
  std::string child, parent, property;
  const FbxNode* node = nullptr;
};

struct FbxSettings {
  int up_axis = 1, up_sign = 1, side_axis = 0, side_sign = 1;
  double centimetres = 1;         // Per unit.
  double rate = 30;               // Frames a second.
  const FbxNode* node = nullptr;  // The global settings, if there are any.

  // From the file's axes to x at the side and y up.
  Quatd to_y_up() const;
};

// Translation and scale in the file's unit, Euler angles in degrees: the animated numbers, by part.
struct FbxChannels {
  std::array<Vec3d, 3> parts = {Vec3d{}, Vec3d{}, Vec3d{1, 1, 1}};
};

// A transform relative to the parent: scale, then rotation, then translation.
struct FbxLocal {
  Vec3d translation;
  Quatd rotation;
  Vec3d scale = {1, 1, 1};
};

struct FbxModel {
  // How the scales of those above act, by the names of FBX: before the rotation of the model, after
  // it (as in a product of matrices), or before it and without that of the parent itself.
  enum class Inherit { RrSs, RSrs, Rrs };

  std::string name;       // Unique.
  std::string file_name;  // As in the file.
  std::string id;
  std::string kind;  // "LimbNode", "Mesh", ...
  const FbxNode* node = nullptr;
  int parent = -1;       // An index smaller than the model's own, or -1.
  FbxChannels channels;  // At the time of saving.
  EulerOrder order = {3, {2, 1, 0}};
  Quatd before, after;  // Constant factors left and right of the rotation.
  Vec3d rotation_offset, rotation_pivot, scale_offset, scale_pivot;
  Inherit inherit = Inherit::RSrs;
  FbxLocal geometry;  // Of a mesh in the model; children do not inherit it.
  int joint = -1;     // In the clips' skeleton; -1 for none.

  bool is_camera_or_light() const;
  // T Roff Rp Rpre R Rpost^-1 Rp^-1 Soff Sp S Sp^-1, which has no shear.
  FbxLocal local(const FbxChannels& at) const;
  // What the pivots add to T if the model's rotation, `before` and `after` included, is this one.
  Vec3d pivot_shift(Quatd rotation, Vec3d scale) const;
  // The part of it that the rotation turns.
  Vec3d below_rotation(Vec3d scale) const;
  Quatd rotation_of(Vec3d degrees) const;
  // The angles nearest to `near` (degrees) that give this rotation.
  Vec3d angles_of(Quatd rotation, Vec3d near) const;
};

// The animation of one property in one layer.
struct FbxCurveNode {
  std::string id;
  const FbxNode* node = nullptr;               // Null in FBX 6.
  std::vector<FbxConnection> targets;          // The properties that it animates.
  std::array<std::optional<double>, 3> still;  // By axis, where there is no curve.
  std::array<FbxCurve, 3> curves;              // Empty for an axis without a curve.
  // All its curves, of other properties too: ID and where each is connected.
  std::vector<FbxConnection> curve_links;
};

struct FbxLayer {
  enum class Blend { add, replace };

  std::string id;
  const FbxNode* node = nullptr;
  Blend blend = Blend::add;
  bool is_muted = false, is_solo = false;
  bool adds_angles = true;        // Else it adds rotations.
  bool multiplies_scales = true;  // Else it adds scales.
  double weight = 1;
  FbxCurve weight_curve;  // In per cent; empty if the weight is constant.
  std::vector<FbxCurveNode> nodes;
  std::map<std::pair<size_t, size_t>, size_t> by_target;  // Index in `nodes` by model and part.
  std::vector<const FbxConnection*> links;                // Of its nodes to it.
};

struct FbxDocument;

struct FbxStack {
  std::string name;  // See MotionFile::clip_names().
  std::string id;
  const FbxNode* node = nullptr;
  std::vector<FbxLayer> layers;  // The base layer first.
  int64_t begin = 0, end = 0;    // Times of the first and last keys of models.
  Clip clip;

  // Whether anything animates this part of the model.
  bool animates(size_t model, size_t part) const;
  // The time of a frame of the clip.
  int64_t time_of(double frame) const;
  // The numbers of a model at `time`, as all layers together have them.
  FbxChannels channels(const FbxDocument& document, size_t model, int64_t time) const;
};

struct FbxDocument {
  explicit FbxDocument(FbxTree of) : tree(std::move(of)) {}
  // Whether objects have names instead of numbers, and curves are in takes.
  bool is_version_6() const;

  FbxTree tree;
  FbxSettings settings;
  std::vector<FbxConnection> connections;
  std::vector<FbxModel> models;
  std::vector<FbxStack> stacks;   // Those with keys.
  std::vector<int> joint_models;  // [joints]
  Clip rest;                      // One frame.
  // The models that vertices of a mesh follow: Joint::skin and skin_weight of each.
  std::map<size_t, std::pair<int, float>> skins;
  // Where the binding of a mesh or a stored pose has each model, by index: in the file's world.
  std::map<size_t, std::array<double, 16>> bind;
  bool has_meshes = false;
  std::vector<std::string> notes;  // See MotionFile::notes().
};

// Limits, so that no small file gives a large motion or takes long to read.
inline constexpr size_t kFbxMaxModels = 10'000;
inline constexpr size_t kFbxMaxParents = 500;
inline constexpr size_t kFbxMaxStacks = 10'000;
inline constexpr size_t kFbxMaxNameBytes = 200;
inline constexpr size_t kFbxMaxFrames = 500'000;  // In a motion.
// Keys of all curves together; packed ones take few bytes.
inline size_t fbx_max_keys(size_t bytes) { return std::max<size_t>(10'000'000, 4 * bytes); }
// Frames times joints of all motions. Frames between keys take no bytes.
inline size_t fbx_max_poses(size_t bytes) { return std::max<size_t>(3'000'000, 4 * bytes); }

// fbx.cpp: reads a file. With `fps`, motions whose keys give a rate get this one.
Result<FbxDocument> read_fbx_document(std::string bytes, const std::string& name,
                                      std::optional<double> fps);
// fbx_models.cpp: settings, connections and models. Rejects versions below 6, too many models or
// levels, and cyclic parents.
Result<void> read_fbx_models(FbxDocument& document);
// fbx_bind.cpp: what skins and stored poses say about the models.
void read_fbx_bind(FbxDocument& document);
// fbx_stacks.cpp: the animation.
Result<void> read_fbx_stacks(FbxDocument& document);
Result<void> read_fbx6_takes(FbxDocument& document);
// fbx_clips.cpp: the joints, the rest pose and the clips.
Result<void> read_fbx_clips(FbxDocument& document, std::optional<double> fps);

// The node of a property of an object, FBX 6 (`Property:`) or 7 (`P:`), or null. Its numbers begin
// at value `first`.
struct FbxProperty {
  const FbxNode* node = nullptr;
  size_t first = 0;
};
FbxProperty find_fbx_property(const FbxNode& object, std::string_view name);
// Reads numbers of a property into `out`, which stays if the property is missing.
Result<void> read_fbx_property(const FbxTree& tree, const FbxNode& object, std::string_view name,
                               std::span<double> out);
// "Hips" of "Model::Hips".
std::string fbx_without_class(const std::string& text);
// `text` as other formats can hold it: at most 200 bytes, with U+FFFD for each byte that is not
// valid UTF-8, as old programs with local encodings wrote.
std::string fbx_name(const std::string& text);

// Converts between the numbers of a file and the poses of a clip, at one instant of a motion.
class FbxPoser {
 public:
  // Without a stack, everything stays as it was saved. All of it outlives the object. The first
  // call is set_time().
  FbxPoser(const FbxDocument& document, const FbxStack* stack);

  void set_time(int64_t time);
  // [joints] of the clip at that time.
  void get_pose(Pose out);
  // Sets the rotations that the clip has instead; those of parents act on scales below.
  void set_rotations(std::span<const Quat> rotations);
  // The file's numbers at that time.
  const FbxChannels& channels(size_t joint) const { return channels_[joint]; }
  // The file's rotation of a joint, `before` and `after` included, for one of the clip.
  Quatd file_rotation(size_t joint, Quat rotation) const;
  // Its `Lcl Translation` for a translation of the clip and such a rotation.
  Vec3d file_translation(size_t joint, Vec3 translation, Quatd rotation) const;
  // The effect of the joints above on a joint's position.
  const Stretch& above(size_t joint) const { return above_[joint]; }

 private:
  const FbxModel& model(size_t joint) const;
  void add_joint(size_t joint, Quat rotation);

  const FbxDocument& document_;
  const FbxStack* stack_;
  Quatd axes_;
  double metres_;
  std::vector<FbxChannels> channels_;
  std::vector<FbxLocal> locals_;
  std::vector<NodeScale> own_;
  std::vector<Quat> rotations_;  // Of the clip, with the half turn of the own scale.
  std::vector<Stretch> above_;   // Of the joint's position,
  std::vector<Stretch> whole_;   // of its children,
  std::vector<Stretch> passed_;  // and of its children that leave its own scale out.
};

}  // namespace panache
