#pragma once
// Where new motions stand in a file that holds several, and what they are called there.

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "batch.h"
#include "clip/motion_file.h"

namespace panache::cli {

// Without a flag new motions come first in the file that they are of, and alone on a character.
struct PlaceFlags {
  bool replace = false, first = false, last = false;
};
// Gives `verb` --replace, --first and --last, of which one goes; `whose` are the motions that would
// go.
void add_place_options(CLI::App& verb, PlaceFlags& flags, const std::string& whose);
// `onto`: into a character's file.
EditMode edit_mode(const PlaceFlags& flags, bool onto);

// Makes `names`, those of new motions, different from each other and from those that the file
// `has`, and puts the sentence that names them into `file`. Nothing where the output is a BVH file,
// whose motion has no name, or where the motions take the place of others and their names.
void name_new_motions(FileJob& file, const std::vector<std::string>& has, const PlaceFlags& flags,
                      bool onto, std::vector<std::string>& names);

}  // namespace panache::cli
