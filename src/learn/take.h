#pragma once
// Takes: motion retargeted to the canonical body at one rate, for pairing and learning; and how
// far a styled pose is from a real one.

#include <array>
#include <string>
#include <vector>

#include "base/quat.h"
#include "clip/clip.h"
#include "pose/contacts.h"
#include "pose/features.h"
#include "pose/style_delta.h"
#include "rig/rig.h"

namespace panache {

inline constexpr double kTakeRate = 30;  // Frames a second of all takes, whatever the file's rate.

// What a take shows; of takes for training, the row of a manifest.
struct ManifestRow {
  std::string path;     // On disk: relative paths start at the manifest's folder.
  std::string style;    // After renaming; the neutral style is always "neutral".
  std::string content;  // "walk", "raise-left-hand", ...
  std::string take;
  bool neutral = false;
  bool test = false;          // Held out: never used for training.
  int set = 0;                // A performer of a manifest: styles are compared within a set.
  std::string manifest = {};  // The file of the manifest,
  int line = 0;               // the line in it, for messages,
  std::string person = {};    // and the performer; "" where the manifest names none.
};

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

// Fills `numbers` of a take in this layout.
void write_numbers(PoseLayout layout, Take& take);

struct PoseError {
  double degrees = 0;  // Mean over joints of the angle between local rotations.
  double cm = 0;       // Mean over joints of the distance on the canonical body, body frame.
};

// The remaining distance between the neutral take at frame `at`, with `change` on it, and frame
// `frame` of the styled take. Both takes are of one character; root motion is not compared.
PoseError pose_error(const Take& styled, int frame, const Take& neutral, float at,
                     const StyleDelta& change);

}  // namespace panache
