#pragma once
// Poses and clips of the C interface as the library has them.

#include <string>

#include "base/result.h"
#include "clip/clip.h"
#include "panache/panache.h"

namespace panache::api {

static_assert(sizeof(Quat) == 4 * sizeof(float) && sizeof(Vec3) == 3 * sizeof(float));

inline Quat quat(const float* q) { return {q[0], q[1], q[2], q[3]}; }
inline Vec3 vec(const float* v) { return {v[0], v[1], v[2]}; }

// Makes a rotation that is nearly of unit length exactly so; to within a float's rounding it is
// already. Returns false, and leaves it alone, where it is far from it.
bool make_unit(Quat& q);

// Whether rotations stay bit for bit as they were given, or are made exactly unit.
enum class Rotations { as_given, unit };

// Appends poses to a clip whose skeleton is known; rejects numbers that are not finite.
Result<void> read_frames(const float* rotations, const float* translations, int32_t count,
                         Rotations kept, Clip& clip);
// `name` stands in front of the message of a failure.
Result<Clip> read_clip(const panache_clip& from, Rotations kept, const std::string& name);
// The same of other joints than those of the clip's skeleton, which is not read.
Result<Clip> read_clip(const panache_clip& from, const Skeleton& joints, Rotations kept,
                       const std::string& name);

inline ConstPose view(const panache_input_pose& pose, size_t joints) {
  return {{reinterpret_cast<const Quat*>(pose.rotations), joints},
          {reinterpret_cast<const Vec3*>(pose.translations), joints}};
}
inline Pose view(const panache_output_pose& pose, size_t joints) {
  return {{reinterpret_cast<Quat*>(pose.rotations), joints},
          {reinterpret_cast<Vec3*>(pose.translations), joints}};
}

}  // namespace panache::api
