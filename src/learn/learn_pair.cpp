#include "learn/learn_style.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "clip/text_cursor.h"
#include "learn/pairing.h"
#include "retarget/retarget.h"
#include "rig/canonical_body.h"

namespace panache {
namespace {

// Anything shorter teaches nothing: the ends of a warped window are dropped.
constexpr int kMinFrames = 15;
// Larger differences make two rest poses different.
constexpr double kSameRest = 5;  // Degrees.

Result<Take> take_of(const LearnClip& from) {
  if (from.clip.frames == 1) return make_take(from.clip, from.rig, PoseLayout::positions);
  const double seconds = (from.clip.frames - from.rig.first_frame()) * from.clip.frame_time;
  // Files round the frame time: half a frame less counts as the same.
  if (seconds * kTakeRate < kMinFrames - 0.5) {
    return Error{from.name + ": has " + with_decimals(std::max(0.0, seconds), 2) +
                 " s of motion; a style is learnt from " +
                 with_decimals(kMinFrames / kTakeRate, 2) +
                 " s at least, better from 2 to 3 s; give a longer clip"};
  }
  return make_take(from.clip, from.rig, PoseLayout::positions);
}

// The names of each joint's ancestors and its own, from the root down. Joints above the hips have
// no path: they are often named after the file or the scene, not after a part of the body.
std::vector<std::string> joint_paths(const std::vector<Joint>& joints, const Rig& rig) {
  std::vector<bool> above(joints.size());
  for (int joint = rig.joints()[index(HumanJoint::hips)]; (joint = joints[joint].parent) >= 0;) {
    above[joint] = true;
  }
  std::vector<std::string> paths;
  paths.reserve(joints.size());
  for (size_t j = 0; j < joints.size(); ++j) {
    const int parent = joints[j].parent;
    const std::string before = parent < 0 ? "" : paths[parent];
    paths.push_back(before + (above[j] ? "\n" : "\n" + joints[j].name));
  }
  return paths;
}

// Joint indices by path; several joints of the same path are in file order.
std::map<std::string, std::vector<size_t>> joints_by_path(const std::vector<std::string>& paths) {
  std::map<std::string, std::vector<size_t>> found;
  for (size_t j = 0; j < paths.size(); ++j) found[paths[j]].push_back(j);
  return found;
}

// For each joint of the neutral skeleton, the styled one's joint with the same path.
Result<std::vector<size_t>> match_joints(const LearnClip& neutral, const LearnClip& styled) {
  const std::vector<Joint>& a = neutral.clip.skeleton.joints;
  const std::vector<Joint>& b = styled.clip.skeleton.joints;
  const std::string where = neutral.name + " and " + styled.name + ": have different skeletons (";
  const std::string cure =
      "); a pair needs the same joints of the body: leave the neutral clip out, or retarget the "
      "styled clip onto it";
  if (a.size() != b.size()) {
    return Error{
        where + std::to_string(a.size()) + " and " + std::to_string(b.size()) + " joints" + cure,
        ErrorKind::other_skeletons};
  }
  const std::vector<std::string> paths = joint_paths(a, neutral.rig);
  const auto before = joints_by_path(paths), after = joints_by_path(joint_paths(b, styled.rig));
  std::vector<size_t> matches(a.size());
  for (size_t j = 0; j < a.size(); ++j) {
    const std::vector<size_t>& same = before.at(paths[j]);
    const auto found = after.find(paths[j]);
    if (found == after.end() || found->second.size() != same.size()) {
      const auto parent = [](const std::vector<Joint>& joints, size_t joint) {
        const int above = joints[joint].parent;
        return above < 0 ? "nothing" : "'" + joints[above].name + "'";
      };
      const std::string difference =
          a[j].name == b[j].name
              ? "'" + a[j].name + "' is below " + parent(a, j) + " and " + parent(b, j)
              : "joint " + std::to_string(j + 1) + " is '" + a[j].name + "' and '" + b[j].name +
                    "'";
      return Error{where + difference + cure, ErrorKind::other_skeletons};
    }
    const auto nth = std::find(same.begin(), same.end(), j) - same.begin();
    matches[j] = found->second[nth];
  }
  return matches;
}

// The joints of the body itself, without props. The hips and joints above are excluded: files use
// them for the position of the body, not its build.
std::vector<bool> joints_below_hips(const std::vector<Joint>& joints, const Rig& rig) {
  std::vector<bool> below(joints.size());
  const int hips = rig.joints()[index(HumanJoint::hips)];
  for (int joint : rig.joints()) {
    for (; joint > hips; joint = joints[joint].parent) below[joint] = true;
  }
  return below;
}

// Whether the body's bones have the same directions at rest, so that rotations have the same
// meaning on both skeletons. A joint at its parent's position has no direction.
bool rest_alike(const LearnClip& neutral, const LearnClip& styled,
                const std::vector<size_t>& matches) {
  const std::vector<Joint>& joints = neutral.clip.skeleton.joints;
  const std::vector<bool> in_body = joints_below_hips(joints, neutral.rig);
  for (size_t j = 0; j < joints.size(); ++j) {
    const Vec3 a = joints[j].offset, b = styled.clip.skeleton.joints[matches[j]].offset;
    const float lengths = length(a) * length(b);
    if (!in_body[j] || !(lengths > 0)) continue;
    const double cosine = dot(a, b) / lengths;
    const double limit = kSameRest * std::numbers::pi / 180;
    if (std::acos(std::clamp(cosine, -1.0, 1.0)) > limit) return false;
  }
  return true;
}

// Whether both skeletons have the same human joints.
bool map_alike(const LearnClip& neutral, const LearnClip& styled) {
  for (int j = 0; j < kHumanJoints; ++j) {
    if ((neutral.rig.joints()[j] < 0) != (styled.rig.joints()[j] < 0)) return false;
  }
  return true;
}

// The take of the styled motion, retargeted to the neutral skeleton.
Result<Take> take_onto(const LearnClip& styled, const LearnClip& neutral) {
  Result<Retargeted> done = retarget(styled.clip, styled.rig, neutral.clip, neutral.rig);
  if (!done) return located(styled.name + " onto " + neutral.name, done.error());
  RigOptions as_neutral;
  as_neutral.metres_per_unit = neutral.rig.scale();
  as_neutral.up_axis = neutral.rig.up_axis();
  for (int j = 0; j < kHumanJoints; ++j) as_neutral.joint_indices[j] = neutral.rig.joints()[j];
  Result<Rig> rig = Rig::create(done->clip, as_neutral);
  if (!rig) return located(styled.name + " onto " + neutral.name, rig.error());
  return take_of({done->clip, *rig, styled.name});
}

// The canonical body standing upright, with its arms down.
Clip standing_pose() {
  constexpr float kDown = 1.35f, kBent = 0.2f;  // Radians: upper arms, elbows.
  Clip clip = rest_clip(canonical_skeleton());
  const Pose pose = clip.pose(0);
  pose.rotations[index(HumanJoint::left_upper_arm)] = axis_angle({0, 0, 1}, -kDown);
  pose.rotations[index(HumanJoint::right_upper_arm)] = axis_angle({0, 0, 1}, kDown);
  pose.rotations[index(HumanJoint::left_lower_arm)] = axis_angle({0, 1, 0}, -kBent);
  pose.rotations[index(HumanJoint::right_lower_arm)] = axis_angle({0, 1, 0}, kBent);
  return clip;
}

// Recomputes rotations from positions alone, so that they are the same for every rig.
void forget_twist(Take& take) {
  for (int f = 0; f < take.frames(); ++f) canonical_frames(take.body[f], 0, take.rotations[f]);
}

}  // namespace

Result<LearnPair> make_learn_pair(const LearnClip& neutral, const LearnClip& styled) {
  const Result<std::vector<size_t>> matches = match_joints(neutral, styled);
  if (!matches && !map_alike(neutral, styled)) return matches.error();
  Result<Take> before = take_of(neutral);
  if (!before) return before.error();
  Result<Take> after = take_of(styled);
  if (after && !(matches && rest_alike(neutral, styled, *matches))) {
    after = take_onto(styled, neutral);
  }
  if (!after) return after.error();
  const bool is_pose = neutral.clip.frames == 1;
  if (is_pose != (styled.clip.frames == 1)) {
    return Error{(is_pose ? neutral.name : styled.name) +
                 ": is a pose, and the other of the pair a motion; give two poses or two motions"};
  }
  return LearnPair{
      neutral.name,      styled.name, *std::move(before),
      *std::move(after), is_pose,     is_pose ? 0 : cycle_frames(neutral.clip, neutral.rig)};
}

Result<LearnPair> make_pose_pair(const LearnClip& styled) {
  if (styled.clip.frames != 1) {
    return Error{styled.name + ": has " + std::to_string(styled.clip.frames) +
                 " frames; expected a pose, which is one"};
  }
  Result<Take> after = take_of(styled);
  if (!after) return after.error();
  const Clip stand = standing_pose();
  Result<Rig> rig = Rig::create(stand);
  if (!rig) return rig.error();
  LearnPair pair{"standing upright", styled.name, make_take(stand, *rig, PoseLayout::positions),
                 *std::move(after), true};
  forget_twist(pair.neutral);
  forget_twist(pair.styled);
  return pair;
}

Result<LearnPair> make_learn_pair(const LearnClip& styled, const NeutralBank& bank) {
  if (styled.clip.frames == 1) return make_pose_pair(styled);
  Result<Take> after = take_of(styled);
  if (!after) return after.error();
  NeutralTwin twin = bank.twin(*after);
  LearnPair pair{"neutral people", styled.name, std::move(twin.take), *std::move(after)};
  pair.twin = twin.facts;
  forget_twist(pair.styled);
  return pair;
}

}  // namespace panache
