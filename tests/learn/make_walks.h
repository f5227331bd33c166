#pragma once
// Walks to learn styles from: the shipped walker's, and what a style does to them that is known.

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/file.h"
#include "learn/learn_style.h"
#include "walker/walker.h"

namespace panache::test {

inline TensorFile shipped_model(const std::string& name = "panache.safetensors") {
  const std::string path = PANACHE_SOURCE_DIR "/models/" + name;
  return parse_safetensors(read_file(path).value(), path).value();
}

inline std::shared_ptr<const WalkerModel> shipped_walker() {
  return WalkerModel::load(PANACHE_SOURCE_DIR "/models/walker.safetensors").value();
}

inline Clip neutral_walk(double seconds = 4, float speed = 1.4f) {
  WalkClipOptions options;
  options.seconds = seconds;
  options.fps = 30;
  options.speed = speed;
  return walk_clip(shipped_walker(), options);
}

// The walk bent forward by `bend` radians at the spine and shown `slower` times as slowly.
inline Clip bent_walk(double seconds = 4, float bend = 0.5f, double slower = 1) {
  const Clip walk = neutral_walk(seconds / slower);
  Clip out{walk.skeleton, walk.frame_time, 0, {}, {}};
  out.resize(static_cast<int>(seconds / walk.frame_time));
  for (int f = 0; f < out.frames; ++f) {
    const Pose pose = out.pose(f);
    sample(walk, f / slower, pose);
    Quat& spine = pose.rotations[index(HumanJoint::spine)];
    spine = axis_angle(Vec3{1, 0, 0}, bend) * spine;
  }
  return out;
}

inline LearnPair make_pair(const Clip& neutral, const Clip& styled) {
  const Result<Rig> a = Rig::create(neutral), b = Rig::create(styled);
  return make_learn_pair({neutral, *a, "neutral.bvh"}, {styled, *b, "styled.bvh"}).value();
}

// A style of the shipped model learnt from these pairs, which it has to be.
inline LearntStyle learn(const std::vector<LearnPair>& pairs, const std::string& name = "bent",
                         const std::string& description = "") {
  return learn_style(shipped_model(), "model.safetensors", pairs, name, description).value();
}

// How far the spine leans forward at a frame, radians.
inline float lean(const Clip& clip, int frame) {
  const Vec3 up = rotate(clip.pose(frame).rotations[index(HumanJoint::spine)], Vec3{0, 1, 0});
  return std::atan2(up.z, up.y);
}

}  // namespace panache::test
