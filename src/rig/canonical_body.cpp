#include "rig/canonical_body.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace panache {
namespace {

using enum HumanJoint;

constexpr Vec3 kUp = {0, 1, 0};
constexpr Vec3 kDown = {0, -1, 0};

// Position of a missing spine, as a fraction from mid-hip to the chest.
constexpr float kSpineOnTorso = 0.6f;

// The line from mid-hip through the torso's joints to mid-shoulder.
class Torso {
 public:
  void add(Vec3 p) {
    along_[count_] = count_ ? along_[count_ - 1] + length(p - points_[count_ - 1]) : 0;
    points_[count_++] = p;
  }
  float total() const { return along_[count_ - 1]; }
  // The point at `fraction` of the way.
  Vec3 at(float fraction) const {
    const float s = fraction * total();
    int k = 0;
    while (k < count_ - 2 && s > along_[k + 1]) ++k;
    const float step = std::max(along_[k + 1] - along_[k], 1e-9f);
    return lerp(points_[k], points_[k + 1], (s - along_[k]) / step);
  }

 private:
  std::array<Vec3, 4> points_;
  std::array<float, 4> along_{};
  int count_ = 0;
};

class Builder {
 public:
  Builder(const HumanPositions& joints, const BodyShape& shape) : joints_(joints), shape_(shape) {}

  HumanPositions build(const std::array<Vec3, 2>& toes) {
    mid_hip_ = (at(left_upper_leg) + at(right_upper_leg)) * 0.5f;
    mid_shoulder_ = (at(left_upper_arm) + at(right_upper_arm)) * 0.5f;
    build_torso();
    build_arms();
    build_legs(toes);
    return out_;
  }

 private:
  Vec3 at(HumanJoint joint) const { return joints_[index(joint)]; }
  bool has(HumanJoint joint) const { return shape_.has[index(joint)]; }
  Vec3& out(HumanJoint joint) { return out_[index(joint)]; }

  // Puts `joint` at its canonical length from its parent, along the user's direction.
  void extend(HumanJoint joint, Vec3 otherwise) {
    const int j = index(joint), p = kHumanParent[j];
    out_[j] = out_[p] + normalized(joints_[j] - joints_[p], otherwise) * kProportions.length[j];
  }

  Torso torso() const {
    Torso line;
    line.add(mid_hip_);
    if (has(chest)) {
      line.add(has(spine) ? at(spine) : lerp(mid_hip_, at(chest), kSpineOnTorso));
      if (!shape_.chest_at_shoulders) line.add(at(chest));
    } else if (has(spine)) {
      line.add(at(spine));
    }
    line.add(mid_shoulder_);
    return line;
  }

  void build_torso() {
    const Proportions& body = kProportions;
    const Frame hip_frame =
        frame_of(at(left_upper_leg) - at(right_upper_leg), mid_shoulder_ - mid_hip_);
    out(hips) = mid_hip_ - hip_frame(body.hips_to_mid_hip);
    const Torso line = torso();
    const float scale = body.torso / std::max(line.total(), 1e-6f);
    const Vec3 at_spine = line.at(body.spine_fraction), at_chest = line.at(body.chest_fraction);
    out(spine) = mid_hip_ + (at_spine - mid_hip_) * scale;
    out(chest) = out(spine) + (at_chest - at_spine) * scale;
    const Vec3 chest_up = line.at(1) - at_chest;
    shoulders_ = out(chest) + chest_up * scale;
    chest_frame_ = frame_of(at(left_upper_arm) - at(right_upper_arm), chest_up);
    out(neck) = shoulders_ + chest_frame_(body.mid_shoulder_to_neck);
    Vec3 head_up = chest_frame_.y;
    if (has(head)) {
      const Vec3 from = has(neck) ? at(neck) : mid_shoulder_;
      head_up = normalized(at(head) - from, head_up);
    } else if (has(neck)) {
      head_up = normalized(at(neck) - mid_shoulder_, head_up);
    }
    out(head) = out(neck) + head_up * body.length[index(head)];
  }

