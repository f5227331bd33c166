#include "rig/canonical_body.h"

#include <algorithm>

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

}  // namespace panache
