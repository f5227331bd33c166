#pragma once
// The motions of an FBX document.

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "fbx_models.h"

namespace panache::cli {

inline constexpr double kFbxSecond = 46'186'158'000;  // In FBX time units.

struct FbxKey {
  int64_t time = 0;
  double value = 0;
  bool is_held = false;  // Constant up to the next key; else linear.
};

// One animated number.
struct FbxCurve {
  bool is_there = false;
  double value = 0;          // Used if there are no keys.
  std::vector<FbxKey> keys;  // Sorted by time, without duplicates.

  double at(int64_t time, double fallback) const;
};

// The curves of translation, rotation and scale, by axis.
using FbxCurves = std::array<std::array<FbxCurve, 3>, 3>;

struct FbxTake {
  std::string name;
  std::map<size_t, FbxCurves> curves;  // By model index.
  int64_t begin = 0, end = 0;          // Times of the first and last keys.
};

// The takes with keys, from FBX 6 (`Takes`) or 7 (`AnimationStack`; for each property only the
// first layer that animates it is used).
Result<std::vector<FbxTake>> fbx_takes(const FbxDocument& document,
                                       const std::vector<FbxModel>& models);

// When to sample a model's pose so that linear interpolation reproduces its curves at the file's
// frames: at all keys, and at every frame between keys that differ. Keys that lie off the frames
// show that the rate is not the motion's; then only keys more than 1/20 s apart get frames in
// between.
std::vector<int64_t> fbx_pose_times(const FbxTake& take, const FbxCurves& curves, double rate);

// The model's transform at `time`; `rest` supplies what no curve animates.
FbxPlace fbx_place(const FbxCurves& curves, const FbxPlace& rest, int64_t time);

}  // namespace panache::cli
