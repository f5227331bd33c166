#pragma once
// Joints beside the body that go with it: clothes on a skeleton of their own, copies of joints that
// carry the mesh, targets. Private to the folder.

#include <array>
#include <string>
#include <vector>

#include "clip/clip.h"
#include "rig/humanoid.h"

namespace panache {

// A joint that keeps its place on another, which is not above it in the file.
struct Follower {
  int joint = 0;
  int to = 0;      // The joint that it goes with.
  int human = -1;  // The human joint whose change it gets.
};

// human_of[joints]: the human joint of each joint that a change may turn, or -1. Finds the joints
// that move rigidly with a mapped joint in the clip, or are at its position where nothing moves,
// but do not hang on it; and mapped feet that do not hang on their shins. Parents before children.
std::vector<Follower> find_followers(const Clip& clip,
                                     const std::array<int, kHumanJoints>& joint_of,
                                     const std::vector<int>& human_of);

// A note that names some of the followers and what they follow; empty if there are none.
std::string describe_followers(const Skeleton& skeleton, const std::vector<Follower>& followers);

}  // namespace panache
