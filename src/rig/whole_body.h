#pragma once
// Bodies without some of a person's joints: legs that end at the shin, feet that hang on the root,
// upper bodies, one leg. Private to the folder.

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "clip/clip.h"
#include "rig/joint_tree.h"

namespace panache {

struct WholeBody {
  // The clip with joints after its own that stand for the missing ones: fixed to their parents, and
  // named as the mapping expects. They are in no file. At rest feet are at their shins.
  Clip clip;
  // [joints of `clip`]: the parent that a joint has in a body: a shin for a foot on the root.
  std::vector<int> parents;
  bool lacks_legs = false;  // Neither leg is in the file.
  std::vector<std::string> notes;
};

// Nothing if no joint of a leg is missing, or too much is. `poses`: as in map_humanoid().
std::optional<WholeBody> complete_body(const Clip& clip, std::span<const JointPositions> poses);

}  // namespace panache
