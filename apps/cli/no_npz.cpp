// In the place of npz.cpp in a build without libzip.

#include "npz.h"

namespace panache::cli {

Result<std::unique_ptr<MotionFile>> parse_npz(std::string, const std::string& path,
                                              const ReadOptions&) {
  return Error{path + ": this build reads no .npz files; build with libzip-dev"};
}

std::string (*const kWriteNpz)(const Clip&, const std::string&, const Placement&,
                               const SkinnedBody*) = nullptr;

}  // namespace panache::cli
