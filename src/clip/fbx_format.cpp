// New FBX files.

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <utility>

#include "clip/euler.h"
#include "clip/fbx.h"
#include "clip/fbx_encode.h"
#include "clip/motion_file.h"

namespace panache {
namespace {

using Value = FbxNewValue;

constexpr EulerOrder kNewOrder = {3, {2, 1, 0}};  // R = Rz Ry Rx.
constexpr double kCentimetres = 100;              // In a metre.
constexpr double kKnownRates[] = {30, 120, 100, 60, 50, 48, 0, 0, 0, 30 / 1.001, 25, 24, 1000};
constexpr int kOwnRate = 14;  // The file's time mode for any other.

Vec3d xyz(const EulerAngles& zyx) { return {zyx[2], zyx[1], zyx[0]}; }

FbxNewNode property(const std::string& name, const std::string& type, const std::string& label,
                    const std::string& flags, std::vector<Value> values) {
  FbxNewNode out{
      "P",
      {Value::string(name), Value::string(type), Value::string(label), Value::string(flags)},
      {},
      false};
  for (Value& value : values) out.values.push_back(std::move(value));
  return out;
}
FbxNewNode whole_property(const std::string& name, int32_t number) {
  return property(name, "int", "Integer", "", {Value::small(number)});
}
FbxNewNode number_property(const std::string& name, double number) {
  return property(name, "double", "Number", "", {Value::number(number)});
}
FbxNewNode vector_property(const std::string& name, Vec3d v) {
  const bool is_animated = name.starts_with("Lcl");
  return property(name, is_animated ? name : "Vector3D", is_animated ? "" : "Vector",
                  is_animated ? "A" : "",
                  {Value::number(v.x), Value::number(v.y), Value::number(v.z)});
}

class FbxFormatter {
 public:
  FbxFormatter(const Skeleton& skeleton, const std::vector<FbxMotion>& motions,
               double metres_per_unit, Quat to_y_up)
      : skeleton_(skeleton),
        motions_(motions),
        scale_(metres_per_unit * kCentimetres),
        turn_(to_y_up.as<double>()) {}

  std::string format() {
    add_header();
    add_settings();
    add_documents();
    make_objects();
    FbxNewNode& definitions = section("Definitions");
    definitions.add("Version", {Value::small(100)});
    int32_t all = 1;
    for (const auto& [kind, count] : counts_) all += count;
    definitions.add("Count", {Value::small(all)});
    counts_["GlobalSettings"] = 1;
    for (const auto& [kind, count] : counts_) {
      FbxNewNode& type = definitions.add("ObjectType", {Value::string(kind)});
      type.add("Count", {Value::small(count)});
    }
    sections_.push_back(std::move(objects_));
    sections_.push_back(std::move(connections_));
    sections_.push_back(std::move(takes_));
    return format_fbx_file(sections_);
  }

 private:
  FbxNewNode& section(const std::string& name) {
    return sections_.emplace_back(FbxNewNode{name, {}, {}, true});
  }

  void add_header() {
    FbxNewNode& header = section("FBXHeaderExtension");
    header.add("FBXHeaderVersion", {Value::small(1003)});
    header.add("FBXVersion", {Value::small(7400)});
    header.add("EncryptionType", {Value::small(0)});
    FbxNewNode& stamp = header.add("CreationTimeStamp");
    stamp.add("Version", {Value::small(1000)});
    for (const auto& [name, number] :
         {std::pair("Year", 1970), std::pair("Month", 1), std::pair("Day", 1),
          std::pair("Hour", 10), std::pair("Minute", 0), std::pair("Second", 0),
          std::pair("Millisecond", 0)}) {
      stamp.add(name, {Value::small(number)});
    }
    header.add("Creator", {Value::string("Panache")});
    sections_.push_back({"FileId", {Value::bytes(kFbxFileId)}, {}, false});
    sections_.push_back({"CreationTime", {Value::string(kFbxCreationTime)}, {}, false});
    sections_.push_back({"Creator", {Value::string("Panache")}, {}, false});
  }

  void add_settings() {
    FbxNewNode& settings = section("GlobalSettings");
    settings.add("Version", {Value::small(1000)});
    FbxNewNode& list = settings.add("Properties70");
    for (const auto& [name, number] :
         {std::pair("UpAxis", 1), std::pair("UpAxisSign", 1), std::pair("FrontAxis", 2),
          std::pair("FrontAxisSign", 1), std::pair("CoordAxis", 0), std::pair("CoordAxisSign", 1),
          std::pair("OriginalUpAxis", 1), std::pair("OriginalUpAxisSign", 1)}) {
      list.add("P") = whole_property(name, number);
    }
    list.add("P") = number_property("UnitScaleFactor", 1);
    list.add("P") = number_property("OriginalUnitScaleFactor", 1);
    const double rate = motions_.empty() ? 30 : 1 / motions_[0].clip->frame_time;
    int32_t mode = kOwnRate;
    for (size_t i = 0; i < std::size(kKnownRates); ++i) {
      if (mode == kOwnRate && std::abs(kKnownRates[i] - rate) < 1e-6 * rate) {
        mode = static_cast<int32_t>(i);
      }
    }
    list.add("P") = property("TimeMode", "enum", "", "", {Value::small(mode)});
    int64_t end = 0;
    for (const FbxMotion& motion : motions_)
      end = std::max(end, time_of(*motion.clip, motion.clip->frames - 1));
    list.add("P") = fbx_time_property("TimeSpanStart", 0);
    list.add("P") = fbx_time_property("TimeSpanStop", end);
    list.add("P") = number_property("CustomFrameRate", rate);
  }

