#include "pose/loop.h"

#include <algorithm>
#include <vector>

#include "clip/text_cursor.h"
#include "pose/limb.h"
#include "pose/observer.h"
#include "pose/changed_joints.h"
#include "rig/humanoid.h"
#include "rig/posed_rig.h"

namespace panache {

namespace {

constexpr int kLooks = 64;  // Poses sampled for the extent.
// A shorter clip is part of a cycle.
constexpr double kShortest = 0.3;  // Seconds.
constexpr int kFewestFrames = 4;
// The poses of an authored loop differ only by rounding in the file. Metres.
constexpr float kAuthoredGap = 0.001f, kAuthoredWorst = 0.005f;
// Walks and runs of CMU that are cut after the cycle that ends nearest to where it began are 0.8 to
// 3.2 cm off in the mean of the joints and 2.5 to 9.5 at the worst one: a quarter of what any two
// poses of them are apart, and 10 to 55 ms of the motion there. Takes that begin and end at rest
// are as near, but pass the seam so slowly that they are 80 ms off or more. Of 1,375 whole takes
// six are loops: walks that happen to end as they began.
constexpr float kCutGap = 0.04f, kCutWorst = 0.15f, kCutShare = 0.25f, kCutSeconds = 0.06f;
// The largest gap that can be spread over a cycle: two poses of a walk are up to twice that far
// apart.
constexpr float kMaxGap = 0.1f;  // Metres.

bool is_long_enough(const LoopSeam& seam, double frame_time) {
  return seam.frames() >= kFewestFrames && seam.frames() * frame_time > kShortest - 1e-6;
}

}  // namespace

LoopSeam measure_seam(const Clip& clip, const Rig& rig) {
  LoopSeam seam;
  seam.last = clip.frames - 1;
  seam.first = std::min(rig.first_frame(), seam.last);
  PosedRig reader(rig);
  Observation begin, now;
  observe(reader, clip.pose(seam.first), 0, begin);
  float facing = begin.root.facing;
  const int step = std::max(1, seam.frames() / kLooks);
  for (int f = seam.first; f < seam.last; f += step) {
    observe(reader, clip.pose(f), facing, now);
    facing = now.root.facing;
    seam.extent = std::max(seam.extent, pose_distance(now.body_frame, begin.body_frame).mean);
  }
  observe(reader, clip.pose(seam.last), facing, now);
  const PoseDistance apart = pose_distance(now.body_frame, begin.body_frame);
  seam.gap = apart.mean, seam.worst = apart.largest;
  seam.extent = std::max(seam.extent, seam.gap);
  seam.begin = begin.root, seam.end = now.root;
  if (seam.frames() < 2) return seam;
  Observation second, before;
  observe(reader, clip.pose(seam.first + 1), begin.root.facing, second);
  observe(reader, clip.pose(seam.last - 1), facing, before);
  seam.first_step = pose_distance(begin.body_frame, second.body_frame).mean;
  seam.last_step = pose_distance(before.body_frame, now.body_frame).mean;
  for (size_t j = 0; j < now.body_frame.size(); ++j) {
    const Vec3 after = second.body_frame[j] - begin.body_frame[j];
    const Vec3 until = now.body_frame[j] - before.body_frame[j];
    seam.speed += length(after + until) / static_cast<float>(2 * clip.frame_time * kHumanJoints);
  }
  return seam;
}

bool is_loop(const LoopSeam& seam, double frame_time) noexcept {
  if (!is_long_enough(seam, frame_time)) return false;
  if (seam.gap <= kAuthoredGap && seam.worst <= kAuthoredWorst) return true;
  return seam.gap <= kCutGap && seam.worst <= kCutWorst && seam.gap <= kCutShare * seam.extent &&
         seam.gap <= kCutSeconds * seam.speed;
}

Result<void> check_closable(const LoopSeam& seam, double frame_time) {
  if (!is_long_enough(seam, frame_time)) {
    return Error{"the motion is not a loop: it lasts " +
                 with_decimals(seam.frames() * frame_time, 2) + " s; expected at least " +
                 with_decimals(kShortest, 1) + " s and " + std::to_string(kFewestFrames) +
                 " frames"};
  }
  if (!(seam.gap <= kMaxGap)) {
    return Error{"the motion is not a loop: its last pose is " +
                     with_decimals(100 * static_cast<double>(seam.gap), 1) +
                     " cm from its first in the mean of the joints; expected at most " +
                     with_decimals(100 * static_cast<double>(kMaxGap), 0) +
                     " cm, as where a clip is cut after a whole cycle",
                 ErrorKind::loop_open};
  }
  return {};
}

namespace {

void copy(ConstPose from, Pose to) {
  std::ranges::copy(from.rotations, to.rotations.begin());
  std::ranges::copy(from.translations, to.translations.begin());
}

Quat apart(Quat from, Quat to) { return to * conjugate(from); }

// Per frame, the share of a gap that a foot closes, counted from the middle of the cycle: while it
// is in the air or, if it never is, evenly. From the last frame to the first it is 1.
std::vector<float> swing_shares(std::span<const FootContacts> contacts, int foot) {
  std::vector<float> shares(contacts.size(), 0.0f);
  for (size_t f = 1; f < shares.size(); ++f) {
    const int stands = contacts[f - 1][foot] + contacts[f][foot];
    shares[f] = shares[f - 1] + static_cast<float>(2 - stands);
  }
  const float all = shares.back();
  for (size_t f = 1; f < shares.size(); ++f) {
    shares[f] =
        all > 0 ? shares[f] / all : static_cast<float>(f) / static_cast<float>(shares.size() - 1);
  }
  const float middle = shares[shares.size() / 2];
  for (float& share : shares) share -= middle;
  return shares;
}

class LoopCloser {
 public:
  LoopCloser(const Rig& rig, int first, std::span<const FootContacts> contacts, Clip& clip)
      : clip_(clip), first_(first), reader_(rig) {
    find_followed(rig);
    for (int foot = 0; foot < kFeet; ++foot) shares_[foot] = swing_shares(contacts, foot);
    measure_joints();
    measure_body();
  }

