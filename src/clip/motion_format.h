#pragma once
// The table of formats of motion files. A further one is its sources and a line in the table.

#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "base/quat.h"
#include "base/result.h"
#include "clip/motion_file.h"
#include "clip/skinned_body.h"

namespace panache {

// How a clip stands in a world of metres with +Y up.
struct Placement {
  float metres_per_unit = 1;
  Quat y_up;
};

struct MotionFormat {
  std::string_view extension;  // Lower case, with the point.

  // Reads a file from its bytes. `path` stands in front of the message of a failure and is where
  // files beside it are looked for.
  Result<std::unique_ptr<MotionFile>> (*parse)(std::string bytes, const std::string& path,
                                               const ReadOptions& options) = nullptr;
  // Instead of `parse`, where it is not this process that may read the bytes.
  Result<std::unique_ptr<MotionFile>> (*read)(const std::string& path,
                                              const ReadOptions& options) = nullptr;

  // A new file of one motion alone, called `name` where the format has names, shown on `body` (may
  // be null) where it has meshes; none where such files are only written as they were read.
  std::string (*write)(const Clip& clip, const std::string& name, const Placement& placement,
                       const SkinnedBody* body) = nullptr;
  bool has_meshes = false;
  bool in_metres = false;  // `write` makes metres with +Y up, so it needs a placement.

  // Of what MotionFile::encode gives.
  std::string_view encoded_as;
  // A format that also holds all that such a file holds beside motion; none but its own where
  // empty.
  std::string_view fits_into = {};
  bool one_motion = false;  // Holds one, whose place an edit takes in any mode.
  bool in_one_file = true;  // Else it points to others, which are inside of what encode() gives.
};

// The formats that the library reads.
std::span<const MotionFormat> motion_formats() noexcept;

// Those that read_motion(path) knows from here on, for a program that reads more of them; manifests
// may name such files then. Called before any thread reads; `formats` outlive everything.
void set_motion_formats(std::span<const MotionFormat> formats);
// The library's own, or what was set.
std::span<const MotionFormat> known_motion_formats();

// The extension of a file's name in lower case, with its point: ".bvh"; empty where it has none.
std::string extension_of(const std::string& path);

// The format with this extension, or nothing.
const MotionFormat* find_format(std::span<const MotionFormat> formats, std::string_view extension);

// ".bvh, .glb, ...", for messages and help.
std::string list_extensions(std::span<const MotionFormat> formats);

// Reads the motion file at `path`, whose extension decides which of the formats it has.
Result<std::unique_ptr<MotionFile>> read_motion(const std::string& path,
                                                std::span<const MotionFormat> formats,
                                                const ReadOptions& options = {});

// The same from the bytes of a file of the library's formats.
Result<std::unique_ptr<MotionFile>> parse_motion(std::string bytes, const std::string& path,
                                                 const ReadOptions& options = {});

}  // namespace panache
