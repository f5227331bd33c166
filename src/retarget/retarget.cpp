#include "retarget/retarget.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "base/elementary.h"
#include "clip/clip.h"
#include "pose/contacts.h"
#include "pose/limb.h"
#include "pose/changed_joints.h"
#include "retarget/ground.h"
#include "retarget/reference_pose.h"
#include "retarget/joint_pairs.h"
#include "rig/figures.h"
#include "rig/joint_name.h"
#include "rig/posed_rig.h"
#include "rig/rig.h"

namespace panache {
namespace {

// The joints in the world, file axes and units.
struct Placed {
  std::vector<Quat> rotations;
  std::vector<Vec3> positions;

  Placed(const Skeleton& skeleton, ConstPose pose)
      : rotations(skeleton.joints.size()), positions(skeleton.joints.size()) {
    world_pose(skeleton, pose, {rotations, positions});
  }
};

Vec3 up_of(const Rig& rig) {
  return rotate(conjugate(turn_up(rig.up_axis()).value_or(Quat{})), Vec3{0, 1, 0});
}

Vec3 along_ground(Vec3 v, Vec3 up) { return v - up * dot(v, up); }

// The character's root joint: above its hips, named so or with vertices of its own, on the floor
// below them at rest; -1 if it has none.
int find_root_joint(const Clip& character, const Rig& rig) {
  const std::vector<Joint>& joints = character.skeleton.joints;
  const int hips = rig.joints()[index(HumanJoint::hips)];
  if (hips < 0 || !joints[hips].can_translate) return -1;
  const Placed rest(character.skeleton, rig.rest().pose(0));
  const Vec3 up = up_of(rig);
  const auto at = [&](HumanJoint joint) {
    const int found = rig.joints()[index(joint)];
    return found < 0 ? Vec3{} : rest.positions[found];
  };
  const float leg = length(at(HumanJoint::left_upper_leg) - at(HumanJoint::left_foot));
  int found = -1;
  for (int j = joints[hips].parent; j >= 0; j = joints[j].parent) {
    const bool is_root = joints[j].skin >= 0 || parse_joint_name(joints[j].name).has("root");
    const Vec3 to_hips = rest.positions[hips] - rest.positions[j];
    const bool on_floor =
        dot(to_hips, up) > 0.5f * leg && length(along_ground(to_hips, up)) < 0.3f * leg;
    if (is_root && on_floor && joints[j].can_translate) found = j;
  }
  return found;
}

using enum HumanJoint;

constexpr float kHalfTurn = 3.14159265f;

class Retargeter {
 public:
  Retargeter(const Clip& motion, const Rig& rig, const Clip& character, const Rig& onto,
             const RetargetOptions& options)
      : motion_(motion),
        character_(character),
        onto_rig_(onto),
        options_(options),
        from_(rig),
        root_joint_(options.root ? find_root_joint(character, onto) : -1),
        onto_(onto, root_joint_),
        look_(onto),
        seen_(onto.rest()),
        from_reference_(find_reference_pose(motion, rig)),
        onto_reference_(find_reference_pose(character, onto)),
        scale_(onto_reference_.leg / from_reference_.leg),
        rest_(base_pose()),
        world_(rig.rest()),
        further_(find_further_joints(motion.skeleton, rig, character.skeleton, onto)) {
    onto_.read(rest_.pose(0), body_);
    toes_at_rest_ = std::min(body_.joints[index(kToes[0])].y, body_.joints[index(kToes[1])].y);
    // From here on the floor is at these toes.
    for (Vec3& p : body_.joints) p.y -= toes_at_rest_;
    first_ = std::min(rig.first_frame(), motion.frames - 1);
    world_pose(motion_.skeleton, world_.pose(0), world_.pose(0));
    from_rest_ = world_.rotations;
  }

  Retargeted run() {
    if (const auto same =
            find_same_skeleton(motion_.skeleton, from_.rig(), character_.skeleton, onto_rig_)) {
      // A root that only the character has carries the path.
      if (root_joint_ < 0 || same->from[static_cast<size_t>(root_joint_)] >= 0) return copy(*same);
    }
    std::vector<HumanPositions> joints;
    for (int f = first_; f < motion_.frames; ++f) {
      RotatedBodyPose body;
      from_.read(motion_.pose(f), body);
      joints.push_back(body.joints);
      frames_.push_back(follow(body));
    }
    const auto seconds = static_cast<float>(motion_.frame_time);
    std::vector<FootContacts> contacts = detect_contacts(joints, 1 / motion_.frame_time);
    for (size_t f = 0; f < frames_.size(); ++f) frames_[f].contacts = contacts[f];
    if (options_.feet) hold_feet(body_, seconds, frames_);
    Clip out{character_.skeleton, motion_.frame_time, 0, {}, {}};
    out.resize(static_cast<int>(frames_.size()));
    for (int f = 0; f < out.frames; ++f) write(frames_[f].change, f, out);
    turn_front(out);
    return {std::move(out), std::move(contacts)};
  }

