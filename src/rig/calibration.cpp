#include "rig/calibration.h"

#include <algorithm>
#include <cmath>

#include "clip/clip.h"
#include "rig/figures.h"
#include "rig/joint_tree.h"

namespace panache {
namespace {

using enum HumanJoint;

constexpr int kMaxFrames = 2000;
// A toe joint or End Site nearer to the ankle than this does not show the foot's direction, metres.
constexpr float kShortestToe = 0.03f;
// Nor does one straight below the ankle: its direction's mean y in stance would be near -1.
constexpr float kSteepestToe = -0.95f;
// A foot counts as standing in this share of the frames, its lowest.
constexpr float kStanceShare = 0.3f;
// The floor is at this quantile of the lower toe's height, but at least its third lowest frame: a
// single frame outside the motion does not set it.
constexpr float kFloorShare = 0.02f;
constexpr float kFloorFrames = 2;

// A body stands if the cosine of the angle between its axis and up is at least the first value; the
// second is the required share of the frames.
constexpr float kUpright = 0.9f;
constexpr double kUprightShare = 0.05;

// The axis nearest to `v`.
int main_axis(Vec3 v) {
  int k = 0;
  for (const int i : {1, 2}) {
    if (std::abs(v[i]) > std::abs(v[k])) k = i;
  }
  return k;
}

class Calibrator {
 public:
  Calibrator(const Clip& clip, const Mapping& mapping, Calibration& out)
      : clip_(clip),
        joint_of_(mapping.joint_of),
        out_(out),
        frames_(clip, out.first_frame, clip.frames, step(clip), joint_of_),
        rest_(rest_clip(clip.skeleton)) {
    for (int j = 0; j < kHumanJoints; ++j) out_.shape.has[j] = joint_of_[j] >= 0;
    world_pose(clip.skeleton, rest_.pose(0), rest_.pose(0));
  }

  Result<void> run() {
    if (frames_.count() == 0) return Error{"no frame of the motion has finite numbers only"};
    if (out_.up_axis.empty()) find_up();
    if (out_.scale == 0) {
      if (const auto done = find_scale(); !done) return done;
    }
    for (const int side : {0, 1}) find_wrist(side);
    for (const int side : {0, 1}) find_hand(side);
    for (const int side : {0, 1}) find_toes(side);
    find_torso();
    find_facing();
    find_floor();
    return {};
  }

 private:
  static int step(const Clip& clip) { return (clip.frames + kMaxFrames - 1) / kMaxFrames; }
  bool has(HumanJoint joint) const { return out_.shape.has[index(joint)]; }
  Vec3 file(int frame, HumanJoint joint) const {
    return frames_.world(frame).translations[index(joint)];
  }
  // The frames hold one joint per human joint, in their order.
  MappedJoints mapped(int frame) const {
    std::array<int, kHumanJoints> of;
    for (int j = 0; j < kHumanJoints; ++j) of[j] = out_.shape.has[j] ? j : -1;
    return mapped_joints(frames_.world(frame), of, out_);
  }

  // The body's axis in an upright rest pose, if it also stands along it in some of the frames: a
  // clip of a body that mostly lies shows it getting up. Otherwise the axis with the largest mean
  // height of the head above the feet.
  void find_up() {
    const HumanJoint top = has(head) ? head : has(neck) ? neck : left_upper_arm;
    std::vector<Vec3> directions;
    Vec3d sum;
    for (int f = 0; f < frames_.count(); ++f) {
      directions.push_back(file(f, top) - (file(f, left_foot) + file(f, right_foot)) * 0.5f);
      sum += directions.back().as<double>();
    }
    const auto at_rest = [&](HumanJoint joint) {
      return rest_.translations[joint_of_[index(joint)]];
    };
    const Vec3 rest = at_rest(top) - (at_rest(left_foot) + at_rest(right_foot)) * 0.5f;
    const int k = main_axis(rest);
    const auto upright = std::count_if(directions.begin(), directions.end(), [&](Vec3 direction) {
      return direction[k] * std::copysign(1.0f, rest[k]) > kUpright * length(direction);
    });
    const Vec3 mean = (sum / double(directions.size())).as<float>();
    const Vec3 up = upright >= kUprightShare * directions.size() ? rest : mean;
    out_.up_axis = {up[main_axis(up)] < 0 ? '-' : '+', "XYZ"[main_axis(up)]};
    out_.y_up = *turn_up(out_.up_axis);
    if (out_.up_axis != "+Y") out_.notes.push_back("up is " + out_.up_axis);
  }