  void close() {
    for (int f = first_; f < clip_.frames; ++f) close_frame(f);
  }

 private:
  // What a joint of the skeleton follows.
  static constexpr int kLeftAlone = -2, kWithBody = -1;  // Or with a foot: 0, 1.
  struct Gap {
    Vec3 rotation, translation;  // Rotation vector on the right of the local rotation; file units.
  };

  void find_followed(const Rig& rig) {
    std::vector<int> human(clip_.joints(), -1);
    for (int j = 0; j < kHumanJoints; ++j) {
      if (rig.joints()[j] >= 0) human[rig.joints()[j]] = j;
    }
    for (size_t j = 0; j < clip_.joints(); ++j) {
      const int parent = clip_.skeleton.joints[j].parent;
      followed_.push_back(parent < 0 ? kLeftAlone : followed_[parent]);
      if (parent >= 0 && human[parent] == index(HumanJoint::hips)) followed_[j] = kWithBody;
      for (int foot = 0; foot < kFeet; ++foot) {
        if (human[j] == index(kAnkles[foot])) followed_[j] = foot;
      }
      if (human[j] > 0 && followed_[j] == kLeftAlone) followed_[j] = kWithBody;
    }
  }

  void measure_joints() {
    const ConstPose begin = clip_.pose(first_), end = clip_.pose(clip_.frames - 1);
    for (size_t j = 0; j < clip_.joints(); ++j) {
      gaps_.push_back({log_rotation(conjugate(end.rotations[j]) * begin.rotations[j]),
                       begin.translations[j] - end.translations[j]});
      if (begin.rotations[j] == end.rotations[j]) gaps_.back().rotation = {};
    }
  }

  // The body at `frame` with its joints moved half way, see share().
  RotatedBodyPose met(int frame) {
    std::vector<Quat> rotations(clip_.joints());
    std::vector<Vec3> translations(clip_.joints());
    const Pose pose = {rotations, translations};
    copy(clip_.pose(frame), pose);
    spread_joints(frame, pose);
    RotatedBodyPose body;
    reader_.read(pose, body);
    return body;
  }

  void measure_body() {
    const int last = clip_.frames - 1;
    const RotatedBodyPose begin = met(first_), end = met(last);
    tilt_ = log_rotation(apart(in_heading(end), in_heading(begin)));
    rise_ = mid_hip(begin).y - mid_hip(end).y;
    turn_ = rotation_y(end.facing - begin.facing);
    const Vec3 hips_target = mid_hip(end) + Vec3{0, rise_, 0};
    RotatedBodyPose from, to;
    reader_.read(clip_.pose(last), from);
    reader_.read(clip_.pose(first_), to);
    for (int foot = 0; foot < kFeet; ++foot) {
      const int ankle = index(kAnkles[foot]), toes = index(kToes[foot]);
      const Vec3 wanted = hips_target + rotate(turn_, to.joints[toes] - mid_hip(begin));
      toe_gaps_[foot] = wanted - from.joints[toes];
      foot_gaps_[foot] = log_rotation(apart(from.rotations[ankle], turn_ * to.rotations[ankle]));
    }
  }

  // The tilt of the hips.
  static Quat in_heading(const RotatedBodyPose& body) {
    return rotation_y(-body.facing) * body.rotations[index(HumanJoint::hips)];
  }

