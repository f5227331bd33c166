#pragma once
// The motions of an FBX document.

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "fbx_models.h"

namespace panache::cli {

inline constexpr double kFbxSecond = 46'186'158'000;  // In its unit of time.

struct FbxKey {
  int64_t time = 0;
  double value = 0;
  bool is_held = false;  // Up to the next key; else a straight line leads there.
};

// One number over time.
struct FbxCurve {
  bool is_there = false;
  double value = 0;          // Where there are no keys.
  std::vector<FbxKey> keys;  // In order of time, no two at the same.

  double at(int64_t time, double fallback) const;
};

// Those of translation, rotation and scale, by axis.
using FbxCurves = std::array<std::array<FbxCurve, 3>, 3>;

struct FbxTake {
  std::string name;
  std::map<size_t, FbxCurves> curves;  // By the index of the model.
  int64_t begin = 0, end = 0;          // Of the first key and of the last.
};

// Those that have keys, of FBX 6 (`Takes`) or 7 (`AnimationStack`, of which the first layer that
// moves a property counts).
Result<std::vector<FbxTake>> fbx_takes(const FbxDocument& document,
                                       const std::vector<FbxModel>& models);

// When a pose of a model is to be taken so that straight lines between the poses say what its
// curves do in the file's frames: at all keys, and at every frame between keys that differ. Where
// keys are beside the frames, the rate is not that of the motion, and only keys more than a
// twentieth of a second apart have frames between them.
std::vector<int64_t> fbx_pose_times(const FbxTake& take, const FbxCurves& curves, double rate);

// Where the model is then; `rest` has what no curve changes.
FbxPlace fbx_place(const FbxCurves& curves, const FbxPlace& rest, int64_t time);

}  // namespace panache::cli
