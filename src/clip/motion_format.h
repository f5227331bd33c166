#pragma once
// The table of motion file formats. A new format needs its sources and a line in the table.

#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "base/quat.h"
#include "base/result.h"
#include "clip/motion_file.h"

namespace panache {

// How a clip is placed in a world of metres with +Y up.
struct Placement {
  float metres_per_unit = 1;
  Quat y_up;
};

struct MotionFormat {
  std::string_view extension;  // Lower case, with the point.

  // Reads a file from its bytes. Error messages start with `path`, whose folder is searched for
  // related files.
  Result<std::unique_ptr<MotionFile>> (*parse)(std::string bytes, const std::string& path,
                                               const ReadOptions& options) = nullptr;
  // Instead of `parse`, if this process must not read the bytes itself.
  Result<std::unique_ptr<MotionFile>> (*read)(const std::string& path,
                                              const ReadOptions& options) = nullptr;

  // Makes a new file with this motion alone, called `name` if the format has names, shown on `body`
  // (may be null) if it has meshes; null if such files are only written as they were read.
  std::string (*write)(const Clip& clip, const std::string& name, const Placement& placement,
                       const SkinnedBody* body) = nullptr;
  bool has_meshes = false;
  bool in_metres = false;  // `write` converts to metres with +Y up, so it needs a placement.

  // The format that MotionFile::encode returns.
  std::string_view encoded_as;
  // Another format that can hold everything in such a file besides motion; empty if there is none.
  std::string_view fits_into = {};
  bool one_motion = false;  // Holds a single motion, which an edit replaces in any mode.
  bool in_one_file = true;  // Otherwise it refers to other files, which encode() embeds.
};

// The formats that the library reads.
std::span<const MotionFormat> motion_formats() noexcept;

// Sets the formats for read_motion(path) and for manifests, for a program that reads more of them.
// Called before any thread reads; `formats` outlive everything.
void set_motion_formats(std::span<const MotionFormat> formats);
// The library's own, or those that were set.
std::span<const MotionFormat> known_motion_formats();

// The extension of a file name in lower case, with its point: ".bvh"; empty if there is none.
std::string extension_of(const std::string& path);

// The format with this extension, or null.
const MotionFormat* find_format(std::span<const MotionFormat> formats, std::string_view extension);

// ".bvh, .glb, ...", for messages and help.
std::string list_extensions(std::span<const MotionFormat> formats);

// Reads the motion file at `path`, whose extension determines which of the formats it has.
Result<std::unique_ptr<MotionFile>> read_motion(const std::string& path,
                                                std::span<const MotionFormat> formats,
                                                const ReadOptions& options = {});

// The same from the bytes of a file, for the library's formats.
Result<std::unique_ptr<MotionFile>> parse_motion(std::string bytes, const std::string& path,
                                                 const ReadOptions& options = {});

}  // namespace panache
