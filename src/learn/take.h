#pragma once
// Takes: motion retargeted to the canonical body at one rate, for pairing and learning; and how
// far a styled pose is from a real one.

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "base/quat.h"
#include "base/result.h"
#include "clip/clip.h"
#include "learn/manifest.h"
#include "pose/contacts.h"
#include "pose/features.h"
#include "pose/style_delta.h"
#include "rig/rig.h"

namespace panache {

inline constexpr double kTakeRate = 30;  // Frames a second of all takes, whatever the file's rate.

struct Take {
  ManifestRow row;
  std::vector<HumanPositions> body;                       // [frames], body frame, metres
  std::vector<RootPose> root;                             // [frames], facing unwrapped
  std::vector<std::array<Quat, kHumanJoints>> rotations;  // [frames], world rotations in the
                                                          // heading frame; only changes between
                                                          // takes of one rig mean anything
  std::vector<FootContacts> contacts;                     // [frames]
  std::vector<float> pose_features;                       // [frames][pose_feature_count(layout)]

  int frames() const { return static_cast<int>(body.size()); }
};

// The take of a clip on a character, from its first frame of motion; its row stays empty.
Take make_take(const Clip& clip, const Rig& rig, PoseLayout layout);

// The first motion of a file that moves the humanoid, and its rig.
struct RiggedClip {
  Clip clip;
  Rig rig;
};
Result<RiggedClip> load_clip(const std::string& path);

// Reads one take.
Result<Take> load_take(const ManifestRow& row, PoseLayout layout);

// Reads all takes on all cores; `progress` gets the number done. Fails with the message of the
// first file, in order of the rows, that cannot be read.
Result<std::vector<Take>> load_takes(const std::vector<ManifestRow>& rows, PoseLayout layout,
                                     const std::function<void(int)>& progress = {});

// Fills `numbers` of a take in this layout.
void write_numbers(PoseLayout layout, Take& take);

// World positions of a frame of a take (Y up, metres).
HumanPositions world_positions(const Take& take, int frame);

struct PoseError {
  double degrees = 0;  // Mean over joints of the angle between local rotations.
  double cm = 0;       // Mean over joints of the distance on the canonical body, body frame.
};

// The remaining distance between the neutral take at frame `at`, with `change` on it, and frame
// `frame` of the styled take. Both takes are of one character; root motion is not compared.
PoseError pose_error(const Take& styled, int frame, const Take& neutral, float at,
                     const StyleDelta& change);

}  // namespace panache
