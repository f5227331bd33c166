#pragma once
// One pose of the canonical body, for tests of stages.

#include <initializer_list>
#include <utility>

#include "make_clip.h"
#include "rig/posed_rig.h"

namespace panache::test {

using JointTurn = std::pair<HumanJoint, Quat>;

// The body that stands with arms along x, with these local rotations; hips `height` above the
// floor.
inline BodyPose posed_body(std::initializer_list<JointTurn> turns, float height = 0.92f) {
  Clip clip = walking_clip(1);
  const Rig rig = *Rig::create(clip);
  const Pose pose = clip.pose(0);
  for (size_t j = 0; j < clip.joints(); ++j) pose.rotations[j] = {};
  for (const auto& [joint, turn] : turns) pose.rotations[static_cast<size_t>(index(joint))] = turn;
  pose.translations[0].y = height;
  PosedRig posed(rig);
  BodyPose body;
  posed.read(pose, body);
  return body;
}

// The change that turns these joints, and all that hangs on them, about world axes.
inline BodyChange turned(std::initializer_list<JointTurn> turns) {
  BodyChange change;
  for (int j = 0; j < kHumanJoints; ++j) {
    const int parent = kHumanParent[j];
    change.rotations[j] = parent < 0 ? Quat{} : change.rotations[parent];
    for (const auto& [joint, turn] : turns) {
      if (index(joint) == j) change.rotations[j] = turn * change.rotations[j];
    }
  }
  return change;
}

inline bool same(const BodyChange& a, const BodyChange& b) {
  return a.rotations == b.rotations && a.turn == b.turn && a.translation == b.translation;
}

inline constexpr Vec3 kX = {1, 0, 0}, kY = {0, 1, 0}, kZ = {0, 0, 1};

}  // namespace panache::test
