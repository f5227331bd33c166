#include "rig/rig.h"

#include <algorithm>
#include <cmath>

#include "clip/clip.h"
#include "rig/doubtful.h"
#include "rig/posed_rig.h"
#include "rig/usual_unit.h"

namespace panache {
namespace {

using enum HumanJoint;

// The finite ones of the rest pose and a few poses of the motion.
std::vector<JointPositions> some_poses(const Clip& clip) {
  constexpr int kMax = 15;
  Clip world = rest_clip(clip.skeleton);
  std::vector<JointPositions> poses;
  const auto add = [&](ConstPose pose) {
    world_pose(clip.skeleton, pose, world.pose(0));
    const std::vector<Vec3>& places = world.translations;
    if (std::ranges::all_of(places, [](Vec3 p) { return is_finite(p); })) poses.push_back(places);
  };
  add(world.pose(0));
  const int count = std::min(kMax, clip.frames);
  for (int i = 0; i < count; ++i) add(clip.pose((2 * i + 1) * clip.frames / (2 * count)));
  return poses;
}

// Finds the joints given in the options.
Result<KnownJoints> find_joints(const Skeleton& skeleton, const RigOptions& options) {
  KnownJoints known = options.joint_places;
  for (const auto& [human, name] : options.joints) {
    if (options.joint_places.contains(human)) continue;
    int& found = known[human] = -1;
    if (name.empty()) continue;
    for (size_t j = 0; j < skeleton.joints.size(); ++j) {
      if (skeleton.joints[j].name != name) continue;
      if (found >= 0) {
        return Error{"more than one joint is called '" + name + "', so it cannot be named as " +
                     std::string(human_joint_name(human))};
      }
      found = static_cast<int>(j);
    }
    if (found < 0) {
      return Error{"there is no joint '" + name + "' that could be " +
                   std::string(human_joint_name(human))};
    }
  }
  return known;
}

}  // namespace

Result<Rig> Rig::create(const Clip& clip, const RigOptions& options) {
  if (clip.joints() == 0)
    return Error{"no humanoid found: the skeleton has no joints", ErrorKind::not_humanoid};
  if (clip.frames < 1) return Error{"expected at least one frame of motion, found none"};
  Result<KnownJoints> known = find_joints(clip.skeleton, options);
  if (!known) return known.error();
  const std::vector<JointPositions> poses = some_poses(clip);
  if (poses.empty()) return Error{"no frame of the motion has finite numbers only"};
  Result<Mapping> mapping = map_humanoid(clip.skeleton, poses, *known);
  if (!mapping) return mapping.error();
  if (const std::optional<Error> doubt = find_doubt(clip.skeleton, *mapping, *known)) {
    return *doubt;
  }
  if (const std::optional<Error> animal = find_animal(clip.skeleton, poses, *mapping, *known)) {
    return *animal;
  }
  Result<Calibration> calibration =
      calibrate(clip, *mapping, options.metres_per_unit, options.up_axis);
  if (!calibration) return calibration.error();

  auto shared = std::make_shared<Shared>();
  shared->skeleton = clip.skeleton;
  shared->mapping = *std::move(mapping);
  shared->calibration = *std::move(calibration);
  shared->unit = shared->calibration.scale;
  const auto usual = usual_unit(shared->unit);
  if (usual && !options.metres_per_unit) shared->unit = static_cast<float>(usual->metres);
  shared->notes = shared->mapping.notes;
  shared->notes.insert(shared->notes.end(), shared->calibration.notes.begin(),
                       shared->calibration.notes.end());
  const std::array<int, kHumanJoints>& joint_of = shared->mapping.joint_of;
  shared->human_of.assign(clip.joints(), -1);
  for (int j = 0; j < kHumanJoints; ++j) {
    if (joint_of[j] < 0) continue;
    if (clip.skeleton.joints[joint_of[j]].can_rotate) {
      shared->human_of[joint_of[j]] = j;
    } else {
      shared->notes.push_back(std::string(human_joint_name(j)) + " cannot rotate in this file");
    }
  }
  for (size_t j = 0; j < clip.joints(); ++j) {
    const int parent = clip.skeleton.joints[j].parent;
    const int inherited = parent < 0 ? -1 : shared->moved_by[parent];
    shared->moved_by.push_back(shared->human_of[j] < 0 ? inherited : shared->human_of[j]);
  }
  int moved = joint_of[index(hips)];
  while (moved >= 0 && !clip.skeleton.joints[moved].can_translate) {
    moved = clip.skeleton.joints[moved].parent;
  }
  shared->moved_joint = moved;
  if (moved < 0)
    shared->notes.push_back(
        "neither the hips nor a joint above them are animated (no translation channels)");

  Rig rig;
  // Until a finite pose was read, `first_body` is used instead.
  shared->first_body.facing = shared->calibration.facing;
  rig.shared_ = shared;
  PosedRig reader(rig);
  for (int f = rig.first_frame(); f < clip.frames; ++f) {
    BodyPose body;
    if (!reader.read(clip.pose(f), body)) continue;
    shared->first_body = body;
    break;
  }
  return rig;
}

std::vector<JointMatch> Rig::matches() const {
  std::vector<JointMatch> out;
  for (int j = 0; j < kHumanJoints; ++j) {
    const int joint = shared_->mapping.joint_of[j];
    out.push_back({std::string(human_joint_name(j)),
                   joint < 0 ? std::string{} : shared_->skeleton.joints[joint].name,
                   shared_->mapping.reasons[j], shared_->mapping.confidence[j]});
  }
  return out;
}

void Rig::transform_root(float turn, Vec3 about, Vec3 move, Pose pose) const noexcept {
  if (turn == 0 && move == Vec3{}) return;
  const Quat file_axes = conjugate(shared_->calibration.y_up);
  const Quat by = in_axes(file_axes, rotation_y(turn));
  const Vec3 centre = rotate(file_axes, about) / shared_->calibration.scale;
  const Vec3 way = rotate(file_axes, move) / shared_->calibration.scale;
  for (size_t j = 0; j < shared_->skeleton.joints.size(); ++j) {
    if (shared_->skeleton.joints[j].parent >= 0) continue;
    pose.rotations[j] = by * pose.rotations[j];
    pose.translations[j] += rotate_offset(by, pose.translations[j] - centre) + way;
  }
}

}  // namespace panache