  void add_documents() {
    FbxNewNode& documents = section("Documents");
    documents.add("Count", {Value::small(1)});
    FbxNewNode& document = documents.add(
        "Document", {Value::whole(kDocument), Value::string("Scene"), Value::string("Scene")});
    FbxNewNode& list = document.add("Properties70");
    list.add("P") = property("SourceObject", "object", "", "", {});
    list.add("P") = property("ActiveAnimStackName", "KString", "", "",
                             {Value::string(motions_.empty() ? "" : motions_[0].name)});
    document.add("RootNode", {Value::whole(0)});
    section("References");
  }

  static int64_t time_of(const Clip& clip, int frame) {
    return std::llround(frame * clip.frame_time * kFbxSecond);
  }

  void make_objects() {
    for (size_t j = 0; j < skeleton_.joints.size(); ++j) add_joint(j);
    add_bind_pose();
    takes_.add("Current", {Value::string(motions_.empty() ? "" : motions_[0].name)});
    for (const FbxMotion& motion : motions_) add_motion(motion);
  }

  void add_object(FbxNewNode node) {
    ++counts_[node.name];
    objects_.children.push_back(std::move(node));
  }
  void connect(int64_t child, int64_t parent, const std::string& name = "") {
    connections_.children.push_back(new_fbx_connection(child, parent, name));
  }

  static int64_t joint_id(size_t joint) { return kFirst + 2 * static_cast<int64_t>(joint); }
  const Joint& joint(size_t j) const { return skeleton_.joints[j]; }
  bool is_root(size_t j) const { return joint(j).parent < 0; }

  // In centimetres with +Y up.
  Vec3d translation_of(size_t j, Vec3 translation) const {
    const Vec3d v = translation.as<double>() * scale_;
    return is_root(j) ? rotate(turn_, v) : v;
  }
  Quatd turned(size_t j, Quat rotation) const {
    const Quatd q = rotation.as<double>();
    return normalized(is_root(j) ? turn_ * q : q);
  }
  // The rotation before that of the keys.
  Vec3d pre_angles(size_t j) const {
    return xyz(quat_to_euler(kNewOrder, turned(j, joint(j).rest), {}));
  }
  Quatd pre_rotation(size_t j) const {
    const Vec3d a = pre_angles(j);
    return euler_to_quat(kNewOrder, {a.z, a.y, a.x});
  }

  void add_joint(size_t j) {
    FbxNewNode model{"Model",
                     {Value::whole(joint_id(j)), Value::string("Model::" + joint(j).name),
                      Value::string("LimbNode")},
                     {},
                     true};
    model.add("Version", {Value::small(232)});
    FbxNewNode& list = model.add("Properties70");
    list.add("P") = property("RotationActive", "bool", "", "", {Value::small(1)});
    list.add("P") = property("InheritType", "enum", "", "", {Value::small(1)});
    list.add("P") = vector_property("PreRotation", pre_angles(j));
    list.add("P") = vector_property("Lcl Translation", translation_of(j, joint(j).offset));
    list.add("P") = vector_property("Lcl Rotation", {});
    list.add("P") = vector_property("Lcl Scaling", {1, 1, 1});
    add_object(std::move(model));
    FbxNewNode attribute{
        "NodeAttribute",
        {Value::whole(joint_id(j) + 1), Value::string("NodeAttribute::" + joint(j).name),
         Value::string("LimbNode")},
        {},
        true};
    attribute.add("TypeFlags", {Value::string("Skeleton")});
    add_object(std::move(attribute));
    connect(joint_id(j) + 1, joint_id(j));
    connect(joint_id(j), is_root(j) ? 0 : joint_id(static_cast<size_t>(joint(j).parent)));
  }

