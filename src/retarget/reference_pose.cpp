#include "retarget/reference_pose.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "pose/contacts.h"
#include "rig/canonical_body.h"
#include "rig/posed_rig.h"

namespace panache {
namespace {

using enum HumanJoint;

constexpr int kMaxFrames = 400;  // Samples of the motion, evenly spread.
// Cosines of the largest angles of a standing rest pose: torso and legs to the vertical, forearm to
// upper arm.
constexpr float kUpright = 0.8f, kUprightLeg = 0.75f, kStraightArm = 0.5f;
// A foot is flat in this share of the frames, those with the lowest ankle.
constexpr float kFlatShare = 0.2f;
// Toes are on the floor in this share of the frames, their lowest.
constexpr float kFloorShare = 0.02f;
// A rest pose stands if its toes are this near to the plane, in leg lengths.
constexpr float kNearPlane = 0.25f;

struct Arm {
  int upper, lower, hand;
  Vec3 along;  // In T-pose.
};
constexpr std::array<Arm, 2> kArms = {
    {{index(left_upper_arm), index(left_lower_arm), index(left_hand), {1, 0, 0}},
     {index(right_upper_arm), index(right_lower_arm), index(right_hand), {-1, 0, 0}}}};

// The mean of similar rotations, whatever the signs of their quaternions.
class MeanRotation {
 public:
  void add(Quat q) {
    const float sign = dot(sum_, q) < 0 ? -1.0f : 1.0f;
    sum_ = {sum_.x + sign * q.x, sum_.y + sign * q.y, sum_.z + sign * q.z, sum_.w + sign * q.w};
    ++count_;
  }
  std::optional<Quat> mean() const {
    return count_ ? std::optional(normalized(sum_)) : std::nullopt;
  }

 private:
  Quat sum_ = {0, 0, 0, 0};
  int count_ = 0;
};

Vec3 direction(const HumanPositions& joints, int from, int to) {
  return normalized(joints[to] - joints[from]);
}

float toes_height(const HumanPositions& joints) {
  return std::min(joints[index(kToes[0])].y, joints[index(kToes[1])].y);
}

// The heading of a foot, about +y; nothing if it points up or down.
std::optional<float> foot_heading(const HumanPositions& joints, int foot) {
  const Vec3 ahead = direction(joints, index(kAnkles[foot]), index(kToes[foot]));
  if (std::abs(ahead.y) > 0.95f) return std::nullopt;
  return arc_tangent(ahead.x, ahead.z);
}

class Finder {
 public:
  Finder(const Clip& clip, const Rig& rig) : clip_(clip), rig_(rig) {
    PosedRig reader(rig);
    const Clip rest = rig.rest();
    reader.read(rest.pose(0), rest_);
    const int first = std::min(rig.first_frame(), clip.frames - 1);
    const int step = (clip.frames - first + kMaxFrames - 1) / kMaxFrames;
    for (int f = first; f < clip.frames; f += std::max(step, 1)) {
      RotatedBodyPose body;
      if (reader.read(clip.pose(f), body)) motion_.push_back(body);
    }
    if (motion_.empty()) motion_.push_back(rest_);
  }

  ReferencePose find() {
    turn_rest();
    out_.from_rest = stands();
    measure();
    if (out_.from_rest) {
      take_rest();
    } else {
      take_motion();
      flatten_feet();
    }
    for (int j = 1; j < kHumanJoints; ++j) {
      if (rig_.joints()[j] < 0) out_.rotations[j] = out_.rotations[kHumanParent[j]];
    }
    return out_;
  }

 private:
  // Of one arm and one leg, means of both sides.
  static std::pair<float, float> limb_lengths(const HumanPositions& joints) {
    const auto limb = [&](int upper, int lower, int end) {
      return (length(joints[lower] - joints[upper]) + length(joints[end] - joints[lower])) / 2;
    };
    float arm = 0, leg = 0;
    for (const Arm& of : kArms) arm += limb(of.upper, of.lower, of.hand);
    for (int f = 0; f < kFeet; ++f) {
      leg += limb(index(kUpperLegs[f]), index(kLowerLegs[f]), index(kAnkles[f]));
    }
    return {arm, leg};
  }

