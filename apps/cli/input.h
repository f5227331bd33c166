#pragma once
// A motion file as input for the verbs: opened, its motions picked, its rig found.

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

// Reads a motion file of any known format. `output` is the name of the file that is to be made of
// it, or empty.
Result<std::unique_ptr<MotionFile>> open_motion(const std::string& path,
                                                const ReadOptions& options = {},
                                                const std::string& output = "");

// Gives `verb` --fps; `options` must outlive it.
void add_read_options(CLI::App& verb, ReadOptions& options);
// Checks what the command line says, without reading anything.
Result<void> check_read_options(const ReadOptions& options);

// Picks the motions of a file: the one called `wanted`, or, if that is empty, all that move the
// humanoid found with `rig` (rig/body_motions.h); a note in `notes` names the skipped ones. Never
// empty: rejects a file without such motions, and a name that is missing or belongs to another kind
// of motion. Failure messages begin with `path`.
Result<std::vector<int>> pick_clips(const MotionFile& file, const std::string& wanted,
                                    const RigOptions& rig, const std::string& path,
                                    std::vector<std::string>& notes);

// Adds a note to `notes` if the steps of a motion suggest that its frame rate is wrong
// (pose/step_rate.h).
void note_rate(const Clip& clip, const Rig& rig, const std::string& path,
               std::vector<std::string>& notes);

// Adds what Rig::remarks() says, once for all motions of a file.
void note_remarks(const Rig& rig, const std::string& path, std::vector<std::string>& notes);

// Prints each as a message on stderr.
void print_notes(const std::vector<std::string>& notes);

// "'walk', 'wave'": the names of these motions, for messages.
std::string list_clips(const MotionFile& file, std::span<const int> clips);

// The title of a motion: its name in the file, or the file's name if it has none.
std::string title_of(const std::string& clip_name, const std::string& path);

// Rig::create, with failure messages that begin with `path`.
Result<Rig> make_rig(const Clip& clip, const RigOptions& options, const std::string& path);

}  // namespace panache::cli
