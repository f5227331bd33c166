#pragma once
// A motion file as the verbs take it: opened, its motions picked, its rig found.

#include <memory>
#include <string>
#include <vector>

#include "base/result.h"
#include "clip/motion_format.h"
#include "rig/rig.h"

namespace panache::cli {

// Whether the program reads files with this extension.
bool is_motion_extension(const std::string& extension);
// ".bvh, .glb, ...", for messages and help.
std::string motion_extensions();

// Reads a motion file of any kind that the program knows. An FBX file comes as the GLB that it is
// turned into.
Result<std::unique_ptr<MotionFile>> open_motion(const std::string& path);

// Which motions of a file are meant: the one called `wanted`, or all of them where that is empty.
// Never empty: a file without motion is rejected, as is a name that it does not hold. `path` stands
// in front of the message of a failure.
Result<std::vector<int>> pick_clips(const MotionFile& file, const std::string& wanted,
                                    const std::string& path);

// "'walk', 'wave'": the names, for messages.
std::string list_clips(const MotionFile& file);

// What to call a motion: its name in the file, or the file's where it has none.
std::string title_of(const std::string& clip_name, const std::string& path);

// Rig::create with `path` in front of the message of a failure.
Result<Rig> make_rig(const Clip& clip, const RigOptions& options, const std::string& path);

}  // namespace panache::cli
