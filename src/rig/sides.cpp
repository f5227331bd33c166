#include "rig/mapping.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "rig/joint_tree.h"

namespace panache {
namespace {

using enum HumanJoint;

constexpr int kSidePoses = 24;  // Compared poses, evenly spread.
// Mean cosines that decide: of a toe to the front that the sides imply, of the arms' axis to that
// of the legs, and of the path to the front.
constexpr float kToesBehind = -0.3f, kCrossed = -0.3f, kBackwards = -0.7f;
// Toes shorter than this share of the leg have no direction; a path shorter than one leg neither.
constexpr float kShortToe = 0.03f;
// Mean distance of the knees behind the line from hip to ankle, in leg lengths, that decides.
constexpr float kKneeBehind = 0.01f;

// What the poses show of the front, with the sides of the mapping; positive: the sides are right.
struct Evidence {
  double toes = 0, knees = 0, crossed = 0, path = 0, path_length = 0;
  int toe_count = 0, count = 0;
};

class SideFinder {
 public:
  SideFinder(const Clip& clip, const Mapping& mapping) : clip_(clip), joint_of_(mapping.joint_of) {
    const Clip rest = rest_clip(clip.skeleton);
    see(rest.pose(0));
    have_before_ = false;
    for (int i = 0; i < std::min(kSidePoses, clip.frames); ++i) {
      see(clip.pose(static_cast<int>((2 * i + 1) * int64_t{clip.frames} /
                                     (2 * std::min(kSidePoses, clip.frames)))));
    }
  }

  // Whether arms and legs have exchanged sides, [arms, legs].
  std::array<bool, 2> find() const {
    if (seen_.count == 0) return {};
    const bool crossed = seen_.crossed / seen_.count < kCrossed;
    const double knees = seen_.knees / seen_.count;
    const bool has_path = seen_.path_length > 1;
    bool legs = false;
    if (seen_.toe_count > 0) {
      legs = seen_.toes / seen_.toe_count < kToesBehind && knees < kKneeBehind;
    } else {
      legs = knees < -kKneeBehind && (!has_path || seen_.path < kBackwards * seen_.path_length);
    }
    return {legs != crossed, legs};
  }

 private:
  void see(ConstPose pose) {
    std::vector<Quat> rotations(clip_.joints());
    std::vector<Vec3> positions(clip_.joints());
    world_pose(clip_.skeleton, pose, {rotations, positions});
    const auto at = [&](HumanJoint joint) { return positions[joint_of_[index(joint)]]; };
    for (const int j : joint_of_) {
      if (j >= 0 && !is_finite(positions[j])) return;
    }
    const Vec3 across = normalized(at(left_upper_leg) - at(right_upper_leg));
    const Vec3 up =
        (at(left_upper_arm) + at(right_upper_arm)) - (at(left_upper_leg) + at(right_upper_leg));
    const Vec3 front = normalized(cross(across, up));
    const float leg = length(at(left_upper_leg) - at(left_lower_leg)) +
                      length(at(left_lower_leg) - at(left_foot));
    if (front == Vec3{} || !(leg > 0)) return;
    ++seen_.count;
    seen_.crossed += dot(normalized(at(left_upper_arm) - at(right_upper_arm)), across);
    for (const auto& [upper, lower, foot, toes] :
         {std::array{left_upper_leg, left_lower_leg, left_foot, left_toes},
          std::array{right_upper_leg, right_lower_leg, right_foot, right_toes}}) {
      seen_.knees += dot(at(lower) - (at(upper) + at(foot)) * 0.5f, front) / leg / 2;
      const Vec3 toe = toe_of(foot, toes, rotations, positions);
      if (!(length(toe) > kShortToe * leg)) continue;
      seen_.toes += dot(normalized(toe), front);
      ++seen_.toe_count;
    }
    // Against a leg that turns under a body that stands, the path is along the ground.
    const Vec3 here = (at(left_upper_leg) + at(right_upper_leg)) * 0.5f;
    if (have_before_) {
      const Vec3 step = here - before_;
      seen_.path += dot(step, front) / leg;
      seen_.path_length += length(step) / leg;
    }
    before_ = here;
    have_before_ = true;
  }

  // From the foot to its toes: a joint, or the farthest End Site.
  Vec3 toe_of(HumanJoint foot, HumanJoint toes, const std::vector<Quat>& rotations,
              const std::vector<Vec3>& positions) const {
    const int ankle = joint_of_[index(foot)], toe = joint_of_[index(toes)];
    if (toe >= 0) return positions[toe] - positions[ankle];
    Vec3 longest;
    for (const Vec3 end : clip_.skeleton.joints[ankle].ends) {
      if (length(end) > length(longest)) longest = end;
    }
    return rotate(rotations[ankle], longest);
  }

  const Clip& clip_;
  const std::array<int, kHumanJoints>& joint_of_;
  Evidence seen_;
  Vec3 before_;
  bool have_before_ = false;
};

void exchange(HumanJoint first, HumanJoint last, Mapping& mapping) {
  for (int j = index(first); j <= index(last); ++j) {
    const int other = kHumanMirror[j];
    std::swap(mapping.joint_of[j], mapping.joint_of[other]);
    std::swap(mapping.reasons[j], mapping.reasons[other]);
    std::swap(mapping.confidence[j], mapping.confidence[other]);
  }
}

}  // namespace

void take_sides_of_body(const Clip& clip, const KnownJoints& known, Mapping& mapping,
                        std::vector<std::string>& notes) {
  for (const auto& [human, joint] : known) {
    if (joint >= 0 && kHumanMirror[human] != human) return;
  }
  const auto [arms, legs] = SideFinder(clip, mapping).find();
  if (arms) exchange(left_shoulder, left_hand, mapping);
  if (legs) exchange(left_upper_leg, left_toes, mapping);
  if (!arms && !legs) return;
  const std::string limbs = !arms ? "legs" : !legs ? "arms" : "arms and legs";
  notes.push_back("left and right of the " + limbs + " are those of the body, which " +
                  (arms && legs ? "faces the other way" : "the other limbs show") +
                  ": the names of the joints exchange them, or the figure is mirrored");
}

}  // namespace panache
