#pragma once
// The times of a glTF file's animations, where they are not as they should be. Private to the
// folder.

#include <optional>
#include <string>

#include "clip/gltf_document.h"

namespace panache {

// The file with other times: no sampler of an animation that begins before 0 does so any more, all
// of them moved together; and where `fps` is given, the frames of each animation whose keys say a
// rate (GltfAnimation::has_rate) lie so many a second. `bytes` stays empty where all is as it
// should be. Old keys stay in the data, unused.
struct RetimedGltf {
  std::string bytes;
  std::vector<std::string> notes;  // Which animations began before 0, as MotionFile::notes().
};
// Fails where the new keys were too many.
bool retime_gltf(const GltfDocument& document, std::optional<double> fps, const std::string& name,
                 GltfChecker& checker, RetimedGltf& out);

}  // namespace panache
