#pragma once
// A BVH file in memory: its text, and the position of everything in it. Private to the folder.

#include <array>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "clip/clip.h"
#include "clip/euler.h"

namespace panache {

// The channels of one joint, as places in the numbers of a frame.
struct BvhChannels {
  std::array<int, 3> position = {-1, -1, -1};  // Of x, y, z; -1 where there is no channel.
  EulerOrder order;                            // Axes of the rotation channels as they stand.
  std::array<int, 3> rotation = {-1, -1, -1};  // Of each axis in `order`.
};

struct BvhDocument {
  std::string text;  // The whole file, untouched.
  Clip clip;
  std::vector<BvhChannels> channels;  // [joints]
  int numbers = 0;                    // Numbers in a frame, above zero.
  size_t count_begin = 0;             // Where in the text the frame count stands.
  size_t count_end = 0;
  bool count_fits = true;              // As many rows follow as it says.
  std::vector<size_t> lines;           // [frames], where in the text each frame's line begins.
  size_t cut_row = std::string::npos;  // Where an incomplete last row begins; npos for none.
  std::vector<std::string> notes;      // As MotionFile::notes().
};

// bvh_reader.cpp: everything from the text.
Result<BvhDocument> read_bvh_document(std::string text, const std::string& name);
// The text with this rate in place of what it says of its frame time, whatever that is, or nothing.
Result<std::string> with_bvh_rate(const std::string& text, const std::string& name, double fps);

// bvh_writer.cpp: MotionFile::encode for a BVH file. What is changed gets the right count and no
// cut row.
std::string encode_bvh(const BvhDocument& document, const Clip& changed,
                       std::span<const double> source_frames);

}  // namespace panache
