#include "rig/posed_rig.h"

#include <algorithm>
#include <cmath>

#include "clip/clip.h"
#include "rig/calibration.h"
#include "rig/canonical_body.h"

namespace panache {
namespace {

using enum HumanJoint;

bool is_identity(Quat q) { return q.x == 0 && q.y == 0 && q.z == 0; }

bool is_finite_body(const BodyPose& body) {
  if (!std::isfinite(body.facing)) return false;
  for (int j = 0; j < kHumanJoints; ++j) {
    if (!is_finite(body.positions[j]) || !is_finite(body.joints[j])) return false;
  }
  return is_finite(body.hands[0]) && is_finite(body.hands[1]);
}

}  // namespace

PosedRig::PosedRig(Rig rig, int ground_joint)
    : rig_(std::move(rig)),
      ground_joint_(ground_joint),
      last_(rig_.shared_->first_body),
      world_rotations_(rig_.shared_->human_of.size()),
      world_translations_(rig_.shared_->human_of.size()),
      new_rotations_(rig_.shared_->order.size()),
      new_translations_(rig_.shared_->order.size()) {}

Quat PosedRig::world_rotation(int human_joint) const noexcept {
  const Rig::Shared& shared = *rig_.shared_;
  int j = human_joint;
  while (shared.mapping.joint_of[j] < 0) j = kHumanParent[j];  // Every mapping has hips.
  return shared.calibration.y_up * world_rotations_[shared.mapping.joint_of[j]];
}

bool PosedRig::read(ConstPose pose, BodyPose& out) noexcept {
  const Rig::Shared& shared = *rig_.shared_;
  const size_t count = shared.skeleton.joints.size();
  for (const auto& [joint, parent] : shared.placed) {
    place_joint(joint, parent, pose, {world_rotations_, world_translations_});
  }
  for (size_t i = 0; i < shared.added.size(); ++i) {
    const Joint& joint = shared.added[i];
    const Quat turn = world_rotations_[joint.parent];
    world_rotations_[count + i] = turn;
    world_translations_[count + i] = world_translations_[joint.parent] + rotate(turn, joint.offset);
  }
  const ConstPose world = {world_rotations_, world_translations_};
  const MappedJoints mapped = mapped_joints(world, shared.mapping.joint_of, shared.calibration);
  out.joints = mapped.positions;
  out.positions = canonical_positions(mapped.positions, shared.calibration.shape, mapped.toes);
  out.facing = facing_of(mapped.positions).value_or(last_.facing);
  out.hands = {world_rotation(index(left_hand)), world_rotation(index(right_hand))};
  const bool finite = is_finite_body(out);
  if (finite) {
    last_ = out;
  } else {
    out = last_;
  }
  return finite;
}

bool PosedRig::read(ConstPose pose, RotatedBodyPose& out) noexcept {
  if (!read(pose, static_cast<BodyPose&>(out))) return false;
  std::array<Quat, kHumanJoints> rotations;
  for (int j = 0; j < kHumanJoints; ++j) {
    rotations[j] = world_rotation(j);
    // A rotation at the end of a limb moves no joint.
    if (!is_finite(rotations[j])) return false;
  }
  out.rotations = rotations;
  return true;
}

void PosedRig::write(ConstPose in, const BodyPose& body, const BodyChange& change,
                     Pose out) noexcept {
  const Rig::Shared& shared = *rig_.shared_;
  const Quat file_axes = conjugate(shared.calibration.y_up);
  const Quat from_heading = file_axes * rotation_y(body.facing);
  const Quat turn = in_axes(file_axes, rotation_y(change.turn));
  Deltas deltas;
  for (int j = 0; j < kHumanJoints; ++j) {
    deltas[j] = turn * in_axes(from_heading, change.rotations[j]);
  }
  write_rotations(in, deltas, out);
  write_translation(in, deltas, change, out);
  if (!shared.order.empty()) write_followers(deltas, out);
}

Quat PosedRig::delta_of(const Deltas& deltas, int joint) const noexcept {
  const int human = joint < 0 ? -1 : rig_.shared_->moved_by[joint];
  return human < 0 ? Quat{} : deltas[human];
}

void PosedRig::add_memory(Prefetch& prefetch) const noexcept {
  prefetch.add(std::span(world_rotations_));
  prefetch.add(std::span(world_translations_));
}

// With E the world delta of a joint, E_p that of its parent and P its parent's world rotation in
// the input, the joint's new world rotation E P q and its parent's E_p P give the local rotation
// P^-1 E_p^-1 E P q. At E = E_p = 1 the factor before q is exactly 1.
void PosedRig::write_rotations(ConstPose in, const Deltas& deltas, Pose out) noexcept {
  const Rig::Shared& shared = *rig_.shared_;
  for (size_t j = 0; j < shared.skeleton.joints.size(); ++j) {
    const int parent = shared.skeleton.joints[j].parent;
    const Quat q = in.rotations[j];
    out.rotations[j] = q;
    if (shared.human_of[j] < 0) continue;
    const Quat inherited = delta_of(deltas, parent);
    const Quat world = parent < 0 ? Quat{} : world_rotations_[parent];
    const Quat local = in_axes(conjugate(world), conjugate(inherited) * deltas[shared.human_of[j]]);
    // Multiplying by 1 could change the sign of a zero, and normalising the last bit.
    if (is_identity(local) || !is_finite(local)) continue;
    out.rotations[j] = normalized(local * q);
  }
}

void PosedRig::write_translation(ConstPose in, const Deltas& deltas, const BodyChange& change,
                                 Pose out) noexcept {
  const Rig::Shared& shared = *rig_.shared_;
  std::copy(in.translations.begin(), in.translations.end(), out.translations.begin());
  if (shared.moved_joint < 0) return;
  const auto at = [&](HumanJoint joint) {
    return world_translations_[shared.mapping.joint_of[index(joint)]];
  };
  const int hips_joint = shared.mapping.joint_of[index(hips)];
  const Vec3 mid_hip = (at(left_upper_leg) + at(right_upper_leg)) * 0.5f;
  const Vec3 wanted =
      rotate(conjugate(shared.calibration.y_up), change.translation) / shared.calibration.scale;
  // The new rotation moves mid-hip about the hips; the hips compensate so that it stays.
  const Vec3 move = wanted - rotate_offset(delta_of(deltas, hips_joint), mid_hip - at(hips));
  if (move == Vec3{} || !is_finite(move)) return;
  const auto add = [&](int joint, Vec3 translation) {
    const int parent = shared.skeleton.joints[joint].parent;
    const Quat world = parent < 0 ? Quat{} : world_rotations_[parent];
    out.translations[joint] += rotate(conjugate(world), translation);
  };
  if (ground_joint_ < 0) return add(shared.moved_joint, move);
  const Vec3 up = rotate(conjugate(shared.calibration.y_up), Vec3{0, 1, 0});
  const Vec3 on_ground = wanted - up * dot(up, wanted);
  add(ground_joint_, on_ground);
  add(shared.moved_joint, move - on_ground);
}

// A joint that follows another keeps its position on it; the other is new already, see
// Rig::Shared::order.
void PosedRig::write_followers(const Deltas& deltas, Pose out) noexcept {
  const Rig::Shared& shared = *rig_.shared_;
  // Below this distance, metres, rounding alone would change a file's numbers.
  constexpr float kRounding = 2e-5f;
  const size_t count = shared.skeleton.joints.size();
  for (const int joint : shared.order) {
    const auto j = static_cast<size_t>(joint);
    const bool is_file = j < count;
    const Joint& placed = is_file ? shared.skeleton.joints[j] : shared.added[j - count];
    const Quat above = placed.parent < 0 ? Quat{} : new_rotations_[placed.parent];
    const Vec3 origin = placed.parent < 0 ? Vec3{} : new_translations_[placed.parent];
    new_rotations_[j] = is_file ? normalized(above * out.rotations[j]) : above;
    new_translations_[j] = origin + rotate(above, is_file ? out.translations[j] : placed.offset);
    const int to = shared.followed[j];
    if (to < 0 || !is_file) continue;
    const Vec3 wanted =
        new_translations_[to] +
        rotate(delta_of(deltas, to), world_translations_[j] - world_translations_[to]);
    const Vec3 off = wanted - new_translations_[j];
    if (!is_finite(off) || !(length(off) * shared.calibration.scale > kRounding)) continue;
    out.translations[j] += rotate(conjugate(above), off);
    new_translations_[j] = wanted;
  }
}

Mannequin::Mannequin(const Rig& rig, ConstPose reference) : rig_(rig) {
  rig_.read(reference, body_);
  std::array<Quat, kHumanJoints> parts;
  canonical_frames(body_.positions, body_.facing, parts);
  // A head's direction is only known from its rotation: assume that it is upright.
  parts[index(HumanJoint::head)] = rotation_y(body_.facing);
  for (int j = 0; j < kHumanJoints; ++j) {
    to_part_[j] = conjugate(body_.rotations[j]) * parts[j];
    const int parent = kHumanParent[j];
    offsets_[j] = parent < 0
                      ? Vec3{0, body_.joints[j].y, 0}
                      : rotate(conjugate(parts[parent]), body_.joints[j] - body_.joints[parent]);
  }
}

void Mannequin::read(ConstPose pose, std::span<float, kMannequinNumbers> out) noexcept {
  rig_.read(pose, body_);
  for (int j = 0; j < kHumanJoints; ++j) {
    const Vec3 p = body_.joints[j];
    const Quat q = body_.rotations[j] * to_part_[j];
    const float numbers[kPartNumbers] = {p.x, p.y, p.z, q.x, q.y, q.z, q.w};
    std::copy_n(numbers, kPartNumbers, out.begin() + kPartNumbers * j);
  }
}

}  // namespace panache
