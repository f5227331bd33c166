#include "retarget/find_body.h"

#include <cmath>

#include "retarget/reference_pose.h"

namespace panache {

Result<std::pair<Clip, Rig>> find_body(Clip rest, const Clip* motion, const RigOptions& options) {
  Result<Rig> at_rest = Rig::create(rest, options);
  bool on_floor = false;
  if (at_rest && motion) {
    // A rest pose in the air, as in BVH files, does not define the floor.
    const ReferencePose standing = find_reference_pose(rest, *at_rest);
    on_floor = standing.from_rest && std::abs(at_rest->floor()) < 0.25f * standing.leg;
  }
  if (!motion || on_floor) {
    if (!at_rest) return at_rest.error();
    return std::pair{std::move(rest), *std::move(at_rest)};
  }
  Clip body = *motion;
  body.skeleton = std::move(rest.skeleton);
  Result<Rig> rig = Rig::create(body, options);
  if (!rig) return rig.error();
  return std::pair{std::move(body), *std::move(rig)};
}

}  // namespace panache
