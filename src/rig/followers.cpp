#include "rig/followers.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "rig/joint_name.h"
#include "rig/joint_tree.h"

namespace panache {
namespace {

using enum HumanJoint;

constexpr int kFollowPoses = 16;
// How far a joint may stray from the one that it follows, in sizes of the body and radians, and how
// much it must move against the joint that carries it in the file.
constexpr float kKeeps = 0.005f, kKeepsTurn = 0.035f;
constexpr float kMoves = 0.01f, kMovesTurn = 0.05f;

// How much a joint moves in the space of another.
struct Stray {
  float shift = 0, turn = 0;
  bool keeps() const { return shift < kKeeps && turn < kKeepsTurn; }
  bool moves() const { return shift > kMoves || turn > kMovesTurn; }
};

float angle_between(Quat a, Quat b) { return length(log_rotation(conjugate(a) * b)); }

class FollowerFinder {
 public:
  FollowerFinder(const Clip& clip, const std::array<int, kHumanJoints>& joint_of,
                 const std::vector<int>& human_of)
      : joints_(clip.skeleton.joints), joint_of_(joint_of), human_of_(human_of) {
    std::vector<int> all(joints_.size());
    std::iota(all.begin(), all.end(), 0);
    const int count = std::min(kFollowPoses, clip.frames);
    for (int i = 0; i < count; ++i) {
      const int frame = static_cast<int>((2 * i + 1) * int64_t{clip.frames} / (2 * count));
      const SampledJoints one(clip, frame, frame + 1, 1, all);
      if (one.count() > 0) frames_.push_back(one);
    }
    for (const int joint : joint_of) {
      for (int up = joint; up >= 0; up = joints_[up].parent) above_body_.push_back(up);
    }
    std::sort(above_body_.begin(), above_body_.end());
    if (!frames_.empty()) size_ = body_size();
  }

  std::vector<Follower> find() {
    std::vector<Follower> found;
    // The human joint whose change each joint gets, and a joint that has it.
    moved_by_.assign(joints_.size(), -1);
    for (size_t j = 0; j < joints_.size() && size_ > 0; ++j) {
      const int joint = static_cast<int>(j), parent = joints_[j].parent;
      const int carrier = parent < 0 ? -1 : moved_by_[parent];
      moved_by_[j] = carrier;
      if (human_of_[j] >= 0) {
        moved_by_[j] = human_of_[j];
        const bool foot = human_of_[j] == index(left_foot) || human_of_[j] == index(right_foot);
        const int shin = foot ? joint_of_[kHumanParent[human_of_[j]]] : -1;
        if (shin >= 0 && !is_above(shin, joint)) found.push_back({joint, shin, human_of_[j]});
        continue;
      }
      if (std::binary_search(above_body_.begin(), above_body_.end(), joint)) continue;
      const int human = followed_by(joint, carrier);
      if (human < 0) continue;
      found.push_back({joint, joint_of_[human], human});
      moved_by_[j] = human;
    }
    return found;
  }

 private:
  bool is_above(int above, int joint) const {
    while (joint > above) joint = joints_[joint].parent;
    return joint == above;
  }

  float body_size() const {
    const ConstPose world = frames_.front().world(0);
    const Vec3 hips_at = world.translations[joint_of_[index(hips)]];
    float size = 0;
    for (const int joint : joint_of_) {
      if (joint >= 0) size = std::max(size, length(world.translations[joint] - hips_at));
    }
    return 2 * size;
  }

  // Of `joint` in the space of `other`; -1: the world.
  Stray stray_from(int other, int joint) const {
    Stray stray;
    Vec3 first;
    Quat first_turn;
    for (size_t f = 0; f < frames_.size(); ++f) {
      const ConstPose world = frames_[f].world(0);
      const Quat axes = other < 0 ? Quat{} : conjugate(world.rotations[other]);
      const Vec3 origin = other < 0 ? Vec3{} : world.translations[other];
      const Vec3 position = rotate(axes, world.translations[joint] - origin);
      const Quat turn = axes * world.rotations[joint];
      if (f == 0) first = position, first_turn = turn;
      stray.shift = std::max(stray.shift, length(position - first) / size_);
      stray.turn = std::max(stray.turn, angle_between(first_turn, turn));
    }
    return stray;
  }
  // The largest distance of two joints, in sizes of the body.
  float apart(int a, int b) const {
    float max = 0;
    for (const SampledJoints& frame : frames_) {
      const ConstPose world = frame.world(0);
      max = std::max(max, length(world.translations[a] - world.translations[b]) / size_);
    }
    return max;
  }

  // The human joint that the joint follows instead of `carrier`; -1 if there is none.
  int followed_by(int joint, int carrier) const {
    const int carried = carrier < 0 ? -1 : joint_of_[carrier];
    const Stray now = stray_from(carried, joint);
    int best = -1;
    float min = INFINITY;
    for (int human = 0; human < kHumanJoints; ++human) {
      const int other = joint_of_[human];
      if (other < 0 || human == carrier || human_of_[other] < 0) continue;
      const float distance = apart(joint, other);
      if (!(now.moves() ? goes_with(joint, other, distance, now)
                        : rests_on(joint, other, carried, distance))) {
        continue;
      }
      if (distance < min) min = distance, best = human;
    }
    return best;
  }
  bool goes_with(int joint, int other, float distance, const Stray& now) const {
    if (stray_from(other, joint).keeps()) return true;
    // It turns by itself at the same place.
    return distance < kKeeps && now.shift > kMoves;
  }
  // At the same place while neither moves. On the body, only a copy of the joint rests on it.
  bool rests_on(int joint, int other, int carried, float distance) const {
    if (distance > kKeeps || stray_from(carried, other).moves()) return false;
    if (carried < 0) return true;
    const JointName copy = parse_joint_name(joints_[joint].name);
    const JointName name = parse_joint_name(joints_[other].name);
    return copy.side == name.side && !name.words.empty() &&
           std::all_of(name.words.begin(), name.words.end(),
                       [&](const std::string& word) { return copy.has(word); });
  }

  const std::vector<Joint>& joints_;
  const std::array<int, kHumanJoints>& joint_of_;
  const std::vector<int>& human_of_;
  std::vector<SampledJoints> frames_;  // One frame each.
  std::vector<int> above_body_;        // The mapped joints and all above, sorted.
  std::vector<int> moved_by_;
  float size_ = 0;
};

}  // namespace

std::vector<Follower> find_followers(const Clip& clip,
                                     const std::array<int, kHumanJoints>& joint_of,
                                     const std::vector<int>& human_of) {
  return FollowerFinder(clip, joint_of, human_of).find();
}

std::string describe_followers(const Skeleton& skeleton, const std::vector<Follower>& followers) {
  constexpr size_t kNamedFollowers = 4;
  std::string text;
  for (size_t i = 0; i < std::min(kNamedFollowers, followers.size()); ++i) {
    text += (i ? ", '" : "'") + skeleton.joints[followers[i].joint].name + "' follows " +
            std::string(human_joint_name(followers[i].human));
  }
  if (followers.size() > kNamedFollowers) {
    text += " and " + std::to_string(followers.size() - kNamedFollowers) + " more";
  }
  return followers.empty() ? "" : "joints beside the body go with it: " + text;
}

}  // namespace panache
