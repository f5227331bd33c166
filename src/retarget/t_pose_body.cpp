#include "retarget/reference_pose.h"

#include <array>
#include <string>
#include <utility>

#include "retarget/joint_pairs.h"
#include "rig/canonical_body.h"
#include "rig/posed_rig.h"

namespace panache {
namespace {

using enum HumanJoint;

// The rig's own joints at rest, world, metres.
HumanPositions joints_at_rest(const Rig& rig) {
  const Clip rest = rig.rest();
  PosedRig reader(rig);
  BodyPose body;
  reader.read(rest.pose(0), body);
  return body.joints;
}

// A finger of the canonical body: its origin at the hand and the lengths of its parts; the left
// hand in T-pose, metres.
struct Finger {
  std::string_view name;
  std::array<std::string_view, 3> parts;
  Vec3 base;
  float length;
};
constexpr std::array<std::string_view, 3> kParts = {"Proximal", "Intermediate", "Distal"};
constexpr std::array<Finger, 5> kFingers = {{
    {"thumb", {"Metacarpal", "Proximal", "Distal"}, {0.025f, -0.01f, 0.03f}, 0.03f},
    {"index", kParts, {0.085f, 0, 0.03f}, 0.028f},
    {"middle", kParts, {0.09f, 0, 0.008f}, 0.03f},
    {"ring", kParts, {0.085f, 0, -0.012f}, 0.028f},
    {"little", kParts, {0.078f, 0, -0.03f}, 0.022f},
}};

void add_finger(Skeleton& body, int hand, const Finger& finger, float size) {
  const bool left = hand == index(left_hand);
  const float side = left ? 1.0f : -1.0f;
  // A thumb points half ahead.
  const Vec3 along = finger.name == "thumb" ? Vec3{0.7071f, 0, 0.7071f} : Vec3{1, 0, 0};
  std::string name = (left ? "left" : "right") + std::string(finger.name);
  name[left ? 4 : 5] = static_cast<char>(finger.name.front() - 'a' + 'A');
  int parent = hand;
  for (size_t i = 0; i < finger.parts.size(); ++i) {
    const Vec3 offset = (i == 0 ? finger.base : along * finger.length) * size;
    Joint joint;
    joint.name = joint.role = name + std::string(finger.parts[i]);
    joint.parent = parent;
    joint.offset = {side * offset.x, offset.y, offset.z};
    joint.can_rotate = true;
    parent = static_cast<int>(body.joints.size());
    body.joints.push_back(std::move(joint));
  }
}

}  // namespace

Clip t_pose_body(const Clip& clip, const Rig& rig) {
  HumanPositions joints = joints_at_rest(rig);
  for (Vec3& p : joints) p *= rig.unit() / rig.scale();
  const auto length_of = [&](int joint) {
    return length(joints[joint] - joints[kHumanParent[joint]]);
  };
  Skeleton body = canonical_skeleton();
  float leg = 0;
  for (const HumanJoint joint : {left_lower_leg, left_foot, right_lower_leg, right_foot}) {
    leg += length_of(index(joint)) / 2;
  }
  const float size = leg / kProportions.leg;
  for (Joint& joint : body.joints) {
    joint.role = joint.name;
    joint.offset *= size;
    for (Vec3& end : joint.ends) end *= size;
  }
  // Symmetric, or the body would not stand straight.
  for (const HumanJoint joint : {left_lower_arm, left_hand, left_lower_leg, left_foot}) {
    const int left = index(joint), right = kHumanMirror[left];
    const float mean = (length_of(left) + length_of(right)) / 2;
    for (const int j : {left, right}) {
      if (mean > 0) body.joints[j].offset = normalized(body.joints[j].offset) * mean;
    }
  }
  for (const auto& [hand, finger] : find_fingers(clip.skeleton, rig)) {
    for (const Finger& known : kFingers) {
      if (known.name == finger) add_finger(body, hand, known, size);
    }
  }
  return rest_clip(body);
}

}  // namespace panache