  void measure() {
    std::vector<float> legs, heights, hips_heights;
    for (const BodyPose& body : motion_) {
      legs.push_back(limb_lengths(body.joints).second);
      heights.push_back(toes_height(body.joints));
      hips_heights.push_back(body.joints[index(hips)].y);
    }
    std::tie(out_.arm, out_.leg) = limb_lengths(motion_.front().joints);
    std::nth_element(legs.begin(), legs.begin() + static_cast<long>(legs.size() / 2), legs.end());
    // A body that grows in its first frames has its size at rest, which the rig measures too.
    constexpr float kStays = 0.01f;
    const auto [arm, leg] = limb_lengths(rest_.joints);
    if (std::abs(out_.leg - legs[legs.size() / 2]) > kStays * out_.leg && leg > 0) {
      out_.arm = arm;
      out_.leg = leg;
    }
    const auto low = static_cast<long>(kFloorShare * static_cast<float>(heights.size() - 1));
    std::nth_element(heights.begin(), heights.begin() + low, heights.end());
    const float plane = -rig_.floor();
    const float rest = toes_height(rest_.joints);
    const bool near_plane = std::abs(rest - plane) < kNearPlane * out_.leg;
    const float top = *std::max_element(hips_heights.begin(), hips_heights.end());
    out_.motion_toes = out_.from_rest && near_plane
                           ? rest
                           : floor_of_motion(heights[low] - plane, top - plane) + plane;
    out_.rest_toes = near_plane ? rest : clip_.frames > 1 ? heights[low] : plane;
  }

  // Where toes stand, above the file's plane, without a rest pose that shows it. lowest, top: the
  // lowest toes and the highest hips of the motion, above that plane. The plane is the floor even
  // if the motion never reaches it, as in a jump, or goes below it, downhill; but the lowest toes
  // stand where they are near to it, or where the hips are at the plane.
  float floor_of_motion(float lowest, float top) const {
    constexpr float kStanding = 0.12f, kHipsAtPlane = 0.5f;
    if (lowest > kStanding * out_.leg) return 0;
    if (lowest > -kNearPlane * out_.leg || top < kHipsAtPlane * out_.leg) return lowest;
    return 0;
  }

  // The rest pose, turned to face +z.
  void turn_rest() {
    const Quat turn = rotation_y(-rest_.facing);
    for (Vec3& p : rest_.joints) p = rotate(turn, p);
    for (Vec3& p : rest_.positions) p = rotate(turn, p);
    for (Quat& q : rest_.rotations) q = turn * q;
  }

  float steepest_leg() const {
    float min = 1;
    for (int f = 0; f < kFeet; ++f) {
      const int upper = index(kUpperLegs[f]), lower = index(kLowerLegs[f]);
      min = std::min({min, -direction(rest_.joints, upper, lower).y,
                      -direction(rest_.joints, lower, index(kAnkles[f])).y});
    }
    return min;
  }

  bool stands() const {
    if (torso().y < kUpright || steepest_leg() < kUprightLeg) return false;
    return std::all_of(kArms.begin(), kArms.end(), [&](const Arm& arm) {
      const Vec3 upper = direction(rest_.joints, arm.upper, arm.lower);
      const Vec3 lower = direction(rest_.joints, arm.lower, arm.hand);
      return dot(upper, lower) > kStraightArm && dot(upper, arm.along) > -0.3f && upper.y < 0.7f;
    });
  }

  // From the middle of the hip joints to that of the shoulders, in the rest pose.
  Vec3 torso() const {
    const auto at = [&](HumanJoint joint) { return rest_.joints[index(joint)]; };
    return normalized((at(left_upper_arm) + at(right_upper_arm)) -
                      (at(left_upper_leg) + at(right_upper_leg)));
  }

