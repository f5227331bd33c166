#pragma once
// A whole clip restyled as the page shows it, and clips as files.

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "character.h"
#include "clip/clip.h"

namespace panache::web {

struct RestyledClip {
  Clip clip;                          // At the input's rate.
  std::vector<double> source_frames;  // Per frame of it, the input's frame (fractional).
};

// As panache::restyle with strengths that stay, and with a shape.
Result<RestyledClip> restyle_clip(const Clip& clip, const Rig& rig,
                                  std::shared_ptr<const Model> model,
                                  std::span<const float> strengths, const Shape& shape);

// The bytes of a new file: BVH for ".bvh", else GLB.
std::string format_clip(const Clip& clip, const Rig& rig, const std::string& ending);

}  // namespace panache::web
