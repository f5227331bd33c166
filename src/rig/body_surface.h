#pragma once
// A smooth human surface around the joints of a humanoid, as a signed distance: the shape that a
// body mesh is cut from.

#include <array>
#include <vector>

#include "base/quat.h"
#include "rig/humanoid.h"

namespace panache {

// Where a joint stands while the surface is made: arms and legs a little apart from each other and
// from the torso, so that nothing touches that has to part later. World, metres, Y up.
struct BindPose {
  HumanPositions positions;
  std::array<Quat, kHumanJoints> rotations;
};

// `offsets`: of each joint from its parent in the canonical T-pose's axes, metres, for legs as long
// as the canonical body's; zero where the joint is missing; the hips' is their height.
BindPose bind_pose(const HumanPositions& offsets);

class BodySurface {
 public:
  explicit BodySurface(const HumanPositions& offsets);

  const BindPose& bind() const { return bind_; }
  // Metres to the surface, below zero inside; near enough to a distance to step by.
  float distance(Vec3 point) const;
  // Moves a point near the surface onto it, nearly; the unit normal there.
  Vec3 approach(Vec3& point) const;
  // Metres from `point` to the parts of each joint alone.
  void joint_distances(Vec3 point, std::array<float, kHumanJoints>& out) const;
  // 1 where the body is drawn in its second colour (face, hands, feet), 0 elsewhere, with a soft
  // edge.
  float accent(Vec3 point) const;
  // The corners of a box around the surface.
  Vec3 low() const { return low_; }
  Vec3 high() const { return high_; }

 private:
  static constexpr size_t kRings = 5;
  using Radii = std::array<float, kRings>;  // At even steps from end to end; between them a spline.

  enum class Use { both, shape, weights };

  // A tube with round ends, squeezed along its joint's axes.
  struct Part {
    HumanJoint joint;
    int group;      // Parts of one group melt into each other first.
    Vec3 from, to;  // In the axes of the joint, from the joint.
    Radii radii;
    float soft = 0.004f;       // How softly it melts into the parts of its group before it, metres.
    Vec3 bow = {};             // How far the middle lies off the straight line.
    Vec3 squeeze = {1, 1, 1};  // 1 leaves the axis as it is, 0.5 makes the part half as thick.
    Use use = Use::both;
    float sole = -1e3f;  // The part ends below this height of the joint's axes.
  };
  // A part in the world.
  struct PlacedPart {
    Part part;
    Vec3 from, along, bow;    // Squeezed.
    float along_squared = 0;  // Of `along`, or 1 where that has no length.
    float thinnest = 1;
    Vec3 middle;  // Of a ball of the radius `reach` that holds the part, world.
    float reach = 0;
  };

  void add(const Part& part);
  void add(HumanJoint joint, int group, Vec3 from, Vec3 to, const Radii& radii, float soft = 0.004f,
           Vec3 bow = {}, Vec3 squeeze = {1, 1, 1}) {
    add(Part{joint, group, from, to, radii, soft, bow, squeeze});
  }
  void add_torso();
  void add_head();
  void add_arm(const HumanPositions& offsets, int side);
  void add_leg(const HumanPositions& offsets, int side);
  float part_distance(const PlacedPart& placed, Vec3 point) const;
  Vec3 place(HumanJoint joint) const { return bind_.positions[index(joint)]; }
  Vec3 to_joint(int joint, Vec3 point) const;

  BindPose bind_;
  std::vector<PlacedPart> parts_;
  std::array<float, 2> hand_size_{};
  Vec3 low_, high_;
};

}  // namespace panache