  void build_arms() {
    const Proportions& body = kProportions;
    out(left_shoulder) = shoulders_ + chest_frame_(body.mid_shoulder_to_left_shoulder);
    out(right_shoulder) = shoulders_ + chest_frame_(body.mid_shoulder_to_right_shoulder);
    const Vec3 left = normalized(at(left_upper_arm) - mid_shoulder_, chest_frame_.x);
    const Vec3 right = normalized(at(right_upper_arm) - mid_shoulder_, -chest_frame_.x);
    out(left_upper_arm) = shoulders_ + left * body.half_shoulders;
    out(right_upper_arm) = shoulders_ + right * body.half_shoulders;
    for (HumanJoint joint : {left_lower_arm, left_hand}) extend(joint, chest_frame_.x);
    for (HumanJoint joint : {right_lower_arm, right_hand}) extend(joint, -chest_frame_.x);
  }

  void build_legs(const std::array<Vec3, 2>& toes) {
    const Proportions& body = kProportions;
    const Vec3 left = normalized(at(left_upper_leg) - mid_hip_, Vec3{1, 0, 0});
    const Vec3 right = normalized(at(right_upper_leg) - mid_hip_, Vec3{-1, 0, 0});
    out(left_upper_leg) = mid_hip_ + left * body.half_hips;
    out(right_upper_leg) = mid_hip_ + right * body.half_hips;
    for (HumanJoint joint : {left_lower_leg, left_foot, right_lower_leg, right_foot}) {
      extend(joint, kDown);
    }
    out(left_toes) = out(left_foot) + toes[0] * body.length[index(left_toes)];
    out(right_toes) = out(right_foot) + toes[1] * body.length[index(right_toes)];
  }

  const HumanPositions& joints_;
  const BodyShape& shape_;
  Vec3 mid_hip_, mid_shoulder_;
  Vec3 shoulders_;  // The canonical mid-shoulder.
  Frame chest_frame_;
  HumanPositions out_;
};

}  // namespace

Frame frame_of(Vec3 left, Vec3 up) noexcept {
  const Vec3 x = normalized(left, {1, 0, 0});
  // If `up` is parallel to x, the world's up is used, and if that is parallel, too, +z.
  const Vec3 upright = normalized(cross(x, kUp), {0, 0, 1});
  const Vec3 z = normalized(cross(x, normalized(up)), upright);
  return {x, cross(z, x), z};
}

HumanPositions canonical_positions(const HumanPositions& joints, const BodyShape& shape,
                                   const std::array<Vec3, 2>& toes) noexcept {
  return Builder(joints, shape).build(toes);
}

std::optional<float> facing_of(const HumanPositions& joints) noexcept {
  const auto at = [&](HumanJoint joint) { return joints[index(joint)]; };
  const Vec3 left =
      (at(left_upper_leg) - at(right_upper_leg)) + (at(left_upper_arm) - at(right_upper_arm));
  const Vec3 ahead = cross(left, kUp);
  // Hips and shoulders are a third of a metre apart in sum: below 2 cm the rest is noise.
  if (!(length(ahead) > 0.02f)) return std::nullopt;
  return arc_tangent(ahead.x, ahead.z);
}

