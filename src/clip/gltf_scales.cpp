#include "clip/gltf_scales.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "clip/text_cursor.h"

namespace panache {
namespace {

// Keys within this only repeat the node's scale, rounded by exporters.
constexpr double kSame = 1e-4;

Vec3d vec_at(std::span<const float> v) { return Vec3{v[0], v[1], v[2]}.as<double>(); }

bool is_same(double a, double b) { return std::abs(a - b) <= kSame * std::abs(b); }
bool is_same(Vec3d a, Vec3d b) {
  return is_same(a.x, b.x) && is_same(a.y, b.y) && is_same(a.z, b.z);
}

bool is_idle(const GltfTrack& track, Vec3d scale) {
  for (size_t k = 0; k < track.times.size(); ++k) {
    if (!is_same(vec_at(track.key(k)), scale)) return false;
  }
  // A spline leaves its keys.
  return track.interpolation != GltfTrack::Interpolation::cubic || track.times.size() == 1;
}

// The channels of an animation that rotate or move each joint, and their values at a time.
class JointTracks {
 public:
  JointTracks(const GltfDocument& document, const GltfAnimation& animation,
              std::span<const GltfTrack> tracks)
      : document_(document),
        tracks_(tracks),
        turning_(document.joint_nodes.size(), -1),
        moving_(document.joint_nodes.size(), -1) {
    for (size_t c = 0; c < tracks.size(); ++c) {
      const GltfChannel& channel = animation.channels[c];
      if (channel.path != GltfPath::rotation && channel.path != GltfPath::translation) continue;
      const int joint = document.nodes[channel.node].joint;
      if (joint < 0) continue;
      (channel.path == GltfPath::rotation ? turning_ : moving_)[joint] = static_cast<int>(c);
    }
  }

  int moving_channel(size_t joint) const { return moving_[joint]; }

  Quat rotation(size_t joint, double seconds, double tolerance) const {
    const Quat rest = node_of(joint).rotation;
    float q[4] = {rest.x, rest.y, rest.z, rest.w};
    evaluate(turning_[joint], seconds, tolerance, q);
    return {q[0], q[1], q[2], q[3]};
  }
  Vec3 translation(size_t joint, double seconds, double tolerance) const {
    const Vec3 rest = node_of(joint).translation;
    float t[3] = {rest.x, rest.y, rest.z};
    evaluate(moving_[joint], seconds, tolerance, t);
    return {t[0], t[1], t[2]};
  }

 private:
  const GltfNode& node_of(size_t joint) const {
    return document_.nodes[document_.joint_nodes[joint]];
  }
  void evaluate(int channel, double seconds, double tolerance, std::span<float> out) const {
    if (channel >= 0) tracks_[channel].evaluate(seconds, tolerance, out);
  }

  const GltfDocument& document_;
  std::span<const GltfTrack> tracks_;
  std::vector<int> turning_, moving_;  // [joints] channel, or -1.
};

}  // namespace

bool is_within_reach(Vec3 position) {
  return std::ranges::all_of(std::array{position.x, position.y, position.z},
                             [](float x) { return std::abs(x) <= kLargestNumber; });
}

GltfScales::GltfScales(const GltfDocument& document, const GltfAnimation& animation,
                       std::span<const GltfTrack> tracks)
    : document_(document) {
  for (size_t c = 0; c < tracks.size(); ++c) {
    const GltfChannel& channel = animation.channels[c];
    if (channel.path != GltfPath::scale) continue;
    const GltfNode& node = document.nodes[channel.node];
    const bool carries = std::any_of(node.children.begin(), node.children.end(),
                                     [&](int child) { return document.nodes[child].joint >= 0; });
    if (node.joint < 0 || !carries || is_idle(tracks[c], node.scale)) continue;
    tracks_.push_back({node.joint, &tracks[c]});
  }
}

void GltfScales::set_time(double seconds, double tolerance) {
  const size_t joints = document_.joint_nodes.size();
  if (own_.empty()) {
    for (const int node : document_.joint_nodes) {
      own_.push_back(document_.nodes[node].own);
    }
    above_.resize(joints);
  }
  for (const Moving& moving : tracks_) {
    const GltfNode& node = document_.nodes[document_.joint_nodes[moving.joint]];
    float v[3];
    moving.track->evaluate(seconds, tolerance, v);
    const NodeScale now = split_scale(vec_at(v));
    // A body that is scaled away keeps its size at rest.
    const bool gone = vec_at(v) == Vec3d{} || !now.stretch.can_undo();
    own_[moving.joint] = gone || is_same(vec_at(v), node.scale) ? node.own : now;
  }
}

void GltfScales::set_above(size_t joint, std::span<const Quat> rotations) {
  const int parent = document_.skeleton.joints[joint].parent;
  if (parent < 0) return;
  above_[joint] = above_[parent].below(rotations[parent], own_[parent].stretch);
}

void GltfScales::set_file_pose(double seconds, double tolerance, std::span<Quat> rotations) {
  set_time(seconds, tolerance);
  for (size_t j = 0; j < rotations.size(); ++j) {
    rotations[j] = clip_rotation(rotations[j], own_[j].turn);
    set_above(j, rotations);
  }
}

void GltfScales::set_clip_pose(double seconds, double tolerance, std::span<const Quat> rotations) {
  set_time(seconds, tolerance);
  for (size_t j = 0; j < rotations.size(); ++j) set_above(j, rotations);
}

int fill_clip(const GltfDocument& document, GltfAnimation& animation,
              std::span<const GltfTrack> tracks, GltfScales& scales) {
  const JointTracks joints(document, animation, tracks);
  Clip& clip = animation.clip;
  for (int f = 0; f < clip.frames; ++f) {
    const double seconds = animation.start + f * clip.frame_time;
    const double tolerance = key_tolerance(seconds, clip.frame_time);
    const Pose pose = clip.pose(f);
    for (size_t j = 0; j < clip.joints(); ++j) {
      pose.rotations[j] = joints.rotation(j, seconds, tolerance);
    }
    scales.set_file_pose(seconds, tolerance, pose.rotations);
    for (size_t j = 0; j < clip.joints(); ++j) {
      pose.translations[j] = scales.above(j).apply(joints.translation(j, seconds, tolerance));
      if (!is_within_reach(pose.translations[j])) return std::max(joints.moving_channel(j), 0);
    }
  }
  for (Joint& joint : clip.skeleton.joints) joint.unkeyed = true;
  for (const GltfChannel& channel : animation.channels) {
    const bool moves_joint =
        channel.path == GltfPath::rotation || channel.path == GltfPath::translation;
    if (!moves_joint || channel.node < 0) continue;
    const int joint = document.nodes[channel.node].joint;
    if (joint >= 0) clip.skeleton.joints[joint].unkeyed = false;
  }
  for (size_t j = 0; j < clip.joints(); ++j) {
    Joint& joint = clip.skeleton.joints[j];
    joint.can_translate =
        joint.can_translate || joints.moving_channel(j) >= 0 || leaves_rest_position(clip, j);
  }
  return -1;
}

}  // namespace panache
