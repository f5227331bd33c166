#include "skeleton_pose.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace panache::godot {
namespace {

struct Column {
  double x, y, z, length;
};

Column unit_column(const Transform& t, float Vector::*axis) {
  const double x = static_cast<double>(t.rows[0].*axis), y = static_cast<double>(t.rows[1].*axis),
               z = static_cast<double>(t.rows[2].*axis);
  const double length = std::sqrt(x * x + y * y + z * z);
  return length > 0 ? Column{x / length, y / length, z / length, length} : Column{0, 0, 0, 0};
}

// The rotation of a basis that may be scaled, but not sheared or mirrored.
Rotation rotation_of(const Transform& t) {
  const Column a = unit_column(t, &Vector::x), b = unit_column(t, &Vector::y),
               c = unit_column(t, &Vector::z);
  // Divide by the largest of the four, so that rounding loses none.
  const double w = 1 + a.x + b.y + c.z, x = 1 + a.x - b.y - c.z, y = 1 - a.x + b.y - c.z,
               z = 1 - a.x - b.y + c.z;
  double q[4];
  if (w >= std::max({x, y, z})) {
    q[0] = b.z - c.y, q[1] = c.x - a.z, q[2] = a.y - b.x, q[3] = w;
  } else if (x >= std::max(y, z)) {
    q[0] = x, q[1] = a.y + b.x, q[2] = c.x + a.z, q[3] = b.z - c.y;
  } else if (y >= z) {
    q[0] = a.y + b.x, q[1] = y, q[2] = b.z + c.y, q[3] = c.x - a.z;
  } else {
    q[0] = c.x + a.z, q[1] = b.z + c.y, q[2] = z, q[3] = a.y - b.x;
  }
  const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  return {static_cast<float>(q[0] / length), static_cast<float>(q[1] / length),
          static_cast<float>(q[2] / length), static_cast<float>(q[3] / length)};
}

template <class Plain>
void put(const Plain& plain, std::vector<float>& out, size_t joint) {
  constexpr size_t kCount = sizeof(Plain) / sizeof(float);
  std::memcpy(&out[kCount * joint], &plain, sizeof plain);
}

template <class Plain>
Plain take(const std::vector<float>& from, size_t joint) {
  constexpr size_t kCount = sizeof(Plain) / sizeof(float);
  Plain out;
  std::memcpy(&out, &from[kCount * joint], sizeof out);
  return out;
}

template <class Plain>
bool differ(const std::vector<float>& a, const std::vector<float>& b, size_t joint) {
  constexpr size_t kCount = sizeof(Plain) / sizeof(float);
  return !std::equal(&a[kCount * joint], &a[kCount * joint] + kCount, &b[kCount * joint]);
}

}  // namespace

SkeletonPose::SkeletonPose(const Names& names, const Value& node) {
  const int64_t count = to_integer(node.call(names.get_bone_count).get());
  std::vector<int64_t> parents;
  for (int64_t b = 0; b < count; ++b) {
    parents.push_back(to_integer(node.call(names.get_bone_parent, Value(b)).get()));
  }
  // Bones may come before their parents, joints may not.
  std::vector<int32_t> joint_of(static_cast<size_t>(count), -1);
  for (size_t before = 1; before != bones_.size();) {
    before = bones_.size();
    for (int64_t b = 0; b < count; ++b) {
      const int64_t parent = parents[static_cast<size_t>(b)];
      if (joint_of[static_cast<size_t>(b)] >= 0) continue;
      if (parent >= 0 && joint_of[static_cast<size_t>(parent)] < 0) continue;
      bones_.push_back(b);
      joint_of[static_cast<size_t>(b)] = static_cast<int32_t>(bones_.size());
    }
    if (bones_.empty()) break;
  }
  std::vector<std::string> texts = {""};
  std::vector<panache_joint> joints = {{"", -1, {0, 0, 0, 1}, {0, 0, 0}}};
  for (const int64_t b : bones_) {
    const int64_t parent = parents[static_cast<size_t>(b)];
    const Transform rest = to_transform(node.call(names.get_bone_rest, Value(b)).get());
    const Rotation q = rotation_of(rest);
    texts.push_back(to_utf8(node.call(names.get_bone_name, Value(b)).get()));
    joints.push_back({"",
                      parent < 0 ? 0 : joint_of[static_cast<size_t>(parent)],
                      {q.x, q.y, q.z, q.w},
                      {rest.origin.x, rest.origin.y, rest.origin.z}});
  }
  for (size_t j = 0; j < joints.size(); ++j) joints[j].name = texts[j].c_str();
  panache_skeleton_options options = PANACHE_SKELETON_OPTIONS;
  options.up_axis = "+Y";
  panache_skeleton* made = nullptr;
  if (panache_skeleton_create(joints.data(), static_cast<int32_t>(joints.size()), &options,
                              &made) != PANACHE_OK) {
    error_ = panache_last_error();
  }
  skeleton_.reset(made);
  rotations_.resize(4 * joints.size());
  translations_.resize(3 * joints.size());
  out_rotations_ = rotations_;
  out_translations_ = translations_;
}

panache_input_pose SkeletonPose::read(const Names& names, const Value& node) {
  const Transform at = to_transform(node.call(names.get_global_transform).get());
  const double scale = unit_column(at, &Vector::y).length;
  const auto unscaled = [&](float x) {
    return scale > 0 ? static_cast<float>(static_cast<double>(x) / scale) : x;
  };
  put(rotation_of(at), rotations_, 0);
  put(Vector{unscaled(at.origin.x), 0, unscaled(at.origin.z)}, translations_, 0);
  for (size_t j = 1; j <= bones_.size(); ++j) {
    const Value bone(bones_[j - 1]);
    put(to_rotation(node.call(names.get_bone_pose_rotation, bone).get()), rotations_, j);
    put(to_vector(node.call(names.get_bone_pose_position, bone).get()), translations_, j);
  }
  return {rotations_.data(), translations_.data()};
}

void SkeletonPose::write(const Names& names, const Value& node) const {
  for (size_t j = 1; j <= bones_.size(); ++j) {
    const Value bone(bones_[j - 1]);
    if (differ<Rotation>(rotations_, out_rotations_, j)) {
      node.call(names.set_bone_pose_rotation, bone, Value(take<Rotation>(out_rotations_, j)));
    }
    if (differ<Vector>(translations_, out_translations_, j)) {
      node.call(names.set_bone_pose_position, bone, Value(take<Vector>(out_translations_, j)));
    }
  }
}

}  // namespace panache::godot