  Result<void> find_scale() {
    std::vector<float> legs;
    for (int f = 0; f < frames_.count(); ++f) legs.push_back(both_legs(f));
    float leg = legs.front();
    const auto middle = legs.begin() + legs.size() / 2;
    std::nth_element(legs.begin(), middle, legs.end());
    // If a body grows at the beginning or shrinks at the end, its size at rest counts; if that is
    // none of its sizes, the usual one.
    constexpr float kStays = 0.01f;
    if (std::abs(leg - *middle) > kStays * *middle) {
      const float rest = legs_at_rest();
      const auto [min, max] = std::minmax_element(legs.begin(), legs.end());
      leg = rest > (1 - kStays) * *min && rest < (1 + kStays) * *max ? rest : *middle;
    }
    out_.scale = 2 * kProportions.leg / leg;
    if (!std::isfinite(out_.scale)) return Error{"the legs of the humanoid have no length"};
    return {};
  }
  float both_legs(int frame) const {
    return both_legs([&](HumanJoint joint) { return file(frame, joint); });
  }
  float legs_at_rest() const {
    return both_legs([&](HumanJoint joint) { return rest_.translations[joint_of_[index(joint)]]; });
  }
  template <class At>
  float both_legs(At at) const {
    float leg = 0;
    for (auto [upper, lower, foot] : {std::array{left_upper_leg, left_lower_leg, left_foot},
                                      std::array{right_upper_leg, right_lower_leg, right_foot}}) {
      leg += length(at(upper) - at(lower)) + length(at(lower) - at(foot));
    }
    return leg;
  }

  // Sets the position of one wrist without a hand: at the End Site of the lower arm, else straight
  // on from the upper arm as at rest.
  void find_wrist(int side) {
    if (has(side ? right_hand : left_hand)) return;
    const int lower = index(side ? right_lower_arm : left_lower_arm);
    const Joint& joint = clip_.skeleton.joints[joint_of_[lower]];
    Vec3& wrist = out_.wrists[side];
    for (Vec3 end : joint.ends) {
      if (length(end) > length(wrist)) wrist = end;
    }
    const bool shown = length(wrist) * out_.scale > kShortestToe;
    if (!shown) {
      const Vec3 along = normalized(rotate(conjugate(joint.rest), joint.offset), {0, -1, 0});
      wrist = along * (kProportions.length[lower + 1] / out_.scale);
    }
    out_.notes.push_back(std::string(side ? "the right" : "the left") + " wrist is " +
                         (shown ? "the lower arm's End Site" : "estimated from the upper arm"));
  }

  // Sets the direction of one hand: in the rest pose, to its farthest joint or End Site.
  void find_hand(int side) {
    const int hand = joint_of_[index(side ? right_hand : left_hand)];
    if (hand < 0) return;
    const Vec3 wrist = rest_.translations[hand];
    Vec3 longest;
    const auto note = [&](Vec3 tip) {
      if (length(tip - wrist) > length(longest)) longest = tip - wrist;
    };
    std::vector<bool> below(clip_.joints());
    below[hand] = true;
    for (size_t j = hand; j < clip_.joints(); ++j) {
      const Joint& joint = clip_.skeleton.joints[j];
      below[j] = below[j] || (joint.parent >= 0 && below[joint.parent]);
      if (!below[j]) continue;
      note(rest_.translations[j]);
      for (Vec3 end : joint.ends) note(rest_.translations[j] + rotate(rest_.rotations[j], end));
    }
    if (!(length(longest) * out_.scale > kShortestToe)) return;
    out_.hands[side] = normalized(rotate(conjugate(rest_.rotations[hand]), longest));
  }