  // The share of a gap that is closed: the last frame and the first one each move half way to the
  // other. A foot moves in the air.
  float share(int followed, int frame) const {
    if (followed >= 0) return shares_[followed][frame - first_];
    return static_cast<float>(frame - first_) / static_cast<float>(clip_.frames - 1 - first_) -
           0.5f;
  }

  void spread_joints(int frame, Pose pose) const {
    for (size_t j = 0; j < gaps_.size(); ++j) {
      if (followed_[j] == kLeftAlone) continue;
      const float part = share(followed_[j], frame);
      const Gap& gap = gaps_[j];
      if (!(gap.rotation == Vec3{})) {
        pose.rotations[j] = normalized(pose.rotations[j] * exp_rotation(gap.rotation * part));
      }
      if (!(gap.translation == Vec3{})) pose.translations[j] += gap.translation * part;
    }
  }

  void close_frame(int frame) {
    const Pose pose = clip_.pose(frame);
    RotatedBodyPose before, body;
    reader_.read(pose, before);
    spread_joints(frame, pose);
    reader_.read(pose, body);
    const float part = share(kWithBody, frame);
    BodyChange change;
    change.rotations.fill(exp_rotation(tilt_ * part));
    change.translation.y = rise_ * part;
    HumanPositions joints;
    changed_joints(body, change, joints);
    for (int foot = 0; foot < kFeet; ++foot) place_foot(foot, frame, before, body, joints, change);
    reader_.write(pose, body, change, pose);
  }

  // Puts the foot back to its position before, plus its share of the gap.
  void place_foot(int foot, int frame, const RotatedBodyPose& before, const RotatedBodyPose& body,
                  HumanPositions& joints, BodyChange& change) const {
    const LimbJoints leg = leg_joints(foot);
    const int ankle = index(kAnkles[foot]), toes = index(kToes[foot]);
    const float part = share(foot, frame);
    // The gap is relative to the heading at the end; the heading at the begin differs.
    const bool begins = 2 * (frame - first_) < clip_.frames - 1 - first_;
    const Quat seen = begins ? conjugate(turn_) : Quat{};
    const Quat to_heading = rotation_y(-body.facing);
    const Vec3 origin = mid_hip(body) + change.translation;
    // Around the toes, on which a standing foot turns.
    const Quat turned = exp_rotation(rotate(seen, foot_gaps_[foot]) * part);
    const Vec3 wanted = before.joints[toes] + rotate(seen, toe_gaps_[foot]) * part +
                        rotate(turned, before.joints[ankle] - before.joints[toes]);
    const Vec3 target = rotate(to_heading, wanted - origin);
    const Vec3 ahead = knee_direction(joints[ankle], joints[toes]);
    turn_limb(leg, target, bend_of(joints[leg.root], joints[leg.middle], joints[leg.end], ahead),
              joints, change);
    change.rotations[ankle] = change.rotations[toes] =
        in_axes(to_heading, apart(body.rotations[ankle], turned * before.rotations[ankle]));
  }

  Clip& clip_;
  int first_;
  PosedRig reader_;
  std::vector<int> followed_;                     // [joints]
  std::vector<Gap> gaps_;                         // [joints]
  std::array<std::vector<float>, kFeet> shares_;  // [frames from first_ on]
  // Corrections of the hips: tilt, a rotation vector in the heading frame, and lift, metres.
  Vec3 tilt_;
  float rise_ = 0;
  Quat turn_;  // Turn of the heading from the first frame to the last.
  // Gaps of each foot, from the last frame to the first: translation of the toes, metres, and
  // rotation vector; world.
  std::array<Vec3, kFeet> toe_gaps_, foot_gaps_;
};

}  // namespace

void close_loop(const Rig& rig, int first, std::span<const FootContacts> contacts, Clip& clip) {
  LoopCloser(rig, first, contacts, clip).close();
}

float Travel::turned(int round) const noexcept {
  return static_cast<float>(round) * (end_.facing - begin_.facing);
}

Vec3 Travel::position(int round) const noexcept {
  Vec3 out = begin_.position;
  for (int r = 0; r < round; ++r) {
    out += rotate(rotation_y(turned(r)), end_.position - begin_.position);
  }
  return out;
}

Clip repeat_loop(const Clip& clip, const Rig& rig, int first, const Travel& travel, int rounds) {
  Clip out = clip;
  std::vector<Quat> rotations(clip.joints());
  std::vector<Vec3> translations(clip.joints());
  const Pose pose = {rotations, translations};
  for (int round = 1; round < rounds; ++round) {
    const Vec3 move = travel.position(round) - travel.begin().position;
    for (int f = first + 1; f < clip.frames; ++f) {
      copy(clip.pose(f), pose);
      rig.transform_root(travel.turned(round), travel.begin().position, move, pose);
      out.append(pose);
    }
  }
  return out;
}

}  // namespace panache
