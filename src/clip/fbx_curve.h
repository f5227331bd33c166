#pragma once
// The curves of an FBX file: numbers as functions of time. Private to the folder.

#include <cstdint>
#include <vector>

#include "clip/fbx_tree.h"

namespace panache {

inline constexpr double kFbxSecond = 46'186'158'000;  // In FBX time units.
// 18 days, which keeps differences of times far from overflow.
inline constexpr int64_t kFbxLatest = int64_t{1} << 56;

struct FbxKey {
  // Up to the next key: its value, the next key's value, a straight line, or a Bezier curve.
  enum class Kind : uint8_t { constant, next, linear, cubic };

  int64_t time = 0;
  double value = 0;
  Kind kind = Kind::linear;
  bool is_auto = false;     // A cubic whose slopes come from the keys around it.
  bool is_clamped = false;  // Such a slope is 0 where the key is as high as one beside it.
  // Slopes (per second) at this key and at the next, and how far in time the handles reach, of the
  // time between the keys.
  float slope = 0, next_slope = 0, weight = 1.0f / 3, next_weight = 1.0f / 3;
};

struct FbxCurve {
  std::vector<FbxKey> keys;  // By time, each later than the one before.

  // Constant before the first key and behind the last; `fallback` without keys.
  double at(int64_t time, double fallback) const;
  // Whether it jumps only, and so stays a step in other keys.
  bool is_step() const;
};

// An AnimationCurve of FBX 7.
Result<FbxCurve> read_fbx_curve(const FbxTree& tree, const FbxNode& node);
// A channel of FBX 6 that has keys, or none.
Result<FbxCurve> read_fbx6_channel(const FbxTree& tree, const FbxNode& node);

}  // namespace panache
