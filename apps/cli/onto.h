#pragma once
// Where new motions go: into their input file, or into a character's file (--onto).

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
  std::string map;   // JSON mapping of that file's joints, or empty.
};
// Gives `verb` --onto and --onto-map; `flags` must outlive it.
CLI::Option* add_onto_options(CLI::App& verb, OntoFlags& flags);

// By default new motions come first in their input file, and replace all in a character's file.
struct EditFlags {
  bool replace = false, first = false, last = false;
};
// Gives `verb` --replace, --first and --last, which exclude each other; `whose` says in the help
// which motions are replaced.
void add_edit_options(CLI::App& verb, EditFlags& flags, const std::string& whose);
// `onto`: new motions go into a character's file.
EditMode edit_mode(const EditFlags& flags, bool onto);

// The options common to retarget, convert and stylize.
struct MotionFlags {
  BatchFlags batch;
  ReadOptions read;
  RigFlags rig;
  OntoFlags onto;
  EditFlags edit;
  std::string clip;       // The motion to use, or empty for all.
  bool in_place = false;  // See stay_in_place().
  bool no_body = false;   // A stick figure instead of a body if joints have no mesh.
};

// Gives `verb` --in-place and --no-body.
void add_result_options(CLI::App& verb, MotionFlags& flags);

// A motion to be written; see ClipEdit.
struct NewMotion {
  Clip clip = {};
  std::string name = {};
  int which = kNewClip;
  std::vector<double> source_frames = {};
  std::optional<Rig> rig = {};  // Set if it goes into a separate file.
};
// `motions` must outlive the edits.
std::vector<ClipEdit> edits_of(const std::vector<NewMotion>& motions);

// Gives new motions names that differ from each other and from those in `has`, and adds a line that
// lists them to `file`. Names stay for a BVH output, which stores none, and if the motions replace
// others and take their names.
void name_new_motions(FileJob& file, const std::vector<std::string>& has, const EditFlags& flags,
                      bool onto, std::vector<NewMotion>& motions);

class CharacterFile {
 public:
  // Fails if the file cannot be read or holds no humanoid. `batch`: where the outputs go.
  static Result<CharacterFile> open(const OntoFlags& flags, const BatchFlags& batch);

  const std::string& path() const { return path_; }
  // The extension of output files: the character file's, unless FBX becomes GLB.
  std::string extension() const;
  // Rejects outputs whose format the character cannot be written in.
  Result<void> check_outputs(const std::vector<FileJob>& files) const;

  // The motion retargeted to the character. Failure messages begin with `where`.
  Result<Clip> put(const Clip& motion, const Rig& rig, const std::string& where,
                   const RetargetOptions& options = {}) const;
  // The rig of a motion after put().
  Result<Rig> rig_of(const Clip& clip, const std::string& where) const;

  // The bytes of the character's file with these motions; other formats get the joints only, and
  // one motion.
  Result<std::string> encode(const std::vector<NewMotion>& motions, EditMode mode,
                             const std::string& output, bool no_body) const;
  // The names of the motions in the file.
  std::vector<std::string> clip_names() const { return file_->clip_names(); }

 private:
  CharacterFile(std::string path, bool is_glb, std::unique_ptr<MotionFile> file, RigOptions options,
                Clip clip, Rig rig)
      : path_(std::move(path)),
        is_glb_(is_glb),
        file_(std::move(file)),
        options_(std::move(options)),
        clip_(std::move(clip)),
        rig_(std::move(rig)) {}

  std::string path_;
  bool is_glb_;  // An FBX file has become GLB.
  std::shared_ptr<const MotionFile> file_;
  RigOptions options_;
  Clip clip_;  // Defines the rig: the rest pose, or a motion if the rest pose is unusable.
  Rig rig_;
};

// Writes the character with the unstyled motions of each input (retarget and convert --onto).
// `doing`, `done`: see run_batch(). Returns the exit code.
int retarget_files(const MotionFlags& flags, const RetargetOptions& options,
                   const std::string& doing, const std::string& done);

}  // namespace panache::cli