  // Sets the direction of one foot: from its toe joint, its End Site, or estimate_toe().
  void find_toes(int side) {
    const HumanJoint foot = side ? right_foot : left_foot, toe = side ? right_toes : left_toes;
    ToeSource& out = out_.toes[side];
    find_stance(foot);
    const Vec3 estimate = estimate_toe(foot);
    out = {has(toe) && mean_distance(foot, toe) > kShortestToe, estimate};
    if (out.from_joint && says_direction(side)) return;
    Vec3 longest;
    for (Vec3 end : clip_.skeleton.joints[joint_of_[index(foot)]].ends) {
      if (length(end) > length(longest)) longest = end;
    }
    if (length(longest) * out_.scale > kShortestToe) {
      out = {false, normalized(longest)};
      if (says_direction(side)) return note_toe(side, "taken from the End Site");
    }
    out = {false, estimate};
    note_toe(side, "estimated from the standing foot");
  }
  // Metres, mean over the frames.
  double mean_distance(HumanJoint a, HumanJoint b) const {
    double sum = 0;
    for (int f = 0; f < frames_.count(); ++f) sum += length(file(f, a) - file(f, b));
    return sum / frames_.count() * out_.scale;
  }
  void note_toe(int side, const std::string& source) {
    out_.notes.push_back(
        (side ? "the right foot's direction is " : "the left foot's direction is ") + source);
  }
  // The frames in which the foot is lowest.
  void find_stance(HumanJoint foot) {
    std::vector<float> heights(frames_.count());
    for (int f = 0; f < frames_.count(); ++f) heights[f] = rotate(out_.y_up, file(f, foot)).y;
    const float low = quantile(heights, kStanceShare);
    stance_.clear();
    for (int f = 0; f < frames_.count(); ++f) {
      if (heights[f] <= low) stance_.push_back(f);
    }
  }
  bool says_direction(int side) const {
    double y = 0;
    for (int f : stance_) y += mapped(f).toes[side].y;
    return y / stance_.size() > kSteepestToe;
  }
  // A standing foot points where the body faces, down by the canonical slope: on average over the
  // frames in which it is lowest, or more exactly in the rest pose, if the body stands in it and
  // the frames roughly agree.
  Vec3 estimate_toe(HumanJoint foot) const {
    const float slope = kProportions.toe_pitch;
    const Vec3 sloping = {0, -sine(slope), cosine(slope)};
    const auto local_in = [&](ConstPose world, int joint, Vec3 direction) {
      return rotate(conjugate(out_.y_up * world.rotations[joint]), direction);
    };
    const auto local = [&](int f, Vec3 direction) {
      return local_in(frames_.world(f), index(foot), direction);
    };
    Vec3d sum;
    for (int f : stance_) {
      const std::optional<float> facing = facing_of(mapped(f).positions);
      if (facing) sum += local(f, rotate(rotation_y(*facing), sloping)).as<double>();
    }
    const Vec3 mean = normalized(sum.as<float>(), local(0, sloping));
    const std::optional<float> facing = standing_at_rest();
    if (!facing) return mean;
    const Vec3 at_rest =
        local_in(rest_.pose(0), joint_of_[index(foot)], rotate(rotation_y(*facing), sloping));
    return dot(at_rest, mean) > 0.5f ? at_rest : mean;
  }

  // The heading in the rest pose, if the body stands upright there on straight legs.
  std::optional<float> standing_at_rest() const {
    constexpr float kStraight = 0.96f;  // Within 16 degrees.
    const MappedJoints joints = mapped_joints(rest_.pose(0), joint_of_, out_);
    const auto at = [&](HumanJoint joint) { return joints.positions[index(joint)]; };
    const auto is_upright = [&](Vec3 v) { return normalized(v).y > kStraight; };
    const Vec3 torso =
        (at(left_upper_arm) + at(right_upper_arm)) - (at(left_upper_leg) + at(right_upper_leg));
    if (!is_upright(torso) || !is_upright(at(left_upper_leg) - at(left_lower_leg)) ||
        !is_upright(at(left_lower_leg) - at(left_foot)) ||
        !is_upright(at(right_upper_leg) - at(right_lower_leg)) ||
        !is_upright(at(right_lower_leg) - at(right_foot))) {
      return std::nullopt;
    }
    return facing_of(joints.positions);
  }

