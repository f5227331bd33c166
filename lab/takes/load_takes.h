#pragma once
// Reads the motion of manifests.

#include <functional>
#include <string>
#include <vector>

#include "base/result.h"
#include "learn/take.h"

namespace panache {

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

// World positions of a frame of a take (Y up, metres).
HumanPositions world_positions(const Take& take, int frame);

}  // namespace panache
