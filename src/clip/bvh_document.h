#pragma once
// A BVH file in memory: its text, and the position of every part. Private to the folder.

#include <array>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "clip/clip.h"
#include "clip/euler.h"

namespace panache {

// The channels of one joint, as indices in the numbers of a frame.
struct BvhChannels {
  std::array<int, 3> position = {-1, -1, -1};  // For x, y, z; -1 without a channel.
  EulerOrder order;                            // Axes of the rotation channels, in file order.
  std::array<int, 3> rotation = {-1, -1, -1};  // For each axis in `order`.
};

struct BvhDocument {
  std::string text;  // The whole file, untouched.
  Clip clip;
  std::vector<BvhChannels> channels;  // [joints]
  int numbers = 0;                    // Numbers in a frame, above zero.
  size_t count_begin = 0;             // Where in the text the frame count is.
  size_t count_end = 0;
  bool count_fits = true;              // Whether as many rows follow as it says.
  std::vector<size_t> lines;           // [frames], where in the text each frame's line begins.
  size_t cut_row = std::string::npos;  // Where an incomplete last row begins, or npos.
  std::vector<std::string> notes;      // See MotionFile::notes().
};

// bvh_reader.cpp: parses the text.
Result<BvhDocument> read_bvh_document(std::string text, const std::string& name);
// The text with this rate in place of its frame time, valid, wrong or missing.
Result<std::string> with_bvh_rate(const std::string& text, const std::string& name, double fps);

// bvh_writer.cpp: MotionFile::encode for a BVH file. A changed file gets the right count and no cut
// row.
std::string encode_bvh(const BvhDocument& document, const Clip& changed,
                       std::span<const double> source_frames);

}  // namespace panache
