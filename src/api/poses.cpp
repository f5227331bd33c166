#include "api/poses.h"

#include <cmath>

#include "api/objects.h"

namespace panache::api {
namespace {

constexpr int32_t kMaxFrames = 1'000'000;
constexpr float kUnit = 1e-6f;

}  // namespace

bool make_unit(Quat& q) {
  const float square = dot(q, q);
  if (!is_finite(q) || std::abs(square - 1) > 0.1f) return false;
  // Rotations from files that are unit except for rounding keep their bits.
  if (std::abs(square - 1) > kUnit) q = normalized(q);
  return true;
}

Result<void> read_frames(const float* rotations, const float* translations, int32_t count,
                         Rotations kept, Clip& clip) {
  if (count > 0 && (!rotations || !translations)) {
    return Error{"poses need both rotations and translations"};
  }
  const size_t joints = clip.skeleton.joints.size();
  for (size_t i = 0; i < static_cast<size_t>(count) * joints; ++i) {
    const Quat given = quat(rotations + 4 * i);
    const Vec3 v = vec(translations + 3 * i);
    const auto where = [&] {
      return "pose " + std::to_string(i / joints) + ", joint " + std::to_string(i % joints) + ": ";
    };
    Quat unit = given;
    if (!make_unit(unit)) {
      return Error{where() + "its rotation is not a unit quaternion (x, y, z, w)"};
    }
    if (!is_finite(v)) return Error{where() + "its translation is not finite"};
    clip.rotations.push_back(kept == Rotations::unit ? unit : given);
    clip.translations.push_back(v);
  }
  clip.frames = count;
  return {};
}

Result<Clip> read_clip(const panache_clip& from, Rotations kept, const std::string& name) {
  return read_clip(from, from.skeleton->joints, kept, name);
}

Result<Clip> read_clip(const panache_clip& from, const Skeleton& joints, Rotations kept,
                       const std::string& name) {
  if (from.frame_count < 0 || from.frame_count > kMaxFrames) {
    return Error{name + ": has " + std::to_string(from.frame_count) + " frames; expected up to " +
                 std::to_string(kMaxFrames)};
  }
  if (!(from.frame_seconds > 0 && from.frame_seconds <= 1)) {
    return Error{name + ": has frames " + std::to_string(from.frame_seconds) +
                 " seconds apart; expected more than 0 and at most 1"};
  }
  Clip clip{joints, from.frame_seconds, 0, {}, {}};
  auto read = read_frames(from.rotations, from.translations, from.frame_count, kept, clip);
  if (!read) return located(name, read.error());
  return clip;
}

}  // namespace panache::api
