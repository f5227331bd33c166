#include "outputs.h"

#include <filesystem>
#include <map>

#include "report.h"

namespace panache::cli {

namespace fs = std::filesystem;

Result<std::vector<std::string>> name_outputs(const std::vector<std::string>& inputs,
                                              const std::string& output) {
  if (output.empty()) return Error{"--output: expected the name of a file or folder, found ''"};
  std::error_code status;
  const bool is_folder = fs::is_directory(output, status);
  const bool slash = output.ends_with('/');
  if (inputs.size() == 1 && !slash && !is_folder) return std::vector{output};

  const std::string many = plural(inputs.size(), "file");
  if (!is_folder && fs::exists(output, status)) {
    return Error{output + ": is a file; expected a folder for the results of " + many};
  }
  // Most likely a file was meant, and a glob brought more than one.
  if (!is_folder && !slash && fs::path(output).has_extension()) {
    return Error{output + ": expected a folder for the results of " + many + "; call it '" +
                 output + "/' if it is to be one"};
  }
  std::vector<std::string> outputs;
  std::map<std::string, std::string> input_of;
  for (const std::string& input : inputs) {
    const std::string path = (fs::path(output) / fs::path(input).filename()).string();
    const auto [other, is_new] = input_of.emplace(path, input);
    if (!is_new) {
      return Error{path + ": is where the results of both '" + other->second + "'" + " and " + "'" +
                   input + "'" + " would go; expected inputs of different names"};
    }
    outputs.push_back(path);
  }
  return outputs;
}

Result<void> check_output(const std::string& input, const std::string& output, bool force) {
  std::error_code status;
  if (force || !fs::exists(output, status)) return {};
  if (fs::equivalent(input, output, status)) {
    return Error{output + ": is the input itself; --force overwrites it"};
  }
  return Error{output + ": exists already; --force overwrites it"};
}

}  // namespace panache::cli
