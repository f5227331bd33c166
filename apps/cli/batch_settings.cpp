#include "batch_settings.h"

#include <algorithm>
#include <array>
#include <cinttypes>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <string_view>

#include "model_path.h"
#include "sha256.h"

namespace panache::cli {
namespace {

constexpr std::array<std::string_view, 15> kOfTheBatch = {
    "IN",       "--output",        "--files-from", "--below", "--shard",
    "--force",  "--skip-existing", "--jobs",       "--quiet", "--json",
    "--report", "--mapping",       "--dry-run",    "--help",  "--verbose"};

std::string name_of(const CLI::Option& option) {
  const std::vector<std::string>& names = option.get_lnames();
  return names.empty() ? option.get_name() : "--" + names.front();
}

}  // namespace

Json batch_settings(const CLI::App& verb, const std::string& model) {
  Json options = Json::object(), files = Json::object();
  for (const CLI::Option* option : verb.get_options()) {
    const std::string name = name_of(*option);
    if (option->count() == 0 || name == "--model" ||
        std::find(kOfTheBatch.begin(), kOfTheBatch.end(), name) != kOfTheBatch.end()) {
      continue;
    }
    const std::vector<std::string> given = option->reduced_results();
    options[name] = given;
    std::error_code status;
    if (given.size() == 1 && std::filesystem::is_regular_file(given[0], status)) {
      files[name] = sha256_of_file(given[0]);
    }
  }
  const auto given = [&](const char* name) {
    const CLI::Option* option = verb.get_option_no_throw(name);
    return option && option->count() > 0;
  };
  if ((given("--remove") || given("--neutral")) && !given("--remover")) {
    if (const Result<std::string> shipped = find_shipped(kRemoverModel)) {
      files["--remover"] = sha256_of_file(*shipped);
    }
  }
  Json of_model;
  if (!model.empty()) {
    of_model = {{"file", std::filesystem::path(model).filename().string()},
                {"sha256", sha256_of_file(model)}};
  }
  return {{"version", PANACHE_VERSION},
          {"verb", verb.get_name()},
          {"model", of_model},
          {"options", options},
          {"files", files}};
}

std::string id_of(const Json& settings) {
  char digits[17];
  std::snprintf(digits, sizeof digits, "%016" PRIx64,
                static_cast<uint64_t>(std::hash<std::string>()(settings.dump())));
  return digits;
}

}  // namespace panache::cli
