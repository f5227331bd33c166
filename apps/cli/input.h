#pragma once
// A motion file as the verbs take it: opened, its motions picked, its rig found.

#include <memory>
#include <span>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

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
Result<std::unique_ptr<MotionFile>> open_motion(const std::string& path,
                                                const ReadOptions& options = {});

// Gives `verb` --fps; `options` must outlive it.
void add_read_options(CLI::App& verb, ReadOptions& options);
// Checks what the command line says, without reading anything.
Result<void> check_read_options(const ReadOptions& options);

// Which motions of a file are meant: the one called `wanted`, or, where that is empty, all that
// move the humanoid that `rig` helps to find (rig/body_motions.h); a note in `notes` names those
// that are passed over. Never empty: a file without such motion is rejected, as is a name that it
// does not hold, or holds for another kind of motion. `path` stands in front of the message of a
// failure.
Result<std::vector<int>> pick_clips(const MotionFile& file, const std::string& wanted,
                                    const RigOptions& rig, const std::string& path,
                                    std::vector<std::string>& notes);

// Whether the steps of a motion say that its rate is wrong (pose/step_rate.h): adds that to
// `notes`.
void note_rate(const Clip& clip, const Rig& rig, const std::string& path,
               std::vector<std::string>& notes);

// Each as a message on stderr.
void print_notes(const std::vector<std::string>& notes);

// "'walk', 'wave'": the names of these motions, for messages.
std::string list_clips(const MotionFile& file, std::span<const int> clips);

// What to call a motion: its name in the file, or the file's where it has none.
std::string title_of(const std::string& clip_name, const std::string& path);

// Rig::create with `path` in front of the message of a failure.
Result<Rig> make_rig(const Clip& clip, const RigOptions& options, const std::string& path);

}  // namespace panache::cli