namespace {

using enum HumanJoint;

// Lengths beyond the last joints: to skull, finger tips and toe tips.
constexpr float kHeadLength = 0.20f;
constexpr float kHandLength = 0.17f;
constexpr float kToeLength = 0.06f;

// Offsets from the parent in T-pose.
HumanPositions rest_offsets() noexcept {
  const float slope = kProportions.toe_pitch;
  HumanPositions out;
  const auto at = [&](HumanJoint joint) -> Vec3& { return out[index(joint)]; };
  const auto length_of = [&](HumanJoint joint) { return kProportions.length[index(joint)]; };
  const Vec3 toes = Vec3{0, -sine(slope), cosine(slope)} * length_of(left_toes);
  at(hips) = {0, kProportions.leg - toes.y - kProportions.hips_to_mid_hip.y, 0};
  at(spine) =
      kProportions.hips_to_mid_hip + Vec3{0, kProportions.torso * kProportions.spine_fraction, 0};
  at(chest) = {0, kProportions.torso * (kProportions.chest_fraction - kProportions.spine_fraction),
               0};
  const Vec3 mid_shoulder = {0, kProportions.torso * (1 - kProportions.chest_fraction), 0};
  at(neck) = mid_shoulder + kProportions.mid_shoulder_to_neck;
  at(head) = {0, length_of(head), 0};
  at(left_shoulder) = mid_shoulder + kProportions.mid_shoulder_to_left_shoulder;
  at(left_upper_arm) =
      Vec3{kProportions.half_shoulders, 0, 0} - kProportions.mid_shoulder_to_left_shoulder;
  at(left_lower_arm) = {length_of(left_lower_arm), 0, 0};
  at(left_hand) = {length_of(left_hand), 0, 0};
  at(left_upper_leg) = kProportions.hips_to_mid_hip + Vec3{kProportions.half_hips, 0, 0};
  at(left_lower_leg) = {0, -length_of(left_lower_leg), 0};
  at(left_foot) = {0, -length_of(left_foot), 0};
  at(left_toes) = toes;
  for (int j = 0; j < kHumanJoints; ++j) {
    if (kHumanMirror[j] > j) out[kHumanMirror[j]] = {-out[j].x, out[j].y, out[j].z};
  }
  return out;
}

// Initialised before main(): canonical_frames() must not block.
const HumanPositions kRestOffsets = rest_offsets();

// The child that a joint points at; -1 for the ends, and for hips and chest, which point at
// several.
constexpr std::array<int, kHumanJoints> kPointsAt = {-1, 2,  -1, 4,  -1, 6,  7,  8,  -1, 10, 11,
                                                     12, -1, 14, 15, 16, -1, 18, 19, 20, -1};

Quat nearest_sign(Quat q, Quat to) { return dot(q, to) < 0 ? Quat{-q.x, -q.y, -q.z, -q.w} : q; }

Quat frame_rotation(Vec3 left, Vec3 up, Quat otherwise) {
  if (!(length(cross(left, up)) > 1e-6f)) return otherwise;
  const Frame frame = frame_of(left, up);
  return nearest_sign(from_axes(frame.x, frame.y, frame.z), otherwise);
}

}  // namespace

Skeleton canonical_skeleton() {
  Skeleton out;
  for (int j = 0; j < kHumanJoints; ++j) {
    Joint joint;
    joint.name = std::string(human_joint_name(j));
    joint.parent = kHumanParent[j];
    joint.offset = kRestOffsets[j];
    joint.can_rotate = true;
    joint.can_translate = j == index(hips);
    out.joints.push_back(std::move(joint));
  }
  const auto end = [&](HumanJoint joint, Vec3 tip) { out.joints[index(joint)].ends = {tip}; };
  end(head, {0, kHeadLength, 0});
  end(left_hand, {kHandLength, 0, 0});
  end(right_hand, {-kHandLength, 0, 0});
  end(left_toes, {0, 0, kToeLength});
  end(right_toes, {0, 0, kToeLength});
  return out;
}

void canonical_frames(const HumanPositions& positions, float facing,
                      std::array<Quat, kHumanJoints>& world) noexcept {
  const auto at = [&](HumanJoint joint) { return positions[index(joint)]; };
  for (int j = 0; j < kHumanJoints; ++j) {
    const Quat parent = j ? world[kHumanParent[j]] : rotation_y(facing);
    world[j] = parent;
    if (j == index(hips)) {
      world[j] =
          frame_rotation(at(left_upper_leg) - at(right_upper_leg), at(spine) - at(hips), parent);
    } else if (j == index(chest)) {
      const Vec3 shoulders = (at(left_upper_arm) + at(right_upper_arm)) * 0.5f;
      world[j] =
          frame_rotation(at(left_upper_arm) - at(right_upper_arm), shoulders - at(chest), parent);
    } else if (const int child = kPointsAt[j]; child >= 0) {
      const Vec3 rest = rotate(parent, normalized(kRestOffsets[child]));
      const Vec3 now = normalized(positions[child] - positions[j], rest);
      world[j] = rotation_between(rest, now) * parent;
    }
  }
}

}  // namespace panache
