#pragma once
// The motion files that a command line means: files, folders and patterns.

#include <string>
#include <vector>

#include "base/result.h"

namespace panache::cli {

struct FoundFile {
  std::string path;
  // What its result is called below an output folder: the file's name, after the folders in which
  // the file lies below the one that was named.
  std::string name;
};

struct FoundFiles {
  std::vector<FoundFile> files;  // In the order of the arguments, and in that of names within one.
  bool is_batch = false;         // Results go into a folder, even that of a single file.
};

// A folder stands for all motion files in it and below; a pattern with * ? [...] or ** (any number
// of folders) that is no file's name, for those that match. Hidden files and folders are passed
// over, and so is all below `output` where that is a folder inside of one that is walked. A name
// that is neither is taken as that of a file, which may not exist. A file that was named twice
// comes once.
Result<FoundFiles> find_inputs(const std::vector<std::string>& arguments,
                               const std::string& output);

// The files that the lines of the text file `list` name; "-" is stdin. Those of a Windows file and
// empty lines are understood. With `below` not empty their names are those below that folder.
Result<FoundFiles> list_inputs(const std::string& list, const std::string& below);

}  // namespace panache::cli
