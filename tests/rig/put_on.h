#pragma once
// Any motion of the canonical body on the rig of a maker.

#include "clip/clip.h"
#include "rig/makers.h"

namespace panache::test {

// A maker's rig as a clip, and where its joints come from.
struct Character {
  Clip clip;
  std::vector<int>
      followed;  // [joints]: the human joint whose frame each one follows, -1 for none.
};

inline Vec3 to_z_up(Vec3 v) { return {v.x, -v.z, v.y}; }

// How the rest pose of a maker turns a human joint against the T-pose.
inline Quat rest_turn(RestPose rest, int human) {
  using enum HumanJoint;
  const float deg = rest == RestPose::a ? 45.0f : rest == RestPose::arms_down ? 80.0f : 0.0f;
  const float angle = deg / 180 * 3.14159265f;
  const auto in = [&](HumanJoint from, HumanJoint to) {
    return human >= index(from) && human <= index(to);
  };
  if (in(left_upper_arm, left_hand)) return exp_rotation(Vec3{0, 0, -angle});
  if (in(right_upper_arm, right_hand)) return exp_rotation(Vec3{0, 0, angle});
  return {};
}

// The canonical body in T-pose with the maker's lengths, feet on the ground.
inline HumanPositions maker_body(const Maker& maker) {
  using enum HumanJoint;
  const HumanPositions body = t_pose();
  HumanPositions out;
  for (int j = 0; j < kHumanJoints; ++j) {
    const auto is = [&](HumanJoint left) {
      return j == index(left) || kHumanMirror[j] == index(left);
    };
    const bool leg = is(left_lower_leg) || is(left_foot) || is(left_toes);
    const bool arm = is(left_lower_arm) || is(left_hand);
    const float scale = leg ? maker.legs : arm ? maker.arms : maker.torso;
    const int above = kHumanParent[j];
    if (above >= 0) out[j] = out[above] + (body[j] - body[above]) * scale;
  }
  const float lowest = out[index(left_toes)].y;
  for (Vec3& p : out) p.y -= lowest;
  return out;
}

// `motion`: a clip of canonical_skeleton(). Every joint of the maker's rig follows the joint that
// it belongs to; root motion is scaled with the legs. turn: about the vertical,
// radians.
inline Character put_on(const Maker& maker, const Clip& motion, float turn = 0,
                        double units_per_metre = 0, std::optional<bool> z_up = {}) {
  using enum HumanJoint;
  const auto units =
      static_cast<float>(units_per_metre > 0 ? units_per_metre : maker.units_per_metre);
  const bool upward_z = z_up.value_or(maker.z_up);
  const HumanPositions body = maker_body(maker);
  const Quat axes = upward_z ? exp_rotation(Vec3{3.14159265f / 2, 0, 0}) : Quat{};
  std::mt19937 random(7);
  Character out;
  std::map<std::string, int> joint_of;
  std::vector<Vec3> t_position;
  std::vector<Quat> t_axes;
  const auto add = [&](const std::string& name, const std::string& parent, int human, float along) {
    const int above = kHumanParent[human];
    Joint joint;
    joint.name = name;
    joint.parent = parent.empty() ? -1 : joint_of.at(parent);
    Vec3 at = above < 0 ? body[human] * along : lerp(body[above], body[human], along);
    int human_frame = along < 1 ? above : human;
    if (above < 0 && along < 1) human_frame = joint.parent < 0 ? -1 : out.followed[joint.parent];
    const Quat rest = human_frame < 0 ? Quat{} : rest_turn(maker.rest, human_frame);
    t_axes.push_back(maker.axes == Axes::own ? random_rotation(random, 3) : conjugate(axes * rest));
    const size_t i = t_position.size();
    t_position.push_back(at);
    const auto world_rest = [&](size_t j) {
      const int follows = out.followed[j];
      return axes * (follows < 0 ? Quat{} : rest_turn(maker.rest, follows)) * t_axes[j];
    };
    out.followed.push_back(human_frame);
    if (joint.parent < 0) {
      joint.offset = rotate(axes, at) * units;
      joint.rest = world_rest(i);
    } else {
      const auto p = static_cast<size_t>(joint.parent);
      joint.offset = rotate(conjugate(t_axes[p]), at - t_position[p]) * units;
      joint.rest = conjugate(world_rest(p)) * world_rest(i);
    }
    if (maker.axes == Axes::world) joint.rest = {};
    joint.can_rotate = true;
    joint.can_translate = joint.parent < 0 || (human == index(hips) && along == 1);
    joint_of[name] = static_cast<int>(i);
    out.clip.skeleton.joints.push_back(joint);
  };
  for (const Line& line : maker.lines) {
    const int human = index(line.target);
    if (line.name.find('*') == std::string::npos) {
      add(line.name, line.parent, human, line.along);
      continue;
    }
    for (const bool left : {true, false}) {
      const std::string side = left ? maker.left : maker.right;
      add(with_side(line.name, side), with_side(line.parent, side),
          left ? human : kHumanMirror[human], line.along);
    }
  }

  const size_t joints = out.clip.joints();
  out.clip.frame_time = motion.frame_time;
  out.clip.resize(motion.frames);
  std::vector<Quat> human_rotation(kHumanJoints), world(joints);
  std::vector<Vec3> human_at(kHumanJoints);
  const Quat to_file = axes * rotation_y(turn);
  const Vec3 mid_hip_offset =
      (body[index(left_upper_leg)] + body[index(right_upper_leg)]) * 0.5f - body[index(hips)];
  for (int f = 0; f < motion.frames; ++f) {
    world_pose(motion.skeleton, motion.pose(f), {human_rotation, human_at});
    const Vec3 mid_hip =
        (human_at[index(left_upper_leg)] + human_at[index(right_upper_leg)]) * 0.5f * maker.legs;
    const Vec3 hips_at = mid_hip - rotate(human_rotation[0], mid_hip_offset);
    const Pose pose = out.clip.pose(f);
    bool placed = false;
    for (size_t j = 0; j < joints; ++j) {
      const Joint& joint = out.clip.skeleton.joints[j];
      const int follows = out.followed[j];
      world[j] = follows < 0 ? axes * t_axes[j] : to_file * human_rotation[follows] * t_axes[j];
      pose.rotations[j] =
          joint.parent < 0 ? world[j] : normalized(conjugate(world[joint.parent]) * world[j]);
      pose.translations[j] = joint.offset;
      if (placed || follows != index(hips)) continue;
      // The hips are the first to follow themselves; a root above them stands at the origin.
      placed = true;
      const Vec3 at = rotate(to_file, hips_at) * units;
      pose.translations[j] = joint.parent < 0 ? at : rotate(conjugate(world[joint.parent]), at);
    }
  }
  return out;
}

// Its joints by the names that a person gives them; -1 where it has none.
inline std::array<int, kHumanJoints> expected_joints(const Maker& maker, const Clip& clip) {
  const HumanNames names = names_of(maker.lines, maker.left, maker.right);
  std::array<int, kHumanJoints> out;
  out.fill(-1);
  for (size_t h = 0; h < names.size(); ++h) {
    for (size_t j = 0; j < clip.joints(); ++j) {
      if (clip.skeleton.joints[j].name == names[h]) out[h] = static_cast<int>(j);
    }
  }
  return out;
}

}  // namespace panache::test
