#pragma once
// The tree of the joints that deform a mesh, where a file has them in pieces. Private to the
// folder.

#include <optional>
#include <vector>

#include "clip/clip.h"

namespace panache {

struct DeformTree {
  std::vector<int> joints;   // Of the file, parents first.
  std::vector<int> parents;  // [joints]: place in `joints`, or -1.
};

// clip: a motion of the file or its rest pose, one frame at least; what moves together is seen in
// it. Nothing where the joints hang together as they are, or where they are no person's.
std::optional<DeformTree> find_deform_tree(const Clip& clip);

}  // namespace panache
