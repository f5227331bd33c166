#pragma once
// Motion put on characters, and what is measured of it.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "pose/contacts.h"
#include "retarget/retarget.h"
#include "rig/posed_rig.h"
#include "rig/put_on.h"
#include "walker/walker.h"

namespace panache::test {

inline Clip neutral_walk(double seconds = 4) {
  WalkClipOptions options;
  options.seconds = seconds;
  options.fps = 30;
  options.turn = 0.3f;
  const std::string models = PANACHE_SOURCE_DIR "/models/";
  return walk_clip(*WalkerModel::load(models + "walker.safetensors"), options);
}

// A maker's rig at rest.
inline Clip character_of(const Maker& maker, float turn = 0, double units = 0,
                         std::optional<bool> z_up = {}) {
  const Clip one = rest_clip(canonical_skeleton());
  return rest_clip(put_on(maker, one, turn, units, z_up).clip.skeleton);
}

inline Clip put(const Clip& motion, const Clip& character, const RetargetOptions& options = {}) {
  const Result<Rig> rig = Rig::create(motion), onto = Rig::create(character);
  EXPECT_TRUE(rig.ok()) << rig.error().message;
  EXPECT_TRUE(onto.ok()) << onto.error().message;
  Result<Retargeted> out = retarget(motion, *rig, character, *onto, options);
  EXPECT_TRUE(out.ok()) << out.error().message;
  return std::move(out->clip);
}

// Poses from the rig's first frame on, by the rig of `of`, whose skeleton the clip has.
inline std::vector<BodyPose> bodies(const Clip& clip, const Rig& rig, int first) {
  PosedRig reader(rig);
  std::vector<BodyPose> out(static_cast<size_t>(clip.frames - first));
  for (int f = first; f < clip.frames; ++f) {
    reader.read(clip.pose(f), out[static_cast<size_t>(f - first)]);
  }
  return out;
}
inline std::vector<BodyPose> bodies(const Clip& clip) {
  const Rig rig = *Rig::create(clip);
  return bodies(clip, rig, rig.first_frame());
}

// Mean angle between the directions from parent to joint, all joints and frames, degrees. Without
// `toes`: how steep a flat foot is from ankle to toes is the rig's, not the motion's.
inline double mean_direction_deg(const std::vector<BodyPose>& a, const std::vector<BodyPose>& b,
                                 bool toes = true) {
  EXPECT_EQ(a.size(), b.size());
  double sum = 0;
  size_t count = 0;
  for (size_t f = 0; f < std::min(a.size(), b.size()); ++f) {
    for (int j = 1; j < kHumanJoints; ++j) {
      if (!toes && (j == index(kToes[0]) || j == index(kToes[1]))) continue;
      ++count;
      const int parent = kHumanParent[j];
      sum += angle_deg(a[f].positions[j] - a[f].positions[parent],
                       b[f].positions[j] - b[f].positions[parent]);
    }
  }
  return sum / static_cast<double>(count);
}

// Mean speed over the ground of planted toes, in lengths of a leg a second: that of the rig is
// canonical. `contacts`: [frames].
inline double slide(const std::vector<BodyPose>& bodies, const std::vector<FootContacts>& contacts,
                    double frame_time) {
  double sum = 0, count = 0;
  for (size_t f = 1; f < bodies.size(); ++f) {
    for (int foot = 0; foot < kFeet; ++foot) {
      if (!contacts[f][foot] || !contacts[f - 1][foot]) continue;
      const int toe = index(kToes[foot]);
      const Vec3 step = bodies[f].joints[toe] - bodies[f - 1].joints[toe];
      sum += std::hypot(static_cast<double>(step.x), static_cast<double>(step.z)) / frame_time;
      ++count;
    }
  }
  return count > 0 ? sum / count : 0;
}

inline std::vector<FootContacts> contacts_of(const std::vector<BodyPose>& bodies,
                                             double frame_time) {
  std::vector<HumanPositions> joints;
  for (const BodyPose& body : bodies) joints.push_back(body.joints);
  return detect_contacts(joints, 1 / frame_time);
}

inline float lowest_toe(const BodyPose& body) {
  return std::min(body.joints[index(HumanJoint::left_toes)].y,
                  body.joints[index(HumanJoint::right_toes)].y);
}

}  // namespace panache::test
