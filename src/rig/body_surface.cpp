#include "rig/body_surface.h"

#include <algorithm>
#include <cmath>

namespace panache {
namespace {

using enum HumanJoint;

// Angles of the hanging arms and the spread legs in the bind pose, radians.
constexpr float kArmsDown = 0.75f, kLegsApart = 0.16f;
// Width of the blend of limbs and head, and of legs, with the torso, metres.
constexpr float kSoftLimb = 0.045f, kSoftLeg = 0.035f;
constexpr int kGroups = 6;
enum Group { kTorso, kHead, kLeftArm, kRightArm, kLeftLeg, kRightLeg };
constexpr float kAccentEdge = 0.02f;  // Metres.

// A part of constant thickness.
constexpr std::array<float, 5> even(float radius) {
  return {radius, radius, radius, radius, radius};
}

constexpr HumanJoint on_side(HumanJoint left, int side) {
  return side == 0 ? left : static_cast<HumanJoint>(kHumanMirror[index(left)]);
}

// The smaller of two distances, with a fillet about `soft` wide where they meet.
float soft_min(float a, float b, float soft) {
  const float h = std::max(soft - std::abs(a - b), 0.0f) / soft;
  return std::min(a, b) - h * h * soft * 0.25f;
}

Vec3 scaled(Vec3 v, Vec3 by) { return {v.x * by.x, v.y * by.y, v.z * by.z}; }

// A smooth curve through the values at even steps (Catmull and Rom, ends repeated).
template <size_t kCount>
float spline(const std::array<float, kCount>& values, float t) {
  const float position = t * static_cast<float>(kCount - 1);
  const size_t i = std::min(static_cast<size_t>(position), kCount - 2);
  const float x = position - static_cast<float>(i);
  const float a = values[i > 0 ? i - 1 : 0], b = values[i], c = values[i + 1];
  const float d = values[std::min(i + 2, kCount - 1)];
  return b + 0.5f * x * (c - a + x * (2 * a - 5 * b + 4 * c - d + x * (3 * (b - c) + d - a)));
}

float ramp(float x, float edge) { return std::clamp(x / edge + 0.5f, 0.0f, 1.0f); }

}  // namespace

BindPose bind_pose(const HumanPositions& offsets) {
  BindPose out;
  for (int j = 0; j < kHumanJoints; ++j) {
    const int parent = kHumanParent[j];
    const Quat above = parent < 0 ? Quat{} : out.rotations[parent];
    out.positions[j] = parent < 0 ? offsets[j] : out.positions[parent] + rotate(above, offsets[j]);
    Quat turn;
    const Vec3 ahead = {0, 0, 1};
    if (j == index(left_upper_arm)) turn = axis_angle(ahead, -kArmsDown);
    if (j == index(right_upper_arm)) turn = axis_angle(ahead, kArmsDown);
    if (j == index(left_upper_leg)) turn = axis_angle(ahead, kLegsApart);
    if (j == index(right_upper_leg)) turn = axis_angle(ahead, -kLegsApart);
    out.rotations[j] = above * turn;
  }
  return out;
}

BodySurface::BodySurface(const HumanPositions& offsets) : bind_(bind_pose(offsets)) {
  add_torso();
  add_head();
  for (int side = 0; side < 2; ++side) {
    add_arm(offsets, side);
    add_leg(offsets, side);
  }
  low_ = high_ = bind_.positions[0];
  for (const PlacedPart& p : parts_) {
    const float r = p.reach + kSoftLimb;
    low_ = {std::min(low_.x, p.middle.x - r), std::min(low_.y, p.middle.y - r),
            std::min(low_.z, p.middle.z - r)};
    high_ = {std::max(high_.x, p.middle.x + r), std::max(high_.y, p.middle.y + r),
             std::max(high_.z, p.middle.z + r)};
  }
}

void BodySurface::add(const Part& part) {
  const int j = index(part.joint);
  const Vec3 stretch = {1 / part.squeeze.x, 1 / part.squeeze.y, 1 / part.squeeze.z};
  PlacedPart out;
  out.part = part;
  out.from = scaled(part.from, stretch);
  out.along = scaled(part.to - part.from, stretch);
  out.bow = scaled(part.bow, stretch) * 4;
  out.along_squared = dot(out.along, out.along) > 1e-8f ? dot(out.along, out.along) : 1;
  out.thinnest = std::min({part.squeeze.x, part.squeeze.y, part.squeeze.z, 1.0f});
  out.middle = bind_.positions[j] + rotate(bind_.rotations[j], (part.from + part.to) * 0.5f);
  out.reach = length(part.to - part.from) / 2 + length(part.bow) +
              *std::max_element(part.radii.begin(), part.radii.end()) * 1.1f *
                  std::max({part.squeeze.x, part.squeeze.y, part.squeeze.z});
  parts_.push_back(out);
}

// From mid-hip along the spine to the shoulders, with the width of the joints. The tubes meet end
// to end, so that they fit any length of torso.
void BodySurface::add_torso() {
  const Vec3 left_hip = bind_position(left_upper_leg), right_hip = bind_position(right_upper_leg);
  const Vec3 left_arm = bind_position(left_upper_arm), right_arm = bind_position(right_upper_arm);
  const Vec3 hip = (left_hip + right_hip) * 0.5f, top = (left_arm + right_arm) * 0.5f;
  const float half_hips = std::clamp(length(left_hip - right_hip) / 2, 0.06f, 0.14f);
  const float half_shoulders = std::clamp(length(left_arm - right_arm) / 2, 0.1f, 0.26f);
  const Vec3 low = hip + Vec3{0, 0.005f, -0.004f}, high = top + Vec3{0, -0.075f, -0.004f};
  const float pelvis = 0.056f + half_hips, rib = 0.036f + 0.64f * half_shoulders;
  Part tube{hips,
            kTorso,
            low - bind_position(hips),
            high - bind_position(hips),
            {pelvis, 0.97f * pelvis, 0.455f * (pelvis + rib), 0.985f * rib, 0.93f * rib}};
  tube.squeeze = {1, 1, 0.74f};
  tube.use = Use::shape;
  add(tube);
  // One tube moved by three joints.
  const Vec3 waist = lerp(low, high, 0.36f), ribs = lerp(low, high, 0.68f);
  const auto share = [&](HumanJoint joint, Vec3 from, Vec3 to) {
    const float radius = 0.7f * rib;
    Part part{joint, kTorso, from - bind_position(joint), to - bind_position(joint), even(radius)};
    part.use = Use::weights;
    add(part);
  };
  share(hips, hip, waist);
  share(spine, waist, ribs);
  share(chest, ribs, top);

  const Vec3 across = (left_arm - right_arm) * 0.5f;
  const Vec3 yoke = top + Vec3{0, -0.02f, -0.008f};
  const auto lump = [&](HumanJoint joint, Vec3 from, Vec3 to, float radius, float soft) {
    add(joint, kTorso, from - bind_position(joint), to - bind_position(joint), even(radius), soft);
  };
  lump(chest, yoke - across * 0.66f, yoke + across * 0.66f, 0.062f, 0.06f);
  for (const float side : {-1.0f, 1.0f}) {
    const Vec3 breast = lerp(ribs, top, 0.42f) + across * (side * 0.38f) + Vec3{0, 0, 0.026f};
    lump(chest, breast, breast + across * (side * 0.16f), 0.062f, 0.07f);
    const Vec3 seat = hip + Vec3{side * 0.6f * half_hips, -0.02f, -0.04f};
    lump(hips, seat, seat + Vec3{0, 0.02f, 0}, 0.073f, 0.05f);
  }
}

// A neck, a skull and a face, on the existing joints.
void BodySurface::add_head() {
  const Vec3 top = (bind_position(left_upper_arm) + bind_position(right_upper_arm)) * 0.5f;
  // A missing neck or head coincides with the joint above.
  Vec3 base = bind_position(neck), skull = bind_position(head);
  if (!(skull.y > top.y + 0.02f)) skull = top + Vec3{0, 0.125f, 0.015f};
  if (!(base.y > top.y - 0.08f) || length(skull - base) < 0.02f) base = lerp(top, skull, 0.3f);
  const Vec3 n = bind_position(neck), h = skull - bind_position(head);
  add(chest, kHead, base + Vec3{0, -0.07f, -0.014f} - bind_position(chest),
      base - bind_position(chest), {0.085f, 0.078f, 0.069f, 0.061f, 0.056f});
  add(neck, kHead, base - n, skull + Vec3{0, 0.03f, 0.002f} - n,
      {0.056f, 0.053f, 0.051f, 0.05f, 0.05f}, 0.012f);
  add(head, kHead, h + Vec3{0, 0.113f, -0.004f}, h + Vec3{0, 0.113f, -0.004f}, even(0.096f), 0.035f,
      {}, {0.84f, 1.02f, 1});
  add(head, kHead, h + Vec3{0, 0.09f, 0.022f}, h + Vec3{0, 0.034f, 0.04f},
      {0.079f, 0.078f, 0.073f, 0.065f, 0.053f}, 0.04f, {0, 0, 0.004f}, {0.93f, 1, 1});
  add(head, kHead, h + Vec3{0, 0.1f, 0.086f}, h + Vec3{0, 0.074f, 0.097f},
      {0.008f, 0.009f, 0.01f, 0.011f, 0.0115f}, 0.024f);
}

// Along +x for the left, -x for the right; palms down, thumbs ahead.
void BodySurface::add_arm(const HumanPositions& offsets, int side) {
  const float out = side == 0 ? 1.0f : -1.0f;
  const HumanJoint shoulder = on_side(left_shoulder, side), upper = on_side(left_upper_arm, side);
  const HumanJoint lower = on_side(left_lower_arm, side), hand = on_side(left_hand, side);
  const int group = side == 0 ? kLeftArm : kRightArm;
  const float long_upper = length(offsets[index(lower)]);
  const float long_lower = length(offsets[index(hand)]);
  const float thick = std::clamp((long_upper + long_lower) / 0.47f, 0.75f, 1.15f);
  const float size = std::clamp(long_lower / 0.22f, 0.7f, 1.25f);
  hand_size_[side] = size;
  const auto along = [&](float x, float y, float z) { return Vec3{out * x, y, z}; };
  const auto times = [](Radii radii, float by) {
    for (float& radius : radii) radius *= by;
    return radii;
  };

  const Vec3 reach = offsets[index(upper)];
  if (length(reach) > 1e-4f) {
    add(shoulder, kTorso, reach * 0.3f, reach * 0.8f, even(0.056f), 0.06f);
  }
  add(upper, group, along(0.002f, 0, 0), along(long_upper, 0, 0),
      times({0.057f, 0.051f, 0.0455f, 0.042f, 0.0375f}, thick), 0.004f, {0, 0, 0.004f});
  add(lower, group, along(0, 0, 0), along(long_lower, 0, 0),
      times({0.036f, 0.042f, 0.0385f, 0.0305f, 0.025f}, thick), 0.008f);

  const auto finger = [&](Vec3 from, Vec3 to, const Radii& radii, float soft, Vec3 squeeze) {
    Part part{hand, group, from * size, to * size, times(radii, size), soft};
    part.bow = Vec3{0, 0.006f * size, 0};
    part.squeeze = squeeze;
    add(part);
  };
  const Vec3 flat = {1, 0.58f, 1};
  finger(along(0.004f, 0, 0), along(0.08f, -0.004f, 0), {0.029f, 0.035f, 0.042f, 0.045f, 0.044f},
         0.012f, flat);
  finger(along(0.078f, -0.004f, 0), along(0.158f, -0.03f, 0),
         {0.044f, 0.042f, 0.038f, 0.034f, 0.027f}, 0.006f, flat);
  finger(along(0.022f, -0.006f, 0.02f), along(0.088f, -0.022f, 0.062f),
         {0.019f, 0.0185f, 0.017f, 0.015f, 0.013f}, 0.016f, {1, 1, 1});
}

// Down along -y; feet ahead along +z.
void BodySurface::add_leg(const HumanPositions& offsets, int side) {
  const HumanJoint upper = on_side(left_upper_leg, side), lower = on_side(left_lower_leg, side);
  const HumanJoint foot = on_side(left_foot, side), toes = on_side(left_toes, side);
  const int group = side == 0 ? kLeftLeg : kRightLeg;
  const float out = side == 0 ? 1.0f : -1.0f;
  const float thigh = length(offsets[index(lower)]);
  const float shin = length(offsets[index(foot)]);
  const Vec3 left_hip = bind_position(left_upper_leg), right_hip = bind_position(right_upper_leg);
  // Thighs closer than their thickness would merge.
  const float room = length(left_hip - right_hip) / 2;
  const float thick = std::clamp(room * 1.02f, 0.06f, 0.087f);
  add(upper, group, {out * 0.004f, 0, 0}, {0, -thigh, 0},
      {thick, 0.95f * thick, 0.8f * thick, 0.5f * (0.8f * thick + 0.046f), 0.047f}, 0.004f,
      {0, 0, 0.008f});
  add(lower, group, {0, 0, 0}, {0, -shin, -0.004f}, {0.047f, 0.0515f, 0.0465f, 0.036f, 0.033f},
      0.008f, {0, 0, -0.01f});

  Vec3 ball = offsets[index(toes)];
  if (!(ball.z > 0.04f) || !(ball.y < -0.01f)) ball = {0, -0.068f, 0.1f};
  const float size = std::clamp(length(ball) / 0.12f, 0.75f, 1.3f);
  const float sole = ball.y;
  const auto shoe = [&](HumanJoint joint, Vec3 from, Vec3 to, const Radii& radii, float floor,
                        float width) {
    Part part{joint, group, from, to, radii, 0.02f};
    part.squeeze = {width, 0.95f, 1};
    part.sole = floor;
    add(part);
  };
  shoe(foot, {0, 0, -0.004f}, {0, sole + 0.03f, -0.038f * size},
       {0.034f, 0.036f, 0.038f, 0.038f, 0.037f}, sole, 1);
  shoe(foot, {0, 0.2f * sole, 0.004f}, {out * 0.004f, sole + 0.022f, ball.z},
       {0.035f, 0.039f, 0.041f, 0.04f, 0.038f}, sole, 1.12f);
  // In the axes of the toes, which equal those of the foot.
  shoe(toes, {out * 0.004f, 0.022f, 0}, {out * 0.004f, 0.014f, 0.052f * size},
       {0.038f, 0.038f, 0.037f, 0.035f, 0.031f}, 0, 1.2f);
}

Vec3 BodySurface::to_joint(int joint, Vec3 point) const {
  return rotate(conjugate(bind_.rotations[joint]), point - bind_.positions[joint]);
}

float BodySurface::part_distance(const PlacedPart& placed, Vec3 point) const {
  const Part& part = placed.part;
  const Vec3 local = to_joint(index(part.joint), point);
  const Vec3 p =
      Vec3{local.x / part.squeeze.x, local.y / part.squeeze.y, local.z / part.squeeze.z} -
      placed.from;
  const float t = std::clamp(dot(p, placed.along) / placed.along_squared, 0.0f, 1.0f);
  const Vec3 axis = placed.along * t + placed.bow * (t * (1 - t));
  const float tube = (length(p - axis) - spline(part.radii, t)) * placed.thinnest;
  if (part.sole < -1e2f) return tube;
  // A flat sole with a rounded edge.
  return -soft_min(-tube, local.y - part.sole, 0.012f);
}

float BodySurface::distance(Vec3 point) const {
  std::array<float, kGroups> groups;
  groups.fill(1e3f);
  for (const PlacedPart& placed : parts_) {
    if (placed.part.use == Use::weights) continue;
    float& group = groups[placed.part.group];
    // Far from a part its bounding sphere is accurate enough.
    const float ball = length(point - placed.middle) - placed.reach;
    if (ball > 0.1f || ball > group + placed.part.soft) {
      group = std::min(group, ball);
    } else {
      group = soft_min(group, part_distance(placed, point), placed.part.soft);
    }
  }
  float out = groups[0];
  for (size_t g = 1; g < kGroups; ++g) {
    out = soft_min(out, groups[g], g >= kLeftLeg ? kSoftLeg : kSoftLimb);
  }
  return out;
}

Vec3 BodySurface::approach(Vec3& point) const {
  // Gradient from four corners of a cube.
  constexpr float kStep = 0.002f;
  Vec3 slope;
  float mean = 0;
  for (const Vec3 corner : {Vec3{1, -1, -1}, Vec3{-1, -1, 1}, Vec3{-1, 1, -1}, Vec3{1, 1, 1}}) {
    const float there = distance(point + corner * kStep);
    slope += corner * there;
    mean += there / 4;
  }
  const float steepness = std::max(length(slope) / (4 * kStep), 0.3f);
  const Vec3 normal = normalized(slope, {0, 1, 0});
  point = point - normal * (mean / steepness);
  return normal;
}

void BodySurface::joint_distances(Vec3 point, std::array<float, kHumanJoints>& out) const {
  out.fill(1e3f);
  for (const PlacedPart& placed : parts_) {
    const float ball = length(point - placed.middle) - placed.reach;
    if (ball > 0.15f || placed.part.use == Use::shape) continue;
    float& nearest = out[index(placed.part.joint)];
    nearest = std::min(nearest, part_distance(placed, point));
  }
}

float BodySurface::accent(Vec3 point) const {
  float out = 0;
  for (int side = 0; side < 2; ++side) {
    const float size = hand_size_[side];
    const Vec3 hand = to_joint(index(on_side(left_hand, side)), point);
    const float beyond = (side == 0 ? hand.x : -hand.x) - 0.008f * size;
    if (length(hand) < 0.22f * size) out = std::max(out, ramp(beyond, kAccentEdge));
    const Vec3 foot = to_joint(index(on_side(left_foot, side)), point);
    const float below = -0.006f - foot.y;
    if (length(foot) < 0.3f) out = std::max(out, ramp(below, kAccentEdge));
  }
  return out;
}

}  // namespace panache
