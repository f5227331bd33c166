#pragma once
// Held-out takes and their files, the input of systems.

#include <vector>

#include "base/result.h"
#include "clip/clip.h"
#include "learn/take.h"
#include "rig/rig.h"

namespace panache {

// A take and the clip that it was read from.
struct TestInput {
  Clip clip;
  Rig rig;
  Take take;  // The canonical take; features in layout positions.

  double take_frame(double clip_frame) const;  // The take's frame at a frame of the clip.
};

Result<TestInput> load_input(const ManifestRow& row);
// Loads on all cores, using only the path of a row; fails with the first file, in order, that
// cannot be read or mapped.
Result<std::vector<TestInput>> load_inputs(const std::vector<ManifestRow>& rows);
// The takes of TestInput or StyledTake.
template <class T>
std::vector<Take> takes_of(const std::vector<T>& list) {
  std::vector<Take> takes;
  takes.reserve(list.size());
  for (const T& entry : list) takes.push_back(entry.take);
  return takes;
}

}  // namespace panache
