#pragma once
// A character file that motions of other files are put on: --onto.

#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "batch.h"
#include "clip/motion_file.h"
#include "formats.h"
#include "retarget/retarget.h"
#include "rig/rig.h"

namespace panache::cli {

struct OntoFlags {
  std::string file;  // Or empty.
  std::string map;   // A JSON file for that file's joints, or empty.
};
// Gives `verb` --onto and --onto-map; `flags` must outlive it.
CLI::Option* add_onto_options(CLI::App& verb, OntoFlags& flags);

// A motion to be written into a character's file.
struct NewMotion {
  Clip clip;
  std::string name;
};

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
                             const std::string& output, const FigureFlags& figure) const;
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

}  // namespace panache::cli
