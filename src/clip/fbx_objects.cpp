// The objects of animation in FBX 7.

#include <bit>

#include "clip/fbx_encode.h"

namespace panache {
namespace {

using Value = FbxNewValue;

constexpr int32_t kLinearFlags = 24836, kStepFlags = 24834;  // As the FBX SDK writes them.
constexpr int32_t kPlainWeights = 255790911;                 // A third on both sides.

FbxNewNode named(const char* kind, int64_t id, const std::string& name) {
  FbxNewNode out{kind, {Value::whole(id), Value::string(name), Value::string("")}, {}, true};
  return out;
}

}  // namespace

void set_fbx_keys(const FbxKeys& keys, bool is_text, FbxNewNode& curve) {
  const int32_t flags[] = {keys.are_steps ? kStepFlags : kLinearFlags};
  const int32_t count[] = {static_cast<int32_t>(keys.times.size())};
  const int32_t data[] = {0, 0, kPlainWeights, 0};
  const float bits[] = {0, 0, std::bit_cast<float>(kPlainWeights), 0};
  curve.set("KeyTime", {Value::times(keys.times)});
  curve.set("KeyValueFloat", {Value::floats(keys.values)});
  curve.set("KeyAttrFlags", {Value::wholes(flags)});
  curve.set("KeyAttrDataFloat", {is_text ? Value::wholes(data) : Value::floats(bits)});
  curve.set("KeyAttrRefCount", {Value::wholes(count)});
}

FbxNewNode new_fbx_curve(int64_t id, const FbxKeys& keys, bool is_text) {
  FbxNewNode out = named("AnimationCurve", id, "AnimCurve::");
  out.add("Default", {Value::number(keys.values.empty() ? 0 : keys.values[0])});
  out.add("KeyVer", {Value::small(4008)});
  set_fbx_keys(keys, is_text, out);
  return out;
}

FbxNewNode new_fbx_curve_node(int64_t id, size_t part, Vec3d still) {
  FbxNewNode out = named("AnimationCurveNode", id, std::string("AnimCurveNode::") + "TRS"[part]);
  FbxNewNode& properties = out.add("Properties70");
  for (const auto& [name, number] :
       {std::pair("d|X", still.x), std::pair("d|Y", still.y), std::pair("d|Z", still.z)}) {
    properties.add("P", {Value::string(name), Value::string("Number"), Value::string(""),
                         Value::string("A"), Value::number(number)});
  }
  return out;
}

FbxNewNode fbx_time_property(const std::string& name, int64_t time) {
  return {"P",
          {Value::string(name), Value::string("KTime"), Value::string("Time"), Value::string(""),
           Value::whole(time)},
          {},
          false};
}

FbxNewNode new_fbx_stack(int64_t id, const std::string& name, int64_t begin, int64_t end) {
  FbxNewNode out = named("AnimationStack", id, "AnimStack::" + name);
  FbxNewNode& properties = out.add("Properties70");
  for (const auto& [of, time] :
       {std::pair("LocalStart", begin), std::pair("LocalStop", end),
        std::pair("ReferenceStart", begin), std::pair("ReferenceStop", end)}) {
    properties.add("P") = fbx_time_property(of, time);
  }
  return out;
}

FbxNewNode new_fbx_layer(int64_t id) { return named("AnimationLayer", id, "AnimLayer::BaseLayer"); }

FbxNewNode new_fbx_take(const std::string& name, int64_t begin, int64_t end) {
  FbxNewNode out{"Take", {Value::string(name)}, {}, true};
  out.add("FileName", {Value::string(name + ".tak")});
  out.add("LocalTime", {Value::whole(begin), Value::whole(end)});
  out.add("ReferenceTime", {Value::whole(begin), Value::whole(end)});
  return out;
}

FbxNewNode new_fbx_connection(int64_t child, int64_t parent, const std::string& property) {
  FbxNewNode out{
      "C",
      {Value::string(property.empty() ? "OO" : "OP"), Value::whole(child), Value::whole(parent)},
      {},
      false};
  if (!property.empty()) out.values.push_back(Value::string(property));
  return out;
}

}  // namespace panache
