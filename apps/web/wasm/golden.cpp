#include "golden.h"

#include <bit>
#include <vector>

#include "base/elementary.h"
#include "rig/canonical_body.h"
#include "style/stylizer.h"

namespace panache::web {
namespace {

constexpr int kFrames = 300;
constexpr float kFps = 60;

// Arms hang, legs and arms swing, knees bend, the body bobs and moves forward.
Clip march() {
  const Clip rest = rest_clip(canonical_skeleton());
  Clip clip;
  clip.skeleton = rest.skeleton;
  clip.frame_time = 1 / static_cast<double>(kFps);
  for (int f = 0; f < kFrames; ++f) {
    clip.append(rest.pose(0));
    const Pose pose = clip.pose(f);
    const float seconds = static_cast<float>(f) / kFps;
    const float swing = 0.5f * sine(6 * seconds);
    const auto turn = [&](HumanJoint joint, Vec3 by) {
      pose.rotations[static_cast<size_t>(index(joint))] = exp_rotation(by);
    };
    turn(HumanJoint::left_upper_leg, {swing, 0, 0});
    turn(HumanJoint::right_upper_leg, {-swing, 0, 0});
    turn(HumanJoint::left_lower_leg, {0.3f + 0.3f * cosine(6 * seconds), 0, 0});
    turn(HumanJoint::right_lower_leg, {0.3f - 0.3f * cosine(6 * seconds), 0, 0});
    turn(HumanJoint::left_upper_arm, {-swing, 0, -1.3f});
    turn(HumanJoint::right_upper_arm, {swing, 0, 1.3f});
    turn(HumanJoint::spine, {0.05f, 0.2f * swing, 0});
    pose.translations[0] =
        pose.translations[0] + Vec3{0, 0.02f * cosine(12 * seconds) - 0.05f, 1.2f * seconds};
  }
  return clip;
}

class Hash {
 public:
  void add(float number) {
    const auto bits = std::bit_cast<uint32_t>(number);
    for (int byte = 0; byte < 4; ++byte) {
      value_ = (value_ ^ (bits >> (8 * byte) & 0xff)) * 1099511628211u;
    }
  }
  void add(Quat q) { add(q.x), add(q.y), add(q.z), add(q.w); }
  void add(Vec3 v) { add(v.x), add(v.y), add(v.z); }
  uint64_t value() const { return value_; }

 private:
  uint64_t value_ = 14695981039346656037u;
};

}  // namespace

uint64_t golden_hash(std::shared_ptr<const Model> model) {
  const Clip clip = march();
  Result<Rig> rig = Rig::create(clip);
  if (!rig) return 0;
  Result<Stylizer> stylizer = Stylizer::create(model, *std::move(rig));
  if (!stylizer) return 0;
  const size_t styles = model->styles().size();
  std::vector<float> strengths(styles);
  std::vector<Quat> rotations(clip.joints());
  std::vector<Vec3> translations(clip.joints());
  Hash hash;
  for (int f = 0; f < kFrames; ++f) {
    std::fill(strengths.begin(), strengths.end(), 0.0f);
    strengths[static_cast<size_t>(f) * styles / kFrames] = 1;
    stylizer->step(clip.pose(f), strengths, clip.frame_time, {rotations, translations});
    for (const Quat q : rotations) hash.add(q);
    for (const Vec3 t : translations) hash.add(t);
  }
  return hash.value();
}

}  // namespace panache::web