 private:
  // The character at rest; or without a rest pose that stands, its other joints as they are on
  // average in its motion.
  Clip base_pose() const {
    Clip base = onto_rig_.rest();
    if (onto_reference_.from_rest || character_.frames < 2) return base;
    for (size_t j = 0; j < character_.joints(); ++j) {
      Quat sum = {0, 0, 0, 0};
      Vec3d position;
      for (int f = onto_rig_.first_frame(); f < character_.frames; ++f) {
        const Quat q = character_.pose(f).rotations[j];
        const float sign = dot(sum, q) < 0 ? -1.0f : 1.0f;
        sum = {sum.x + sign * q.x, sum.y + sign * q.y, sum.z + sign * q.z, sum.w + sign * q.w};
        position += character_.pose(f).translations[j].as<double>();
      }
      const auto& human = onto_rig_.joints();
      if (std::find(human.begin(), human.end(), static_cast<int>(j)) != human.end()) continue;
      if (character_.skeleton.joints[j].parent < 0) continue;
      base.rotations[j] = normalized(sum);
      base.translations[j] = (position / (character_.frames - onto_rig_.first_frame())).as<float>();
    }
    return base;
  }

  Retargeted copy(const SameSkeleton& same) {
    std::vector<HumanPositions> joints;
    Clip out{character_.skeleton, motion_.frame_time, 0, {}, {}};
    out.resize(motion_.frames - first_);
    for (int f = 0; f < out.frames; ++f) {
      RotatedBodyPose body;
      from_.read(motion_.pose(first_ + f), body);
      joints.push_back(body.joints);
      copy_pose(same, character_.skeleton, motion_.pose(first_ + f), out.pose(f));
    }
    return {std::move(out), detect_contacts(joints, 1 / motion_.frame_time)};
  }

  // VRM 0 faces -z and VRM 1 +z: between two of them, whose joints have roles, the body goes where
  // the character faces.
  void turn_front(Clip& out) const {
    const auto is_vrm = [](const Skeleton& skeleton) {
      return std::any_of(skeleton.joints.begin(), skeleton.joints.end(),
                         [](const Joint& joint) { return !joint.role.empty(); });
    };
    if (!is_vrm(motion_.skeleton) || !is_vrm(character_.skeleton)) return;
    BodyPose from, onto;
    PosedRig(from_.rig()).read(from_.rig().rest().pose(0), from);
    PosedRig(onto_rig_).read(onto_rig_.rest().pose(0), onto);
    if (cosine(onto.facing - from.facing) > 0) return;
    for (int f = 0; f < out.frames; ++f) onto_rig_.transform_root(kHalfTurn, {}, {}, out.pose(f));
  }

  // The rotation of each joint of the motion relative to the T-pose. Spines differ between rigs:
  // the torso's direction follows joint positions, its twist the motion's joints.
  std::array<Quat, kHumanJoints> turns_of(const RotatedBodyPose& from) const {
    std::array<Quat, kHumanJoints> turns;
    for (int j = 0; j < kHumanJoints; ++j) {
      turns[j] = from.rotations[j] * conjugate(from_reference_.rotations[j]);
    }
    const TorsoFrames torso = torso_frames(from.positions, from.facing);
    turns[index(hips)] = torso.hips;
    const auto point = [&](HumanJoint joint, Vec3 to) {
      Quat& turn = turns[index(joint)];
      turn = rotation_between(normalized(rotate(turn, Vec3{0, 1, 0})), to) * turn;
    };
    point(spine, torso.spine);
    point(chest, torso.chest);
    point(neck, torso.neck);
    return turns;
  }

  // The body in the pose of the motion's, feet not yet held.
  GroundedFrame follow(const RotatedBodyPose& from) {
    GroundedFrame frame;
    BodyChange& change = frame.change;
    const Quat to_front = rotation_y(-body_.facing);
    const std::array<Quat, kHumanJoints> turns = turns_of(from);
    for (int j = 0; j < kHumanJoints; ++j) {
      const Quat turned = turns[j];
      const Quat rest = to_front * body_.rotations[j];
      change.rotations[j] = normalized(turned * onto_reference_.rotations[j] * conjugate(rest));
      if (onto_rig_.joints()[j] < 0) change.rotations[j] = change.rotations[kHumanParent[j]];
    }
    change.turn = -body_.facing;
    bend_torso(torso_frames(from.positions, from.facing), change);
    const auto in_size = [&](Vec3 p) {
      return Vec3{p.x, p.y - from_reference_.motion_toes, p.z} * scale_;
    };
    change.translation = in_size(mid_hip(from)) - mid_hip(body_);
    for (int f = 0; f < kFeet; ++f) frame.toes[f] = in_size(from.joints[index(kToes[f])]);
    if (options_.hands) {
      const Vec3 between = from.joints[index(right_hand)] - from.joints[index(left_hand)];
      meet_hands(between / from_reference_.arm, change);
    }
    if (options_.feet) match_heights(body_, frame);
    return frame;
  }

