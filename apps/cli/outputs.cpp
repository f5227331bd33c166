#include "outputs.h"

#include <filesystem>
#include <map>

#include "formats.h"
#include "messages.h"

namespace panache::cli {

namespace fs = std::filesystem;

namespace {

// Max existing files listed in a message before "and N more".
constexpr size_t kNamed = 3;

}  // namespace

fs::path with_extension(fs::path name, const std::string& extension) {
  const std::string own = extension_of(name.string());
  if (!extension.empty() && extension != own) return name.replace_extension(extension);
  const MotionFormat* format = find_format(formats(), own);
  const bool has_another = extension.empty() && format && format->encoded_as != own;
  return has_another ? name.replace_extension(format->encoded_as) : name;
}

Result<std::vector<FilePair>> name_outputs(const FoundFiles& inputs, const std::string& output,
                                           const std::string& extension) {
  if (output.empty()) return Error{"--output: expected the name of a file or folder, found ''"};
  std::error_code status;
  const bool is_folder = fs::is_directory(output, status);
  const bool slash = output.ends_with('/');
  if (!inputs.is_batch && !slash && !is_folder) {
    return std::vector{FilePair{inputs.files[0].path, output}};
  }
  const std::string many = plural(inputs.files.size(), "file");
  if (!is_folder && fs::exists(output, status)) {
    return Error{output + ": is a file; expected a folder for the results of " + many};
  }
  // Probably a file was meant, and a glob matched more than one.
  if (!is_folder && !slash && fs::path(output).has_extension()) {
    return Error{output + ": expected a folder for the results of " + many + "; call it '" +
                 output + "/' if it is to be one"};
  }
  std::vector<FilePair> files;
  std::map<std::string, std::string> input_of;
  for (const FoundFile& input : inputs.files) {
    const std::string path = (fs::path(output) / with_extension(input.name, extension)).string();
    const auto [other, is_new] = input_of.emplace(path, input.path);
    if (!is_new) {
      return Error{"'" + other->second + "' and '" + input.path + "' would both be written to " +
                   path + "; expected inputs with different names"};
    }
    files.push_back({input.path, path});
  }
  return files;
}

Result<void> check_outputs(const std::vector<FilePair>& files, bool force) {
  if (force) return {};
  std::error_code status;
  std::vector<const FilePair*> taken;
  for (const FilePair& file : files) {
    if (fs::exists(file.output, status)) taken.push_back(&file);
  }
  if (taken.empty()) return {};
  if (taken.size() == 1) {
    const bool is_input = fs::equivalent(taken[0]->input, taken[0]->output, status);
    return Error{taken[0]->output + (is_input ? ": is the input itself" : ": exists already") +
                 "; --force overwrites it"};
  }
  std::string list;
  for (size_t i = 0; i < taken.size() && i < kNamed; ++i) {
    list += (i == 0 ? "" : ", ") + taken[i]->output;
  }
  if (taken.size() > kNamed) list += " and " + std::to_string(taken.size() - kNamed) + " more";
  return Error{std::to_string(taken.size()) + " of " + plural(files.size(), "output") +
               " exist already (" + list + "); --force overwrites them"};
}

Result<void> check_output(const std::string& input, const std::string& output, bool force) {
  return check_outputs({{input, output}}, force);
}

}  // namespace panache::cli
