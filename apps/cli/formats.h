#pragma once
// The formats that the program reads and writes, and conversion between them.

#include <span>
#include <string>

#include <CLI/CLI.hpp>

#include "base/result.h"
#include "clip/gltf.h"
#include "clip/motion_format.h"
#include "rig/rig.h"

namespace panache::cli {

// The library's formats and those that only the program reads.
std::span<const MotionFormat> formats();

// Decodes packed data in glTF files; null in a build without meshoptimizer.
extern const MeshoptDecoder kMeshoptDecoder;

// Whether a file with extension `input` keeps its format, and so all its content besides motion, if
// written with extension `output`. All glTF extensions count as one format. GLB holds what is in
// FBX, too (becomes_glb()).
bool keeps_format(const std::string& input, const std::string& output);

// Puts the bytes of a file that keeps its format into the container for the output's extension. A
// GLB with joints only gets a figure; `rig` helps to find its humanoid.
Result<std::string> in_container(std::string bytes, const std::string& input,
                                 const std::string& output, const RigOptions& rig, bool no_body);
// Whether a file with this extension has to be written by MotionFile::encode, because its bytes are
// incomplete or not an output format.
bool must_be_encoded(const std::string& extension);

// The formats that any motion can be converted to: "bvh, glb or vrma".
std::string list_writable_names();
// Whether a motion can be written with this extension.
bool has_writer(const std::string& extension);

// Whether an output shows the meshes of an FBX file, which only Assimp reads.
bool becomes_glb(const std::string& input, const std::string& output);
// An FBX file as the GLB that Assimp makes of it.
Result<std::unique_ptr<MotionFile>> read_fbx_as_glb(const std::string& path,
                                                    const ReadOptions& options);

// Rejects an output whose extension the input cannot be converted to.
Result<void> check_format(const std::string& input, const std::string& output);

// Rejects several motions if the output's format holds only one.
Result<void> check_fits(const MotionFile& file, std::span<const int> clips,
                        const std::string& input, const std::string& output);

Placement placement_of(const Rig& rig);
// For a non-humanoid skeleton; defaults to metres and +Y.
Placement placement_of(const RigOptions& options);

// Whether files with this extension hold only one motion.
bool holds_one_motion(const std::string& extension);

// Whether files with this extension hold humanoid motion only.
bool holds_humanoids(const std::string& extension);

// A new file with this motion alone, for an extension that has a writer. Humanoid formats get the
// motion retargeted to their own body; `rig` may be null for other formats.
Result<std::string> format_clip(const Clip& clip, const Rig* rig, const std::string& name,
                                const Placement& placement, const std::string& extension,
                                bool no_body);

}  // namespace panache::cli