  // Hands that meet in the motion also meet with other arms and shoulders; the middle between them
  // stays. `between`: from the left to the right wrist in the motion, in arm lengths.
  void meet_hands(Vec3 between, BodyChange& change) const {
    const float amount = hands_nearness(length(between));
    if (amount <= 0) return;
    HumanPositions joints;
    changed_joints(body_, change, joints);
    Vec3 left = joints[index(left_hand)], right = joints[index(right_hand)];
    bring_together(between * onto_reference_.arm, amount, 0.5f, left, right);
    reach_with_limb(arm_joints(0), left, joints, change);
    reach_with_limb(arm_joints(1), right, joints, change);
  }

  // A torso with different joints approximates the motion's curve at once, and matches it in a few
  // steps.
  void bend_torso(const TorsoFrames& wanted, BodyChange& change) {
    constexpr int kSteps = 3;
    for (int step = 0; step < kSteps; ++step) {
      onto_.write(rest_.pose(0), body_, change, seen_.pose(0));
      BodyPose seen;
      look_.read(seen_.pose(0), seen);
      const TorsoFrames got = torso_frames(seen.positions, seen.facing);
      const auto turn = [&](HumanJoint joint, Quat by) {
        Quat& rotation = change.rotations[index(joint)];
        if (onto_rig_.joints()[index(joint)] >= 0) rotation = normalized(by * rotation);
      };
      turn(hips, wanted.hips * conjugate(got.hips));
      turn(spine, rotation_between(got.spine, wanted.spine));
      turn(chest, rotation_between(got.chest, wanted.chest));
      turn(neck, rotation_between(got.neck, wanted.neck));
      for (int j = 1; j < kHumanJoints; ++j) {
        if (onto_rig_.joints()[j] < 0) change.rotations[j] = change.rotations[kHumanParent[j]];
      }
    }
  }

  void write(const BodyChange& change, int frame, Clip& out) {
    BodyChange moved = change;
    moved.translation.y += onto_reference_.rest_toes - toes_at_rest_;
    const Pose pose = out.pose(frame);
    onto_.write(rest_.pose(0), body_, moved, pose);
    if (!further_.empty()) turn_further_joints(frame, pose);
  }

  // Each turns relative to its human joint as in the motion, both relative to the T-pose. Its
  // parent may be another such joint, or one at rest.
  void turn_further_joints(int frame, const Pose& pose) {
    world_pose(motion_.skeleton, motion_.pose(first_ + frame), world_.pose(0));
    for (const JointPair& pair : further_) {
      const int from_human = from_.rig().joints()[pair.human];
      const int onto_human = onto_rig_.joints()[pair.human];
      const auto relative = [&](const std::vector<Quat>& world, int joint) {
        return conjugate(world[from_human]) * world[joint];
      };
      const Quat turned =
          relative(world_.rotations, pair.from) * conjugate(relative(from_rest_, pair.from));
      const Quat in_t_pose = in_axes(from_reference_.rotations[pair.human], turned);
      const Quat in_onto = in_axes(conjugate(onto_reference_.rotations[pair.human]), in_t_pose);
      // The joint relative to its human joint, and the chain between.
      Quat above, rest;
      chain(pair.onto, onto_human, pose, above, rest);
      pose.rotations[pair.onto] = normalized(conjugate(above) * in_onto * rest);
    }
  }

  // above: from the human joint to the joint's parent in the pose; rest: to the joint, at rest.
  void chain(int joint, int human, const Pose& pose, Quat& above, Quat& rest) const {
    const auto& joints = character_.skeleton.joints;
    rest = joints[joint].rest;
    for (int up = joints[joint].parent; up != human && up >= 0; up = joints[up].parent) {
      above = pose.rotations[up] * above;
      rest = joints[up].rest * rest;
    }
  }

  const Clip& motion_;
  const Clip& character_;
  const Rig& onto_rig_;
  RetargetOptions options_;
  PosedRig from_;
  int root_joint_;  // Of the character, or -1.
  PosedRig onto_;
  PosedRig look_;  // Reads the written pose, into
  Clip seen_;
  ReferencePose from_reference_, onto_reference_;
  float scale_;  // Ratio of leg lengths, character to motion.
  Clip rest_;    // Of the character.
  Clip world_;   // A pose of the motion's skeleton, world.
  std::vector<JointPair> further_;
  std::vector<Quat> from_rest_;  // [joints of the motion], world.
  RotatedBodyPose body_;         // At rest, its toes at 0.
  float toes_at_rest_ = 0;       // Where they were.
  int first_ = 0;                // Frame of the motion.
  std::vector<GroundedFrame> frames_;
};

}  // namespace

Result<Retargeted> retarget(const Clip& motion, const Rig& rig, const Clip& character,
                            const Rig& onto, const RetargetOptions& options) {
  if (!onto.can_move()) {
    return Error{
        "neither the hips of the character nor a joint above them can move; expected translation "
        "channels at one of them"};
  }
  return Retargeter(motion, rig, character, onto, options).run();
}

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
