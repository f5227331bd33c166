#include "bench/motions.h"

#include <cmath>
#include <numbers>

#include "pose/limb.h"
#include "pose/changed_joints.h"
#include "rig/posed_rig.h"
#include "walker/walker.h"

namespace panache::bench {
namespace {

constexpr double kFps = 60;
constexpr int kFingers = 5, kFingerJoints = 3, kFaceJoints = 25, kTwists = 8;
constexpr float kClapsPerSecond = 2, kCrouchesPerSecond = 0.4f;
// Metres: of the wrists from the middle, together and apart; of the hands before the hips' middle
// and above it; and of the hips' way down.
constexpr float kTogether = 0.05f, kApart = 0.25f, kAhead = 0.3f, kUp = 0.3f, kDown = 0.4f;

Result<Clip> make_motion(const std::string& walker_model, const WalkClipOptions& options) {
  auto walker = WalkerModel::load(walker_model);
  if (!walker) return walker.error();
  return walk_clip(*walker, options);
}

int joint_of(const Clip& clip, const std::string& name) {
  int j = 0;
  while (clip.skeleton.joints[static_cast<size_t>(j)].name != name) ++j;
  return j;
}

// The clip with joints that the humanoid lacks, at rest.
Clip detailed(const Clip& clip) {
  Clip out = clip;
  std::vector<Joint>& joints = out.skeleton.joints;
  const auto add = [&](const std::string& name, int parent, Vec3 offset) {
    Joint joint;
    joint.name = name;
    joint.parent = parent;
    joint.offset = offset;
    joint.can_rotate = true;
    joints.push_back(joint);
    return static_cast<int>(joints.size()) - 1;
  };
  for (const std::string side : {"left", "right"}) {
    const float out_x = side == "left" ? 1.0f : -1.0f;
    for (int f = 0; f < kFingers; ++f) {
      int parent = joint_of(clip, side + "Hand");
      for (int i = 0; i < kFingerJoints; ++i) {
        parent = add(side + "Finger" + std::to_string(f) + std::to_string(i), parent,
                     {0.03f * out_x, 0, 0.01f * static_cast<float>(f - 2)});
      }
    }
  }
  for (int i = 0; i < kFaceJoints; ++i) {
    add("face" + std::to_string(i), joint_of(clip, "head"), {0, 0.05f, 0.08f});
  }
  const char* const limbs[] = {"leftUpperArm", "leftLowerArm", "rightUpperArm", "rightLowerArm",
                               "leftUpperLeg", "leftLowerLeg", "rightUpperLeg", "rightLowerLeg"};
  static_assert(std::size(limbs) == kTwists);
  for (const char* limb : limbs) {
    add(std::string(limb) + "Twist", joint_of(clip, limb), {0, -0.1f, 0});
  }
  out.rotations.clear(), out.translations.clear();
  const int frames = out.frames;
  out.resize(frames);
  for (int f = 0; f < frames; ++f) {
    const ConstPose from = clip.pose(f);
    const Pose to = out.pose(f);
    for (size_t j = 0; j < joints.size(); ++j) {
      const bool own = j < clip.joints();
      to.rotations[j] = own ? from.rotations[j] : Quat{};
      to.translations[j] = own ? from.translations[j] : joints[j].offset;
    }
  }
  return out;
}

// A standing body on the detailed skeleton. `move`(seconds, body, joints, change) changes each
// pose, in the heading frame.
template <class Move>
Result<Clip> make_standing(const std::string& walker_model, const Move& move) {
  WalkClipOptions options;
  options.seconds = 10;
  options.fps = kFps;
  options.speed = 0;
  const Result<Clip> stand = make_motion(walker_model, options);
  if (!stand) return stand.error();
  Clip clip = detailed(*stand);
  const Result<Rig> rig = Rig::create(clip);
  if (!rig) return rig.error();
  PosedRig posed(*rig);
  for (int f = 0; f < clip.frames; ++f) {
    BodyPose pose;
    posed.read(clip.pose(f), pose);
    const HeadingBody body = pose;
    BodyChange change;
    HumanPositions joints;
    changed_joints(body, change, joints);
    move(static_cast<float>(f / kFps), joints, change);
    posed.write(clip.pose(f), pose, change, clip.pose(f));
  }
  return clip;
}

// From 0 to 1 and back.
float wave(float seconds, float per_second) {
  return (1 - std::cos(2 * std::numbers::pi_v<float> * per_second * seconds)) / 2;
}

}  // namespace

Result<Clip> make_walk(const std::string& walker_model) {
  WalkClipOptions options;
  options.seconds = 60;
  options.fps = kFps;
  options.turn = 0.35f;
  return make_motion(walker_model, options);
}

Result<Clip> make_clap(const std::string& walker_model) {
  const auto clap = [](float seconds, HumanPositions& joints, BodyChange& change) {
    const float aside = std::lerp(kTogether, kApart, wave(seconds, kClapsPerSecond));
    for (int side = 0; side < 2; ++side) {
      reach_with_limb(arm_joints(side), {side == 0 ? aside : -aside, kUp, kAhead}, joints, change);
    }
  };
  return make_standing(walker_model, clap);
}

Result<Clip> make_crouch(const std::string& walker_model) {
  const auto crouch = [](float seconds, HumanPositions& joints, BodyChange& change) {
    const float down = kDown * wave(seconds, kCrouchesPerSecond);
    change.translation.y -= down;
    for (int side = 0; side < 2; ++side) {
      const LimbJoints leg = leg_joints(side);
      reach_with_limb(leg, joints[leg.end] + Vec3{0, down, 0}, joints, change);
    }
  };
  return make_standing(walker_model, crouch);
}

}  // namespace panache::bench
