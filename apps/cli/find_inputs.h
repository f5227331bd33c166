#pragma once
// Finds the motion files that a command line names: files, folders and patterns.

#include <string>
#include <vector>

#include "base/result.h"

namespace panache::cli {

struct FoundFile {
  std::string path;
  // The path of its result below an output folder: the file's path relative to the named folder.
  std::string name;
};

struct FoundFiles {
  std::vector<FoundFile> files;  // In the order of the arguments, each sorted by name.
  bool is_batch = false;         // Results go into a folder, even for a single file.
};

// A folder stands for all motion files in it and below. A pattern with * ? [...] or ** (any number
// of folders), unless a file has that name, stands for all files that match. Hidden files and
// folders are skipped, and so is `output` if it is inside a folder that is searched. Any other name
// is taken as a file, which may not exist. Duplicates are removed.
Result<FoundFiles> find_inputs(const std::vector<std::string>& arguments,
                               const std::string& output);

// The files listed in the text file `list`, one a line; "-" is stdin. Accepts Windows line ends and
// empty lines. Unless `below` is empty, paths are relative to that folder.
Result<FoundFiles> list_inputs(const std::string& list, const std::string& below);

}  // namespace panache::cli
