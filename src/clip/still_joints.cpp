#include "clip/still_joints.h"

#include <algorithm>
#include <cmath>

namespace panache {
namespace {

// Programs write the rest pose into every frame with floats that went through matrices. A tenth of
// a thousandth of a radian, or of the largest distance between two joints, is nothing to see.
constexpr float kRounding = 1e-4f;

}  // namespace

void mark_still_joints(Clip& clip) {
  float size = 0;
  for (const Joint& joint : clip.skeleton.joints) size = std::max(size, length(joint.offset));
  for (size_t j = 0; j < clip.joints(); ++j) {
    Joint& joint = clip.skeleton.joints[j];
    joint.still = true;
    for (int f = 0; f < clip.frames && joint.still; ++f) {
      const ConstPose pose = clip.pose(f);
      const float turn = 2 * length((conjugate(joint.rest) * pose.rotations[j]).xyz());
      const float way = length(pose.translations[j] - joint.offset);
      joint.still = turn <= kRounding && way <= kRounding * size;
    }
  }
}

}  // namespace panache
