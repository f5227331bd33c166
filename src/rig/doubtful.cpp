#include "rig/doubtful.h"

#include <algorithm>
#include <string>
#include <vector>

#include "rig/joint_name.h"

namespace panache {
namespace {

using enum HumanJoint;

constexpr const char* kCure =
    "; expected the joints that deform the mesh in one hierarchy, a map that says which these are, "
    "or the motion styled where its controls are";

// Blender's name for joints that carry a mesh.
bool deforms(const Skeleton& skeleton, int joint) {
  const JointName name = parse_joint_name(skeleton.joints[static_cast<size_t>(joint)].name);
  return !name.words.empty() && name.words.front() == "def";
}

std::string quoted_name(const Skeleton& skeleton, int joint) {
  return "'" + skeleton.joints[static_cast<size_t>(joint)].name + "'";
}

// From a joint up to before `end`.
std::vector<int> path_up(const Skeleton& skeleton, int joint, int end) {
  std::vector<int> path;
  for (int up = joint; up >= 0 && up != end; up = skeleton.joints[static_cast<size_t>(up)].parent) {
    path.push_back(up);
  }
  return path;
}

}  // namespace

std::optional<Error> find_doubt(const Skeleton& skeleton, const Mapping& mapping,
                                const KnownJoints& known) {
  const auto joint = [&](HumanJoint human) { return mapping.joint_of[index(human)]; };
  if (known.contains(index(hips))) return std::nullopt;
  const int arm = joint(left_upper_arm);
  if (deforms(skeleton, arm) && deforms(skeleton, joint(left_upper_leg)) &&
      !deforms(skeleton, joint(hips)) && joint(spine) >= 0 && !deforms(skeleton, joint(spine))) {
    return Error{"doubtful: hips would be " + quoted_name(skeleton, joint(hips)) +
                 ", a control, and leftUpperArm " + quoted_name(skeleton, arm) +
                 ", which deforms the mesh and does not follow it in the file" + kCure};
  }
  // A spine of at least so many joints that does not carry the arms is no neck.
  constexpr size_t kSpineJoints = 4;
  const int top = joint(head) >= 0 ? joint(head) : joint(neck);
  if (top < 0 || joint(chest) >= 0 || joint(spine) >= 0) return std::nullopt;
  const std::vector<int> torso = path_up(skeleton, top, joint(hips));
  const std::vector<int> shoulder = path_up(skeleton, arm, joint(hips));
  const bool shared = std::any_of(shoulder.begin(), shoulder.end(), [&](int up) {
    return std::find(torso.begin(), torso.end(), up) != torso.end();
  });
  if (torso.size() < kSpineJoints || shared) return std::nullopt;
  return Error{"doubtful: leftUpperArm " + quoted_name(skeleton, arm) +
               " does not hang on the spine " + quoted_name(skeleton, torso.back()) +
               ", but beside it on " + quoted_name(skeleton, joint(hips)) + kCure};
}

}  // namespace panache
