#pragma once
// The formats that the program reads and writes, and motions brought from one to another.

#include <span>
#include <string>

#include <CLI/CLI.hpp>

#include "base/result.h"
#include "clip/meshopt.h"
#include "clip/motion_format.h"
#include "rig/rig.h"

namespace panache::cli {

// Those of the library, and those that only the program reads.
std::span<const MotionFormat> formats();

// Of packed data of glTF files; null in a build without meshoptimizer.
extern const MeshoptDecoder kMeshoptDecoder;

// Whether a file with the extension `input` keeps its format where it is written with the extension
// `output`, and with it all that is in it beside motion. Those of glTF count as one: an FBX file is
// a GLB by then.
bool keeps_format(const std::string& input, const std::string& output);

// What a file gave that keeps its format, in the container that the output's extension asks for. A
// GLB of joints alone gets a figure, `rig` as the user says where its humanoid is.
Result<std::string> in_container(std::string bytes, const std::string& input,
                                 const std::string& output, const RigOptions& rig, bool no_body);
// Whether the bytes of a file with this extension are not all of it, or none that are handed on:
// MotionFile::encode gives those.
bool must_be_encoded(const std::string& extension);

// The formats that motion of another format can be written in: "bvh, glb or vrma".
std::string list_writable_names();
// Whether a motion can be written with this extension.
bool has_writer(const std::string& extension);

// Rejects an output with an extension that its input cannot be written with.
Result<void> check_format(const std::string& input, const std::string& output);

// Rejects several motions where the output's format holds a single one.
Result<void> check_fits(const MotionFile& file, std::span<const int> clips,
                        const std::string& input, const std::string& output);

Placement placement_of(const Rig& rig);
// Of a skeleton that is no humanoid; what is not given is metres and +Y.
Placement placement_of(const RigOptions& options);

// Whether files with this extension hold one motion.
bool holds_one_motion(const std::string& extension);

// Whether files with this extension hold the motion of humanoids and nothing else.
bool holds_humanoids(const std::string& extension);

// A new file of this motion alone, with an extension that has a writer. Formats that hold
// humanoids get the motion on a body of their own; `rig` may be null for others.
Result<std::string> format_clip(const Clip& clip, const Rig* rig, const std::string& name,
                                const Placement& placement, const std::string& extension,
                                bool no_body);

}  // namespace panache::cli
