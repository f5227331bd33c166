#include "batch_report.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cinttypes>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <string_view>

#include "model_path.h"
#include "sha256.h"

namespace panache::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 15> kOfTheBatch = {
    "IN",       "--output",        "--files-from", "--below", "--shard",
    "--force",  "--skip-existing", "--jobs",       "--quiet", "--json",
    "--report", "--mapping",       "--dry-run",    "--help",  "--verbose"};

// Sixteen hexadecimal digits that identify the settings.
std::string id_of(const Json& settings) {
  char digits[17];
  std::snprintf(digits, sizeof digits, "%016" PRIx64,
                static_cast<uint64_t>(std::hash<std::string>()(settings.dump())));
  return digits;
}

// The first difference between two settings: "version 0.1.0 instead of 0.2.0".
std::string difference(const Json& now, const Json& then) {
  const auto text = [](const Json& value) {
    return value.is_string() ? value.get<std::string>() : value.dump();
  };
  for (const auto& [key, value] : now.items()) {
    const Json other = then.contains(key) ? then[key] : Json();
    if (value != other && key != "options") {
      return key + " " + text(other) + " instead of " + text(value);
    }
  }
  return "options " + text(then["options"]) + " instead of " + text(now["options"]);
}

}  // namespace

Json batch_settings(const CLI::App& verb, const std::string& model) {
  Json options = Json::object(), files = Json::object();
  for (const CLI::Option* option : verb.get_options()) {
    const std::string name = option->get_name();
    if (option->count() == 0 || name == "--model" ||
        std::find(kOfTheBatch.begin(), kOfTheBatch.end(), name) != kOfTheBatch.end()) {
      continue;
    }
    const std::vector<std::string> given = option->reduced_results();
    options[name] = given;
    std::error_code status;
    if (given.size() == 1 && fs::is_regular_file(given[0], status)) {
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
    of_model = {{"file", fs::path(model).filename().string()}, {"sha256", sha256_of_file(model)}};
  }
  return {{"version", PANACHE_VERSION},
          {"verb", verb.get_name()},
          {"model", of_model},
          {"options", options},
          {"files", files}};
}

Result<std::unique_ptr<BatchReport>> BatchReport::open(const std::string& path,
                                                       const Json& settings, bool continues) {
  std::error_code status;
  if (const fs::path folder = fs::path(path).parent_path(); !folder.empty()) {
    fs::create_directories(folder, status);
  }
  std::FILE* file = std::fopen(path.c_str(), continues ? "a" : "w");
  if (!file) return Error{path + ": cannot be written: " + std::strerror(errno)};
  std::unique_ptr<BatchReport> out(new BatchReport(path, file, id_of(settings)));
  out->put({{"settings", out->id_}, {"of", settings}});
  return out;
}

void BatchReport::put(const Json& line) {
  const std::string text = line.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
  const std::lock_guard lock(mutex_);
  const bool written = std::fwrite(text.data(), 1, text.size(), file_.get()) == text.size() &&
                       std::fflush(file_.get()) == 0;
  if (!written && failure_ == 0) failure_ = errno;
}

void BatchReport::add(Json file) {
  file["settings"] = id_;
  put(file);
}

Result<void> BatchReport::close() {
  file_.reset();
  if (failure_ == 0) return {};
  return Error{path_ + ": cannot be written: " + std::strerror(failure_)};
}

Result<void> check_settings(const std::string& path, const std::vector<FilePair>& files,
                            const Json& settings) {
  std::ifstream file(path);
  std::map<std::string, Json> settings_of;
  std::map<std::string, std::string> made_with;
  for (std::string line; std::getline(file, line);) {
    const Json read = Json::parse(line, nullptr, false);
    // Another process may be writing the last line.
    if (!read.is_object() || !read.contains("settings")) continue;
    const Json& id = read["settings"];
    if (read.contains("of")) {
      settings_of[id] = read["of"];
    } else if (read.value("ok", false) && !read.value("skipped", false) && read.contains("out")) {
      made_with[read["out"]] = id;
    }
  }
  const std::string id = id_of(settings);
  std::string first, other;
  size_t count = 0;
  std::error_code status;
  for (const auto& [input, output] : files) {
    const auto found = made_with.find(output);
    if (found == made_with.end() || found->second == id || !fs::exists(output, status)) continue;
    if (count++ == 0) first = output, other = found->second;
  }
  if (count == 0) return {};
  return Error{first + (count > 1 ? " and " + std::to_string(count - 1) + " more" : "") +
               ": made with other settings, as " + path +
               " says: " + difference(settings, settings_of[other]) + "; --force makes " +
               (count > 1 ? "them" : "it") + " again"};
}

}  // namespace panache::cli
