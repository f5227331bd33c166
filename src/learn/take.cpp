#include "learn/take.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "learn/samples.h"
#include "pose/observer.h"
#include "style/stages/shaping.h"

namespace panache {

// Root motion is measured over one window spacing, as in live use.
void write_numbers(PoseLayout layout, Take& take) {
  const int count = pose_feature_count(layout), frames = take.frames();
  take.pose_features.resize(size_t(frames) * count);
  const double back = kWindowSpacing * kTakeRate;
  for (int f = 0; f < frames; ++f) {
    const std::span<float> numbers(&take.pose_features[size_t(f) * count], count);
    write_pose_features(layout, take.body[f], numbers.first(count - kRootFeatures));
    const double before = std::max(0.0, f - back);
    const int a = static_cast<int>(before), b = std::min(a + 1, frames - 1);
    const float t = static_cast<float>(before - a);
    const RootPose root = interpolate(take.root[a], take.root[b], t);
    write_root_features(root, take.root[f], kWindowSpacing, numbers.last<kRootFeatures>());
  }
}

Take make_take(const Clip& clip, const Rig& rig, PoseLayout layout) {
  Take take;
  PosedRig reader(rig);
  const double step = 1 / (kTakeRate * clip.frame_time);  // File frames per frame of the take.
  const int frames = 1 + static_cast<int>((clip.frames - 1 - rig.first_frame()) / step + 1e-6);
  std::vector<Quat> rotations(clip.joints());
  std::vector<Vec3> translations(clip.joints());
  std::vector<HumanPositions> world(frames);
  Observation now;
  for (int f = 0; f < frames; ++f) {
    // Rates that are 30 up to the file's precision (0.0333333) are not resampled.
    double at = rig.first_frame() + f * step;
    if (std::abs(at - std::round(at)) < 0.02) at = std::round(at);
    sample(clip, at, {rotations, translations});
    observe(reader, {rotations, translations}, now.root.facing, now);
    take.root.push_back(now.root);
    take.body.push_back(now.body_frame);
    const Quat to_heading = rotation_y(-now.world.facing);
    take.rotations.emplace_back();
    for (int j = 0; j < kHumanJoints; ++j) {
      const Quat rotation = reader.world_rotation(j);
      take.rotations.back()[j] = to_heading * (is_finite(rotation) ? rotation : Quat{});
    }
    world[f] = now.world.positions;
  }
  take.contacts = detect_contacts(world, kTakeRate);
  write_numbers(layout, take);
  return take;
}

namespace {

double degrees_between(Quat a, Quat b) {
  return length(log_rotation(conjugate(a) * b)) * 180 / std::numbers::pi;
}

}  // namespace

PoseError pose_error(const Take& styled, int frame, const Take& neutral, float at,
                     const StyleDelta& change) {
  // The true change t maps the neutral rotations n to the styled ones, s = t n; so the model
  // reaches c n = c t^-1 s.
  const StyleDelta truth = change_between(styled, frame, neutral, at, 1);
  const std::array<Quat, kHumanJoints>& real = styled.rotations[frame];
  std::array<Quat, kHumanJoints> reached;
  for (int j = 0; j < kHumanJoints; ++j) {
    reached[j] = joint_rotation(change, j) * conjugate(joint_rotation(truth, j)) * real[j];
  }
  const HumanPositions body = change_body(body_at(neutral, at), change);
  PoseError error;
  for (int j = 0; j < kHumanJoints; ++j) {
    const int parent = kHumanParent[j];
    error.degrees += parent < 0 ? degrees_between(reached[j], real[j])
                                : degrees_between(conjugate(reached[parent]) * reached[j],
                                                  conjugate(real[parent]) * real[j]);
    error.cm += 100 * length(body[j] - styled.body[frame][j]);
  }
  error.degrees /= kHumanJoints;
  error.cm /= kHumanJoints;
  return error;
}

}  // namespace panache
