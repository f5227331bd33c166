#pragma once
// Held-out takes as files, to be given to systems.

#include <vector>

#include "base/result.h"
#include "clip/clip.h"
#include "learn/take.h"
#include "rig/rig.h"

namespace panache {

// A take as the file it comes from.
struct TestInput {
  Clip clip;
  Rig rig;
  Take take;  // The same, canonical; numbers in layout positions.

  double take_frame(double clip_frame) const;  // The take's frame at a frame of the clip.
};

Result<TestInput> load_input(const ManifestRow& row);
// Over all cores; of a row only the path is read, and fails with the message of the first file, in
// order, that cannot be read or mapped.
Result<std::vector<TestInput>> load_inputs(const std::vector<ManifestRow>& rows);
std::vector<Take> takes_of(const std::vector<TestInput>& inputs);

}  // namespace panache
