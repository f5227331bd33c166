#include "rig/calibration.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "rig/joint_tree.h"

namespace panache {
namespace {

bool is_rest(const Clip& clip, int frame) {
  const ConstPose pose = clip.pose(frame);
  for (size_t j = 0; j < clip.joints(); ++j) {
    const Joint& joint = clip.skeleton.joints[j];
    // The root's rotation is not part of the pose.
    if (joint.parent < 0) continue;
    if (length((conjugate(joint.rest) * pose.rotations[j]).xyz()) > 1e-6f) return false;
  }
  return true;
}

float size_of(ConstPose world) {
  Vec3 low = world.translations[0], high = low;
  for (Vec3 p : world.translations) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  return length(high - low);
}

// How far the root, and the joint that moves most against the root, go between two frames.
struct Step {
  float root = 0, pose = 0;
};
Step step_between(ConstPose a, ConstPose b) {
  const Vec3 root = b.translations[0] - a.translations[0];
  Step out{length(root), 0};
  for (size_t j = 1; j < a.translations.size(); ++j) {
    out.pose = std::max(out.pose, length(b.translations[j] - a.translations[j] - root));
  }
  return out;
}

}  // namespace

int find_first_frame(const Clip& clip, std::vector<std::string>& notes) {
  const bool rests = clip.frames >= 2 && is_rest(clip, 0) && !is_rest(clip, 1);
  constexpr int kLooked = 41;
  std::vector<int> all(clip.joints());
  std::iota(all.begin(), all.end(), 0);
  const SampledJoints frames(clip, 0, std::min(clip.frames, kLooked), 1, all);
  if (frames.count() < 3) return 0;
  std::vector<float> roots, poses;
  for (int i = 1; i + 1 < frames.count(); ++i) {
    const Step step = step_between(frames.world(i), frames.world(i + 1));
    roots.push_back(step.root);
    poses.push_back(step.pose);
  }
  const Step first = step_between(frames.world(0), frames.world(1));
  const float size = size_of(frames.world(0));
  // The next step distinguishes a jump into the motion from a fast start. A rest pose alone is no
  // proof, as joints rest at the start of many motions, but then a smaller jump suffices.
  const float share = rests ? 0.02f : 0.1f, times = rests ? 3.0f : 8.0f;
  const auto jumps = [&](float step, const std::vector<float>& others) {
    return step > share * size && step > times * quantile(others, 0.5f) + 1e-6f * size &&
           step > 1.5f * others.front();
  };
  if (!jumps(first.pose, poses) && !jumps(first.root, roots)) return 0;
  const float jump = std::max(first.pose, first.root) / size;
  notes.push_back(rests ? "the first frame is the rest pose and is skipped"
                        : "the first frame jumps by " + std::to_string(std::lround(100 * jump)) +
                              " % of the body and is skipped");
  return 1;
}

}  // namespace panache
