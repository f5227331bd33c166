#pragma once
// Where new motions go: into the file that they are of, or into that of a character (--onto).

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "batch.h"
#include "clip/motion_file.h"
#include "formats.h"
#include "retarget/retarget.h"
#include "rig/rig.h"
#include "rig_options.h"

namespace panache::cli {

struct OntoFlags {
  std::string file;  // Or empty.
  std::string map;   // A JSON file for that file's joints, or empty.
};
// Gives `verb` --onto and --onto-map; `flags` must outlive it.
CLI::Option* add_onto_options(CLI::App& verb, OntoFlags& flags);

// Without a flag new motions come first in the file that they are of, and alone on a character.
struct PlaceFlags {
  bool replace = false, first = false, last = false;
};
// Gives `verb` --replace, --first and --last, of which one goes; `whose` are the motions that would
// go.
void add_place_options(CLI::App& verb, PlaceFlags& flags, const std::string& whose);
// `onto`: into a character's file.
EditMode edit_mode(const PlaceFlags& flags, bool onto);

// What retarget, convert and stylize have in common.
struct MotionFlags {
  BatchFlags batch;
  ReadOptions read;
  RigFlags rig;
  OntoFlags onto;
  PlaceFlags place;
  std::string clip;       // The motion to take, or empty for all.
  bool in_place = false;  // See stay_in_place().
  bool no_body = false;   // Sticks instead of a body where joints have no mesh.
};

// Gives `verb` --in-place and --no-body.
void add_result_options(CLI::App& verb, MotionFlags& flags);

// A motion to be written, as ClipEdit has it.
struct NewMotion {
  Clip clip = {};
  std::string name = {};
  int which = kNewClip;
  std::vector<double> source_frames = {};
  std::optional<Rig> rig = {};  // Where it goes into a file of its own.
};
// `motions` outlive the edits.
std::vector<ClipEdit> edits_of(const std::vector<NewMotion>& motions);

// Makes the names of new motions different from each other and from those that the file `has`, and
// puts them into `file`, with the sentence that tells them. They stay where the output is a BVH
// file, whose motion has no name, or where the motions take the place of others and their names.
void name_new_motions(FileJob& file, const std::vector<std::string>& has, const PlaceFlags& flags,
                      bool onto, std::vector<NewMotion>& motions);

class CharacterFile {
 public:
  // Fails where the file cannot be read or holds no humanoid.
  static Result<CharacterFile> open(const OntoFlags& flags);

  const std::string& path() const { return path_; }
  // Of the files that hold the character: .glb for .fbx, else the file's own.
  std::string extension() const;
  // Rejects outputs that the character cannot be written to.
  Result<void> check_outputs(const std::vector<FileJob>& files) const;

  // The motion on the character. `place` stands in front of the message of a failure.
  Result<Clip> put(const Clip& motion, const Rig& rig, const std::string& place,
                   const RetargetOptions& options = {}) const;
  // The rig of motion that was put on it.
  Result<Rig> rig_of(const Clip& clip, const std::string& place) const;

  // The bytes of the character's file with these motions; a file of another format has the joints
  // alone, and one motion.
  Result<std::string> encode(const std::vector<NewMotion>& motions, EditMode mode,
                             const std::string& output, bool no_body) const;
  // The motions that the file has.
  std::vector<std::string> clip_names() const { return file_->clip_names(); }

 private:
  CharacterFile(std::string path, std::unique_ptr<MotionFile> file, RigOptions options, Clip clip,
                Rig rig)
      : path_(std::move(path)),
        file_(std::move(file)),
        options_(std::move(options)),
        clip_(std::move(clip)),
        rig_(std::move(rig)) {}

  std::string path_;
  std::shared_ptr<const MotionFile> file_;
  RigOptions options_;
  Clip clip_;  // What tells the rig: the rest pose, or a motion where that does not stand.
  Rig rig_;
};

// Writes the character with the motions of each input, as they are: retarget and convert --onto.
// `doing`, `done`: as for run_batch(). The exit code.
int retarget_files(const MotionFlags& flags, const RetargetOptions& options,
                   const std::string& doing, const std::string& done);

}  // namespace panache::cli
