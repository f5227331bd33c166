#pragma once
// Skeletons as other makers name and build them, in the canonical body's T-pose, and motion on
// them.

#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "clip/clip.h"
#include "rig/canonical_body.h"
#include "rig/humanoid.h"

namespace panache::test {

inline HumanPositions t_pose() {
  const Skeleton body = canonical_skeleton();
  HumanPositions out;
  for (int j = 0; j < kHumanJoints; ++j) {
    out[j] = body.joints[j].offset + (j ? out[kHumanParent[j]] : Vec3{});
  }
  return out;
}

inline bool same_bits(Quat a, Quat b) { return std::memcmp(&a, &b, sizeof a) == 0; }
inline bool same_bits(Vec3 a, Vec3 b) { return std::memcmp(&a, &b, sizeof a) == 0; }

// One joint: its name, its parent's, and where it stands: `along` the way to `target` from that
// joint's canonical parent. A '*' in the names makes two joints, one for either side; `target` is
// then the left one's.
struct Line {
  std::string name, parent;
  HumanJoint target;
  float along = 1;
  int human = -1;  // The human joint that a person takes it for.
};

// Joints as in "Root, hips 0 > Hips, hips = > Belly, spine 0.3; Hips > Body, spine =chest": name,
// place, how far along where that is not 1, and after '=' what a person takes it for, which is its
// place where nothing follows. Each hangs on the one before it, or on the one named there.
inline std::vector<Line> tree(const std::string& text) {
  std::vector<Line> lines;
  std::string parent;
  for (size_t at = 0, end; at < text.size(); at = end + 1) {
    end = std::min(text.find_first_of(">;", at), text.size());
    std::string item = text.substr(at, end - at);
    item.erase(0, item.find_first_not_of(" \n"));
    item.erase(item.find_last_not_of(" \n") + 1);
    const size_t comma = item.find(", ");
    if (comma == std::string::npos) {
      parent = item;
      continue;
    }
    Line line{item.substr(0, comma), parent, HumanJoint::hips};
    std::istringstream words(item.substr(comma + 2));
    std::string word;
    words >> word;
    line.target = HumanJoint{find_human_joint(word).value()};
    while (words >> word) {
      if (word == "=") {
        line.human = index(line.target);
      } else if (word[0] == '=') {
        line.human = find_human_joint(word.substr(1)).value();
      } else {
        line.along = std::stof(word);
      }
    }
    lines.push_back(line);
    parent = end < text.size() && text[end] == '>' ? line.name : "";
  }
  return lines;
}

struct MadeUp {
  Skeleton skeleton;
  std::map<std::string, int> joint;
  std::vector<Vec3> positions;  // [joints], metres