  void add_bind_pose() {
    FbxNewNode pose{
        "Pose",
        {Value::whole(kPose), Value::string("Pose::BindPose"), Value::string("BindPose")},
        {},
        true};
    pose.add("Type", {Value::string("BindPose")});
    pose.add("Version", {Value::small(100)});
    pose.add("NbPoseNodes", {Value::small(static_cast<int32_t>(skeleton_.joints.size()))});
    std::vector<Quatd> turns;
    std::vector<Vec3d> positions;
    for (size_t j = 0; j < skeleton_.joints.size(); ++j) {
      const auto parent = static_cast<size_t>(std::max(joint(j).parent, 0));
      const Vec3d at = translation_of(j, joint(j).offset);
      positions.push_back(is_root(j) ? at : positions[parent] + rotate(turns[parent], at));
      turns.push_back(is_root(j) ? pre_rotation(j) : normalized(turns[parent] * pre_rotation(j)));
      const Vec3d x = rotate(turns[j], Vec3d{1, 0, 0}), y = rotate(turns[j], Vec3d{0, 1, 0}),
                  z = rotate(turns[j], Vec3d{0, 0, 1}), p = positions[j];
      const double matrix[] = {x.x, x.y, x.z, 0, y.x, y.y, y.z, 0,
                               z.x, z.y, z.z, 0, p.x, p.y, p.z, 1};
      FbxNewNode& node = pose.add("PoseNode");
      node.add("Node", {Value::whole(joint_id(j))});
      node.add("Matrix", {Value::doubles(matrix)});
    }
    add_object(std::move(pose));
  }

  void add_motion(const FbxMotion& motion) {
    const Clip& clip = *motion.clip;
    assert(clip.joints() == skeleton_.joints.size());
    const int64_t stack = next_++, layer = next_++;
    std::vector<int64_t> times;
    for (int f = 0; f < clip.frames; ++f) times.push_back(time_of(clip, f));
    add_object(new_fbx_stack(stack, motion.name, 0, times.back()));
    add_object(new_fbx_layer(layer));
    connect(layer, stack);
    takes_.children.push_back(new_fbx_take(motion.name, 0, times.back()));
    for (size_t j = 0; j < clip.joints(); ++j) {
      std::vector<Vec3d> translations, turns;
      EulerAngles near = {};
      for (int f = 0; f < clip.frames; ++f) {
        const ConstPose pose = clip.pose(f);
        translations.push_back(translation_of(j, pose.translations[j]));
        near = quat_to_euler(kNewOrder, conjugate(pre_rotation(j)) * turned(j, pose.rotations[j]),
                             near);
        turns.push_back(xyz(near));
      }
      const Joint& of = clip.skeleton.joints[j];
      if (of.can_translate) add_curves(layer, j, 0, times, translations);
      if (of.can_rotate) add_curves(layer, j, 1, times, turns);
    }
  }

  void add_curves(int64_t layer, size_t j, size_t part, std::span<const int64_t> times,
                  const std::vector<Vec3d>& numbers) {
    const int64_t node = next_++;
    add_object(new_fbx_curve_node(node, part, numbers.front()));
    connect(node, layer);
    connect(node, joint_id(j), part == 0 ? "Lcl Translation" : "Lcl Rotation");
    for (size_t axis = 0; axis < 3; ++axis) {
      std::vector<float> values;
      for (const Vec3d v : numbers) values.push_back(static_cast<float>(v[axis]));
      const int64_t curve = next_++;
      add_object(new_fbx_curve(curve, {times, values}, false));
      connect(curve, node, std::string("d|") + "XYZ"[axis]);
    }
  }

  static constexpr int64_t kDocument = 1000, kPose = 1001, kFirst = 1'000'000;
  const Skeleton& skeleton_;
  const std::vector<FbxMotion>& motions_;
  double scale_;
  Quatd turn_;
  int64_t next_ = 1'000'000'000;
  std::vector<FbxNewNode> sections_;
  FbxNewNode objects_{"Objects", {}, {}, true}, connections_{"Connections", {}, {}, true},
      takes_{"Takes", {}, {}, true};
  std::map<std::string, int32_t> counts_;
};

}  // namespace

std::string format_fbx(const Skeleton& rest, const std::vector<FbxMotion>& motions,
                       double metres_per_unit, Quat to_y_up) {
  return FbxFormatter(rest, motions, metres_per_unit, to_y_up).format();
}

std::string encode_fbx6(const FbxDocument& document, std::span<const ClipEdit> edits,
                        EditMode mode) {
  std::vector<FbxMotion> motions;
  const bool only_new = mode == EditMode::replace && edits[0].clip == kNewClip;
  for (const FbxStack& stack : document.stacks) {
    if (!only_new) motions.push_back({&stack.clip, stack.name});
  }
  TakenNames names;
  for (const FbxMotion& motion : motions) unique_name(motion.name, names);
  auto first = motions.begin();
  for (const ClipEdit& edit : edits) {
    if (mode == EditMode::replace && edit.clip != kNewClip && !document.stacks.empty()) {
      motions[static_cast<size_t>(edit.clip)].clip = edit.changed;
      continue;
    }
    const std::string name = unique_name(edit.name.empty() ? "animation" : edit.name, names);
    first =
        motions.insert(mode == EditMode::add_first ? first : motions.end(), {edit.changed, name}) +
        1;
  }
  return format_fbx(document.rest.skeleton, motions, 1, Quat{});
}

}  // namespace panache
