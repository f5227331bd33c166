#pragma once
// NumPy archives (.npz), which are zip files, and the motion of body models in them.

#include <memory>
#include <string>

#include "base/result.h"
#include "clip/clip.h"
#include "clip/motion_format.h"

namespace panache::cli {

// Reads SMPL, SMPL-H or SMPL-X motion (clip/smpl.h) from the bytes of an archive, stored or
// compressed, at most 1 GB unpacked. A build without libzip always fails with a message.
Result<std::unique_ptr<MotionFile>> parse_npz(std::string bytes, const std::string& path,
                                              const ReadOptions& options = {});

// A new archive, stored as by numpy.savez, with a motion of smpl_body(). Deterministic. Null in a
// build without libzip.
extern std::string (*const kWriteNpz)(const Clip& clip, const std::string& name,
                                      const Placement& placement, const SkinnedBody* body);

}  // namespace panache::cli
