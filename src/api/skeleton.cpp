#include "api/errors.h"
#include "api/objects.h"
#include "api/options.h"
#include "api/poses.h"
#include "rig/calibration.h"

using namespace panache;
using namespace panache::api;

namespace {

constexpr int32_t kMaxJoints = 10'000, kMaxPoses = 10'000;

Result<Skeleton> read_skeleton(const panache_joint* joints, int32_t count) {
  if (count < 1 || count > kMaxJoints) {
    return Error{std::to_string(count) + " joints; expected 1 to " + std::to_string(kMaxJoints)};
  }
  Skeleton out;
  for (int32_t j = 0; j < count; ++j) {
    Joint joint;
    joint.name = joints[j].name ? joints[j].name : "";
    joint.parent = joints[j].parent;
    joint.rest = quat(joints[j].rotation);
    joint.offset = vec(joints[j].translation);
    joint.can_rotate = joint.can_translate = true;
    const std::string where = "joint " + std::to_string(j) + " '" + joint.name + "': ";
    if (joint.parent < -1 || joint.parent >= j) {
      return Error{where + "parent is " + std::to_string(joint.parent) +
                   "; expected a joint before it, or -1"};
    }
    if (!make_unit(joint.rest)) {
      return Error{where + "its rest rotation is not a unit quaternion (x, y, z, w)"};
    }
    if (!is_finite(joint.offset)) return Error{where + "its rest translation is not finite"};
    out.joints.push_back(std::move(joint));
  }
  return out;
}

// The given poses, or the rest pose if there are none.
Result<Clip> read_poses(Skeleton skeleton, const panache_skeleton_options& options) {
  Clip clip{std::move(skeleton), 1.0 / 30, 0, {}, {}};
  const int32_t count = options.pose_count;
  if (count < 0 || count > kMaxPoses) {
    return Error{std::to_string(count) + " poses; expected 0 to " + std::to_string(kMaxPoses)};
  }
  auto read = read_frames(options.rotations, options.translations, count, Rotations::unit, clip);
  if (!read) return read.error();
  return count == 0 ? rest_clip(clip.skeleton) : clip;
}

Result<KnownJoints> read_map(const panache_skeleton_options& options, int32_t joint_count) {
  const int32_t count = options.human_joint_count;
  if (count < 0 || count > kHumanJoints || (count > 0 && !options.human_joints)) {
    return Error{std::to_string(count) + " human joints; expected an array of 0 to " +
                 std::to_string(kHumanJoints)};
  }
  KnownJoints known;
  for (int32_t i = 0; i < count; ++i) {
    const panache_human_joint& entry = options.human_joints[i];
    const std::string name = entry.vrm_name ? entry.vrm_name : "";
    const std::optional<int> human = find_human_joint(name);
    if (!human) {
      return Error{"human joint " + std::to_string(i) + ": there is no human joint '" + name +
                   "' that a style turns"};
    }
    if (entry.joint < -1 || entry.joint >= joint_count) {
      return Error{"human joint " + std::to_string(i) + " '" + name + "': joint is " +
                   std::to_string(entry.joint) + "; expected -1 to " +
                   std::to_string(joint_count - 1)};
    }
    if (!known.emplace(*human, entry.joint).second) {
      return Error{"human joint " + std::to_string(i) + " '" + name + "': is listed twice"};
    }
  }
  return known;
}

}  // namespace

namespace panache::api {

Result<RigOptions> read_rig_options(const panache_skeleton_options& options, int32_t joint_count) {
  RigOptions out;
  if (options.metres_per_unit != 0) out.metres_per_unit = options.metres_per_unit;
  if (options.up_axis) out.up_axis = options.up_axis;
  if (auto good = check_units(out.metres_per_unit, out.up_axis); !good) return good.error();
  Result<KnownJoints> known = read_map(options, joint_count);
  if (!known) return known.error();
  out.joint_indices = *std::move(known);
  return out;
}

}  // namespace panache::api

panache_status panache_skeleton_create(const panache_joint* joints, int32_t joint_count,
                                       const panache_skeleton_options* options,
                                       panache_skeleton** out) {
  start(out);
  return guarded([&] {
    const auto given = read_struct<panache_skeleton_options>(options, PANACHE_SKELETON_OPTIONS,
                                                             "panache_skeleton_options");
    if (!given) return fail(PANACHE_BAD_ARGUMENT, given.error());
    Result<Skeleton> skeleton = read_skeleton(joints, joint_count);
    if (!skeleton) return fail(PANACHE_BAD_SKELETON, skeleton.error());
    Result<Clip> clip = read_poses(*std::move(skeleton), *given);
    if (!clip) return fail(PANACHE_BAD_ARGUMENT, clip.error());
    const Result<RigOptions> rig_options = read_rig_options(*given, joint_count);
    if (!rig_options) return fail(PANACHE_BAD_ARGUMENT, rig_options.error());
    Result<Rig> rig = Rig::create(*clip, *rig_options);
    if (!rig) return fail(PANACHE_BAD_SKELETON, rig.error());
    Clip body = rest_clip(clip->skeleton);
    *out = new panache_skeleton{*std::move(rig), std::move(clip->skeleton), std::move(body)};
    return PANACHE_OK;
  });
}

void panache_skeleton_destroy(panache_skeleton* skeleton) { delete skeleton; }

int32_t panache_skeleton_joint_count(const panache_skeleton* skeleton) {
  return static_cast<int32_t>(skeleton->rig.joint_count());
}

int32_t panache_skeleton_find(const panache_skeleton* skeleton, const char* vrm_name) {
  const std::optional<int> joint = find_human_joint(vrm_name);
  return joint ? skeleton->rig.joints()[*joint] : -1;
}