  // The torso is made upright joint by joint, as rest poses may lean and curve; head and shoulders
  // stay as at rest. Whole limbs turn about shoulder and hip, then again below elbow and knee.
  void take_rest() {
    out_.rotations = rest_.rotations;
    const TorsoFrames torso = torso_frames(rest_.positions, 0);
    out_.rotations[index(hips)] = conjugate(torso.hips) * rest_.rotations[index(hips)];
    out_.rotations[index(spine)] =
        rotation_between(torso.spine, {0, 1, 0}) * rest_.rotations[index(spine)];
    out_.rotations[index(chest)] =
        rotation_between(torso.chest, {0, 1, 0}) * rest_.rotations[index(chest)];
    out_.rotations[index(neck)] =
        rotation_between(torso.neck, {0, 1, 0}) * rest_.rotations[index(neck)];
    const auto limb = [&](int upper, int lower, int end, Vec3 along) {
      const Quat first = rotation_between(direction(rest_.joints, upper, lower), along);
      const Vec3 rest = rotate(first, direction(rest_.joints, lower, end));
      const Quat second = rotation_between(rest, along) * first;
      out_.rotations[upper] = first * rest_.rotations[upper];
      out_.rotations[lower] = second * rest_.rotations[lower];
      return second;
    };
    for (const Arm& arm : kArms) {
      const Quat turn = limb(arm.upper, arm.lower, arm.hand, arm.along);
      out_.rotations[arm.hand] = turn * rest_.rotations[arm.hand];
    }
    for (int f = 0; f < kFeet; ++f) {
      limb(index(kUpperLegs[f]), index(kLowerLegs[f]), index(kAnkles[f]), {0, -1, 0});
      const Quat ahead = rotation_y(-foot_heading(rest_.joints, f).value_or(0));
      for (const HumanJoint joint : {kAnkles[f], kToes[f]}) {
        out_.rotations[index(joint)] = ahead * rest_.rotations[index(joint)];
      }
    }
  }

  // canonical_frames() gives the same body's rotations with the world's axes in T-pose.
  void take_motion() {
    std::array<MeanRotation, kHumanJoints> means;
    for (const RotatedBodyPose& body : motion_) {
      std::array<Quat, kHumanJoints> frames;
      canonical_frames(body.positions, body.facing, frames);
      for (int j = 0; j < kHumanJoints; ++j) means[j].add(conjugate(frames[j]) * body.rotations[j]);
    }
    for (int j = 0; j < kHumanJoints; ++j) out_.rotations[j] = *means[j].mean();
  }

  // Feet and toes as they are while the ankle is low.
  void flatten_feet() {
    for (int f = 0; f < kFeet; ++f) {
      const int ankle = index(kAnkles[f]);
      std::vector<const RotatedBodyPose*> lowest;
      lowest.reserve(motion_.size());
      for (const RotatedBodyPose& body : motion_) lowest.push_back(&body);
      std::sort(lowest.begin(), lowest.end(),
                [&](const RotatedBodyPose* a, const RotatedBodyPose* b) {
                  return a->joints[ankle].y < b->joints[ankle].y;
                });
      lowest.resize(1 + static_cast<size_t>(kFlatShare * static_cast<float>(lowest.size() - 1)));
      for (const HumanJoint joint : {kAnkles[f], kToes[f]}) {
        MeanRotation mean;
        for (const RotatedBodyPose* body : lowest) {
          const std::optional<float> heading = foot_heading(body->joints, f);
          if (heading) mean.add(rotation_y(-*heading) * body->rotations[index(joint)]);
        }
        if (mean.mean()) out_.rotations[index(joint)] = *mean.mean();
      }
    }
  }

  const Clip& clip_;
  const Rig& rig_;
  RotatedBodyPose rest_;  // Facing +z, once it was turned.
  std::vector<RotatedBodyPose> motion_;
  ReferencePose out_;
};

}  // namespace

TorsoFrames torso_frames(const HumanPositions& positions, float facing) {
  const auto at = [&](HumanJoint joint) { return positions[index(joint)]; };
  std::array<Quat, kHumanJoints> frames;
  canonical_frames(positions, facing, frames);
  const Vec3 shoulders = (at(left_upper_arm) + at(right_upper_arm)) * 0.5f;
  return {frames[index(hips)], normalized(at(chest) - at(spine), {0, 1, 0}),
          normalized(shoulders - at(chest), {0, 1, 0}), normalized(at(head) - at(neck), {0, 1, 0})};
}

ReferencePose find_reference_pose(const Clip& clip, const Rig& rig) {
  return Finder(clip, rig).find();
}

}  // namespace panache