  void find_torso() {
    if (!has(chest)) return;
    double apart = 0;
    for (int f = 0; f < frames_.count(); ++f) {
      const Vec3 middle = (file(f, left_upper_arm) + file(f, right_upper_arm)) * 0.5f;
      apart += length(file(f, chest) - middle);
    }
    out_.shape.chest_at_shoulders = apart / frames_.count() * out_.scale < 0.02;
  }

  void find_facing() {
    for (int f = 0; f < frames_.count(); ++f) {
      const std::optional<float> facing = facing_of(mapped(f).positions);
      if (!facing) continue;
      out_.facing = *facing;
      return;
    }
  }

  void find_floor() {
    std::vector<float> legs, heights;
    for (int f = 0; f < frames_.count(); ++f) legs.push_back(both_legs(f));
    // A body that grows stands nowhere yet.
    constexpr float kWhole = 0.9f;
    const float whole = kWhole * quantile(legs, kWhole);
    for (int f = 0; f < frames_.count(); ++f) {
      if (legs[f] < whole) continue;
      const MappedJoints joints = mapped(f);
      const HumanPositions body = canonical_positions(joints.positions, out_.shape, joints.toes);
      heights.push_back(std::min(body[index(left_toes)].y, body[index(right_toes)].y));
    }
    const float last = static_cast<float>(heights.size() - 1);
    const float share = last > 0 ? std::min(kFloorFrames / last, 0.5f) : 0.0f;
    out_.floor = quantile(heights, std::max(kFloorShare, share));
  }

  const Clip& clip_;
  const std::array<int, kHumanJoints>& joint_of_;
  Calibration& out_;
  SampledJoints frames_;
  std::vector<int> stance_;
  Clip rest_;  // The skeleton at rest, its joints in the world.
};

}  // namespace

Result<void> check_units(std::optional<float> metres_per_unit,
                         const std::optional<std::string>& up_axis) {
  if (metres_per_unit && !(*metres_per_unit > 0 && std::isfinite(*metres_per_unit))) {
    return Error{"expected metres per unit above 0, found " + std::to_string(*metres_per_unit)};
  }
  if (up_axis && !turn_up(*up_axis)) {
    return Error{"expected an up axis from +X to -Z, found '" + *up_axis + "'"};
  }
  return {};
}

Result<Calibration> calibrate(const Clip& clip, const Mapping& mapping,
                              std::optional<float> metres_per_unit,
                              const std::optional<std::string>& up_axis) {
  if (const auto done = check_units(metres_per_unit, up_axis); !done) return done.error();
  Calibration out;
  out.scale = metres_per_unit.value_or(0);
  if (up_axis) {
    out.up_axis = *up_axis;
    out.y_up = *turn_up(*up_axis);
  }
  out.first_frame = find_first_frame(clip, out.notes);
  if (const auto done = Calibrator(clip, mapping, out).run(); !done) return done.error();
  return out;
}

MappedJoints mapped_joints(ConstPose world, const std::array<int, kHumanJoints>& joint_of,
                           const Calibration& calibration) noexcept {
  MappedJoints out;
  for (int j = 0; j < kHumanJoints; ++j) {
    Vec3 at;
    if (joint_of[j] >= 0) {
      at = world.translations[joint_of[j]];
    } else if (j == index(left_hand) || j == index(right_hand)) {
      const int lower = joint_of[kHumanParent[j]];
      at = world.translations[lower] +
           rotate(world.rotations[lower], calibration.wrists[j == index(right_hand)]);
    } else {
      out.positions[j] = out.positions[kHumanParent[j]];
      continue;
    }
    const Vec3 p = rotate(calibration.y_up, at * calibration.scale);
    out.positions[j] = {p.x, p.y - calibration.floor, p.z};
  }
  for (int side : {0, 1}) {
    const int foot = index(side ? right_foot : left_foot);
    const ToeSource& toe = calibration.toes[side];
    const Quat turned = calibration.y_up * world.rotations[joint_of[foot]];
    const Vec3 local = rotate(turned, toe.local);
    out.toes[side] =
        toe.from_joint ? normalized(out.positions[foot + 1] - out.positions[foot], local) : local;
    if (joint_of[foot + 1] < 0) {
      out.positions[foot + 1] = out.positions[foot] + local * kProportions.length[foot + 1];
    }
  }
  return out;
}

}  // namespace panache
