#pragma once
// Converts poses and clips of the C interface to those of the library.

#include <string>

#include "base/result.h"
#include "clip/clip.h"
#include "panache/panache.h"

namespace panache::api {

static_assert(sizeof(Quat) == 4 * sizeof(float) && sizeof(Vec3) == 3 * sizeof(float));

inline Quat quat(const float* q) { return {q[0], q[1], q[2], q[3]}; }
inline Vec3 vec(const float* v) { return {v[0], v[1], v[2]}; }

// Normalises a rotation of nearly unit length; one that is unit up to float rounding stays as it
// is. Returns false, and changes nothing, if the length is far from 1.
bool make_unit(Quat& q);

// Whether rotations keep their bits or are normalised.
enum class Rotations { as_given, unit };

// Appends poses to a clip with a known skeleton; rejects non-finite numbers.
Result<void> read_frames(const float* rotations, const float* translations, int32_t count,
                         Rotations kept, Clip& clip);
// Error messages start with `name`.
Result<Clip> read_clip(const panache_clip& from, Rotations kept, const std::string& name);
// The same with `joints` in place of the clip's own skeleton, which is ignored.
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
