#include "rig/rig.h"

#include <algorithm>
#include <cmath>

#include "clip/fk.h"

namespace panache {
namespace {

using enum HumanJoint;

bool is_identity(Quat q) { return q.x == 0 && q.y == 0 && q.z == 0; }

// The rotation that does in other axes what `q` does in its own: `axes` turns its axes to those.
// The scalar part stays as it is, so that the identity stays the identity to the bit.
Quat in_axes(Quat axes, Quat q) {
  const Vec3 v = rotate(axes, q.xyz());
  return {v.x, v.y, v.z, q.w};
}

// rotate(q, v) - v, which is exactly zero where q is the identity.
Vec3 shift(Quat q, Vec3 v) {
  const Vec3 t = cross(q.xyz(), v) * 2.0f;
  return t * q.w + cross(q.xyz(), t);
}

bool is_finite_body(const BodyPose& body) {
  if (!std::isfinite(body.facing)) return false;
  for (int j = 0; j < kHumanJoints; ++j) {
    if (!is_finite(body.positions[j]) || !is_finite(body.rotations[j]) ||
        !is_finite(body.joints[j])) {
      return false;
    }
  }
  return true;
}

// The rest pose and a few of the motion's, as far as they are finite.
std::vector<JointPositions> some_poses(const Clip& clip) {
  constexpr int kMost = 15;
  std::vector<Quat> rotations;
  std::vector<Vec3> translations;
  for (const Joint& joint : clip.skeleton.joints) {
    rotations.push_back(joint.rest);
    translations.push_back(joint.offset);
  }
  std::vector<JointPositions> poses;
  const auto add = [&](ConstPose pose) {
    world_pose(clip.skeleton, pose, {rotations, translations});
    if (std::all_of(translations.begin(), translations.end(), [](Vec3 p) { return is_finite(p); }))
      poses.push_back(translations);
  };
  add({rotations, translations});
  const int count = std::min(kMost, clip.frames);
  for (int i = 0; i < count; ++i) add(clip.pose((2 * i + 1) * clip.frames / (2 * count)));
  return poses;
}

// The skeleton's joints of those names.
Result<KnownJoints> find_joints(const Skeleton& skeleton, const std::map<int, std::string>& names) {
  KnownJoints known;
  for (const auto& [human, name] : names) {
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
  if (clip.joints() == 0) return Error{"no humanoid found: the skeleton has no joints"};
  if (clip.frames < 1) return Error{"expected at least one frame of motion, found none"};
  Result<KnownJoints> known = find_joints(clip.skeleton, options.joints);
  if (!known) return known.error();
  const std::vector<JointPositions> poses = some_poses(clip);
  if (poses.empty()) return Error{"no frame of the motion has finite numbers only"};
  Result<Mapping> mapping = map_humanoid(clip.skeleton, poses, *known);
  if (!mapping) return mapping.error();
  Result<Calibration> calibration =
      calibrate(clip, *mapping, options.metres_per_unit, options.up_axis);
  if (!calibration) return calibration.error();

  auto shared = std::make_shared<Shared>();
  shared->skeleton = clip.skeleton;
  shared->mapping = *std::move(mapping);
  shared->calibration = *std::move(calibration);
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
  int moved = joint_of[index(hips)];
  while (moved >= 0 && !clip.skeleton.joints[moved].can_translate) {
    moved = clip.skeleton.joints[moved].parent;
  }
  shared->moved_joint = moved;
  if (moved < 0) shared->notes.push_back("neither the hips nor a joint above them can move");

  Rig rig;
  rig.shared_ = std::move(shared);
  rig.world_rotations_.resize(clip.joints());
  rig.world_translations_.resize(clip.joints());
  rig.effective_.resize(clip.joints());
  // The pose that stands in for one that is not finite, until one was.
  rig.last_.facing = rig.shared_->calibration.facing;
  for (int f = rig.first_frame(); f < clip.frames; ++f) {
    BodyPose body;
    rig.read(clip.pose(f), body);
    if (is_finite_body(body)) break;
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

void Rig::read(ConstPose pose, BodyPose& out) noexcept {
  world_pose(shared_->skeleton, pose, {world_rotations_, world_translations_});
  const ConstPose world = {world_rotations_, world_translations_};
  const MappedJoints mapped = mapped_joints(world, shared_->mapping.joint_of, shared_->calibration);
  out.joints = mapped.positions;
  out.positions = canonical_positions(mapped.positions, shared_->calibration.shape, mapped.toes);
  out.facing = facing_of(mapped.positions).value_or(last_.facing);
  for (int j = 0; j < kHumanJoints; ++j) {
    const int joint = shared_->mapping.joint_of[j];
    out.rotations[j] = joint < 0 ? out.rotations[kHumanParent[j]]
                                 : shared_->calibration.y_up * world_rotations_[joint];
  }
  if (is_finite_body(out)) {
    last_ = out;
  } else {
    out = last_;
  }
}

void Rig::write(ConstPose in, const BodyPose& body, const BodyChange& change, Pose out) noexcept {
  const Quat file_axes = conjugate(shared_->calibration.y_up);
  const Quat from_heading = file_axes * rotation_y(body.facing);
  const Quat turn = in_axes(file_axes, rotation_y(change.turn));
  for (int j = 0; j < kHumanJoints; ++j) {
    deltas_[j] = turn * in_axes(from_heading, change.rotations[j]);
  }
  write_rotations(in, out);
  write_translation(in, change, out);
}

void Rig::place(float turn, Vec3 about, Vec3 move, Pose pose) const noexcept {
  if (turn == 0 && move == Vec3{}) return;
  const Quat file_axes = conjugate(shared_->calibration.y_up);
  const Quat by = in_axes(file_axes, rotation_y(turn));
  const Vec3 centre = rotate(file_axes, about) / shared_->calibration.scale;
  const Vec3 way = rotate(file_axes, move) / shared_->calibration.scale;
  for (size_t j = 0; j < shared_->skeleton.joints.size(); ++j) {
    if (shared_->skeleton.joints[j].parent >= 0) continue;
    pose.rotations[j] = by * pose.rotations[j];
    pose.translations[j] += shift(by, pose.translations[j] - centre) + way;
  }
}

// With E the world delta of a joint, E_p that of its parent and P its parent's world rotation in
// the input, the joint's new world rotation E P q and its parent's E_p P give the local rotation
// P^-1 E_p^-1 E P q. At E = E_p = 1 the factor before q is exactly 1.
void Rig::write_rotations(ConstPose in, Pose out) noexcept {
  for (size_t j = 0; j < shared_->skeleton.joints.size(); ++j) {
    const int parent = shared_->skeleton.joints[j].parent;
    const Quat inherited = parent < 0 ? Quat{} : effective_[parent];
    const Quat q = in.rotations[j];
    out.rotations[j] = q;
    effective_[j] = inherited;
    if (shared_->human_of[j] < 0) continue;
    effective_[j] = deltas_[shared_->human_of[j]];
    const Quat world = parent < 0 ? Quat{} : world_rotations_[parent];
    const Quat local = in_axes(conjugate(world), conjugate(inherited) * effective_[j]);
    // Even a product with 1 could change the sign of a zero, and making it unit the last bit.
    if (is_identity(local) || !is_finite(local)) continue;
    out.rotations[j] = normalized(local * q);
  }
}

void Rig::write_translation(ConstPose in, const BodyChange& change, Pose out) noexcept {
  std::copy(in.translations.begin(), in.translations.end(), out.translations.begin());
  if (shared_->moved_joint < 0) return;
  const auto at = [&](HumanJoint joint) {
    return world_translations_[shared_->mapping.joint_of[index(joint)]];
  };
  const int hips_joint = shared_->mapping.joint_of[index(hips)];
  const Vec3 mid_hip = (at(left_upper_leg) + at(right_upper_leg)) * 0.5f;
  const Vec3 wanted =
      rotate(conjugate(shared_->calibration.y_up), change.translation) / shared_->calibration.scale;
  // The new rotation carries mid-hip about the hips; the hips give way so that it stays.
  const Vec3 move = wanted - shift(effective_[hips_joint], mid_hip - at(hips));
  if (move == Vec3{} || !is_finite(move)) return;
  const int parent = shared_->skeleton.joints[shared_->moved_joint].parent;
  const Quat world = parent < 0 ? Quat{} : world_rotations_[parent];
  out.translations[shared_->moved_joint] += rotate(conjugate(world), move);
}

}  // namespace panache