  // One frame of T-pose.
  Clip clip() const { return rest_clip(skeleton); }
};

inline std::string with_side(std::string text, const std::string& side) {
  const size_t star = text.find('*');
  return star == std::string::npos ? text : text.replace(star, 1, side);
}

// The name of each human joint of the rig, as a person would map it, on both sides; "" where the
// rig has none.
using HumanNames = std::array<std::string, kHumanJoints>;
inline HumanNames names_of(const std::vector<Line>& lines, const std::string& left,
                           const std::string& right) {
  HumanNames out;
  for (const Line& line : lines) {
    if (line.human < 0) continue;
    out[line.human] = with_side(line.name, left);
    if (line.name.find('*') != std::string::npos) {
      out[kHumanMirror[line.human]] = with_side(line.name, right);
    }
  }
  return out;
}

inline MadeUp make_up(const std::vector<Line>& lines, const std::string& left,
                      const std::string& right) {
  const HumanPositions body = t_pose();
  MadeUp out;
  const auto add = [&](const std::string& name, const std::string& parent, int target,
                       float along) {
    const int above = kHumanParent[target];
    const Vec3 at = above < 0 ? body[target] * along : lerp(body[above], body[target], along);
    Joint joint;
    joint.name = name;
    joint.parent = parent.empty() ? -1 : out.joint.at(parent);
    joint.offset = joint.parent < 0 ? at : at - out.positions[joint.parent];
    joint.can_rotate = true;
    joint.can_translate = joint.parent < 0;
    out.joint[name] = static_cast<int>(out.positions.size());
    out.positions.push_back(at);
    out.skeleton.joints.push_back(joint);
  };
  for (const Line& line : lines) {
    const int target = index(line.target);
    if (line.name.find('*') == std::string::npos) {
      add(line.name, line.parent, target, line.along);
      continue;
    }
    add(with_side(line.name, left), with_side(line.parent, left), target, line.along);
    add(with_side(line.name, right), with_side(line.parent, right), kHumanMirror[target],
        line.along);
  }
  return out;
}

// The same clip with its joints in another order and names that say nothing. order[joint of the
// result]: joint of `clip`.
struct Anonymous {
  Clip clip;
  std::vector<int> order;
};
inline Anonymous anonymous(const Clip& clip, unsigned seed) {
  std::mt19937 random(seed);
  const size_t joints = clip.joints();
  Anonymous out{{{}, clip.frame_time, clip.frames, {}, {}}, {}};
  std::vector<int> new_index(joints, -1), waiting;
  for (size_t j = 0; j < joints; ++j) {
    if (clip.skeleton.joints[j].parent < 0) waiting.push_back(static_cast<int>(j));
  }
  while (!waiting.empty()) {
    const size_t pick = random() % waiting.size();
    const int joint = waiting[pick];
    waiting.erase(waiting.begin() + static_cast<long>(pick));
    new_index[joint] = static_cast<int>(out.order.size());
    out.order.push_back(joint);
    Joint copy = clip.skeleton.joints[joint];
    copy.name = "q" + std::to_string(random() % 100000);
    if (copy.parent >= 0) copy.parent = new_index[copy.parent];
    out.clip.skeleton.joints.push_back(copy);
    for (size_t j = 0; j < joints; ++j) {
      if (clip.skeleton.joints[j].parent == joint) waiting.push_back(static_cast<int>(j));
    }
  }
  for (int f = 0; f < clip.frames; ++f) {
    for (const int joint : out.order) {
      out.clip.rotations.push_back(clip.pose(f).rotations[joint]);
      out.clip.translations.push_back(clip.pose(f).translations[joint]);
    }
  }
  return out;
}

inline Quat random_rotation(std::mt19937& random, float largest) {
  std::uniform_real_distribution<float> any(-1, 1);
  return exp_rotation(Vec3{any(random), any(random), any(random)} * (largest / std::sqrt(3.0f)));
}

// SampledJoints of `skeleton` with every joint turned by up to `largest` radians about its rest,
// and the joints that move displaced by up to a tenth of a metre.
inline Clip random_clip(const Skeleton& skeleton, int frames, float largest, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> any(-0.1f, 0.1f);
  Clip out{skeleton, 1.0 / 30, frames, {}, {}};
  for (int f = 0; f < frames; ++f) {
    for (const Joint& joint : skeleton.joints) {
      const Quat q = joint.can_rotate ? random_rotation(random, largest) : Quat{};
      out.rotations.push_back(normalized(joint.rest * q));
      const Vec3 move = {any(random), any(random), any(random)};
      out.translations.push_back(joint.can_translate ? joint.offset + move : joint.offset);
    }
  }
  return out;
}

// The clip in other axes and units: `axes` turns its axes to the new ones.
inline Clip in_axes(Clip clip, Quat axes, float scale, Vec3 shift = {}) {
  std::vector<Joint>& joints = clip.skeleton.joints;
  for (size_t i = 0; i < clip.rotations.size(); ++i) {
    clip.translations[i] *= scale;
    if (joints[i % joints.size()].parent >= 0) continue;
    clip.rotations[i] = axes * clip.rotations[i];
    clip.translations[i] = rotate(axes, clip.translations[i]) + shift;
  }
  for (Joint& joint : joints) {
    joint.offset *= scale;
    for (Vec3& end : joint.ends) end *= scale;
  }
  return clip;
}

// The angle between two directions in degrees, exact near zero.
inline double angle_deg(Vec3 a, Vec3 b) {
  const Vec3d p = a.as<double>(), q = b.as<double>();
  return std::atan2(length(cross(p, q)), dot(p, q)) * 180 / 3.14159265358979323846;
}

}  // namespace panache::test
