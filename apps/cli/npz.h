#pragma once
// Archives of numpy's arrays (.npz), which are zip files, and the motion of body models in them.

#include <memory>
#include <string>

#include "base/result.h"
#include "clip/clip.h"
#include "clip/motion_format.h"

namespace panache::cli {

// Reads the motion of SMPL, SMPL-H or SMPL-X (clip/smpl.h) from the bytes of an archive, stored or
// compressed, of at most 1 GB unpacked. A build without libzip has only a message.
Result<std::unique_ptr<MotionFile>> parse_npz(std::string bytes, const std::string& path,
                                              const ReadOptions& options = {});

// A new archive, stored as numpy.savez does it, of a motion of smpl_body(). The same motion gives
// the same bytes. Null in a build without libzip.
extern std::string (*const kWriteNpz)(const Clip& clip, const std::string& name,
                                      const Placement& placement, const SkinnedBody* body);

}  // namespace panache::cli
