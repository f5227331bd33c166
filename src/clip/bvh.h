#pragma once
// The BVH format (Biovision Hierarchy): a tree of joints and a table of numbers.
//
// Conventions: a joint's rotation is the product of its rotation channels in file order, R = R(c1)
// R(c2) R(c3) on column vectors, degrees. Position channels replace the OFFSET; an axis without a
// channel keeps it.
//
// The reader accepts what Blender reads, and a little more: any subset of the six channels in any
// order on any joint, any line ends, tabs, a byte order mark, exponents, names with spaces, several
// End Sites, End Sites with names, several roots, keywords in any case, and empty lines. A line is
// a frame, as in Blender; but long lines, whose surplus Blender drops, and short ones, at which it
// stops, are rejected with their position. All rows are read, whatever the announced count is;
// notes() says if it is wrong, or if the end of the file cuts the last row, which is dropped.
// encode() returns an unchanged file byte for byte, and a changed one without such faults.

#include <memory>
#include <string>

#include "base/result.h"
#include "clip/clip.h"
#include "clip/motion_file.h"

namespace panache {

// Limits that keep a file from exhausting the machine or its stack.
inline constexpr int kBvhMaxJoints = 10'000;
inline constexpr int kBvhMaxDepth = 1'000;
inline constexpr double kBvhMinFrameTime = 1e-6;  // Seconds.

// Reads a BVH file from its bytes. Error messages start with `name`, line and column (bytes, both
// from 1).
Result<std::unique_ptr<MotionFile>> parse_bvh(std::string text, const std::string& name,
                                              const ReadOptions& options = {});

// A new BVH file for a clip that came from no BVH file: positions then Z, X, Y rotations for roots
// and joints that translate, Z, X, Y rotations for all others, six decimals, joints depth first.
// Angles continue from frame to frame without wraps. The translation of a joint with can_translate
// false is its offset, whatever the poses say.
std::string format_bvh(const Clip& clip);

// Gives every leaf joint an end, at the joint itself if it has none: programs that read BVH expect
// an End Site there.
void add_end_sites(Skeleton& skeleton);

}  // namespace panache
