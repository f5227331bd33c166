#pragma once
// A smooth human surface around the joints of a humanoid, as a signed distance field; body meshes
// are extracted from it.

#include <array>
#include <vector>

#include "base/quat.h"
#include "rig/humanoid.h"

namespace panache {

// The pose in which the surface is made: arms and legs slightly away from each other and from the
// torso, so that separate parts do not touch. World, metres, Y up.
struct BindPose {
  HumanPositions positions;
  std::array<Quat, kHumanJoints> rotations;
};

// `offsets`: each joint relative to its parent in the axes of the canonical T-pose, metres, scaled
// to canonical legs; zero for missing joints; the hips' offset is their height.
BindPose bind_pose(const HumanPositions& offsets);

class BodySurface {
 public:
  explicit BodySurface(const HumanPositions& offsets);

  const BindPose& bind() const { return bind_; }
  // Metres to the surface, negative inside; accurate enough for ray marching.
  float distance(Vec3 point) const;
  // Moves a nearby point approximately onto the surface and returns the unit normal there.
  Vec3 approach(Vec3& point) const;
  // Metres from `point` to each joint's own parts.
  void joint_distances(Vec3 point, std::array<float, kHumanJoints>& out) const;
  // 1 in the body's second colour (face, hands, feet), 0 elsewhere, with a soft edge.
  float accent(Vec3 point) const;
  // The corners of a box around the surface.
  Vec3 low() const { return low_; }
  Vec3 high() const { return high_; }

 private:
  static constexpr size_t kRings = 5;
  using Radii = std::array<float, kRings>;  // Evenly spaced from end to end, with a spline between.

  enum class Use { both, shape, weights };

  // A tube with round ends, squeezed along its joint's axes.
  struct Part {
    HumanJoint joint;
    int group;      // Parts of one group are blended first.
    Vec3 from, to;  // In the joint's space.
    Radii radii;
    float soft = 0.004f;       // Width of the blend with earlier parts of the group, metres.
    Vec3 bow = {};             // Offset of the middle from the straight line.
    Vec3 squeeze = {1, 1, 1};  // Scale per axis: 0.5 halves the thickness.
    Use use = Use::both;
    float sole = -1e3f;  // The part is cut off below this height in the joint's space.
  };
  // A part in the world.
  struct PlacedPart {
    Part part;
    Vec3 from, along, bow;    // Squeezed.
    float along_squared = 0;  // Of `along`; 1 if its length is zero.
    float thinnest = 1;
    Vec3 middle;  // Centre of the bounding sphere, world; `reach`: its radius.
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
  Vec3 bind_position(HumanJoint joint) const { return bind_.positions[index(joint)]; }
  Vec3 to_joint(int joint, Vec3 point) const;

  BindPose bind_;
  std::vector<PlacedPart> parts_;
  std::array<float, 2> hand_size_{};
  Vec3 low_, high_;
};

}  // namespace panache
