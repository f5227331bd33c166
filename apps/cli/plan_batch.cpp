// Plans which files a batch reads and writes.

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "batch.h"
#include "batch_report.h"
#include "clip/text_cursor.h"
#include "formats.h"
#include "standard_streams.h"

namespace panache::cli {
namespace {

// The default name of an output: "takes/walk-old.bvh" for "takes/walk.bvh".
Result<std::string> default_output(const FoundFiles& found, const OutputNaming& naming) {
  if (found.is_batch) {
    const std::string& last = found.files.back().path;
    std::error_code status;
    if (!std::filesystem::exists(last, status)) {
      return Error{last + ": there is no such file; an output is given as --output " + last};
    }
    return Error{"--output is required: a folder for the results of " +
                 plural(found.files.size(), "file")};
  }
  const std::filesystem::path input = found.files[0].path;
  const std::string name = input.stem().string() +
                           (naming.suffix.empty() ? "" : "-" + naming.suffix) +
                           input.extension().string();
  const std::string output = with_extension(input.parent_path() / name, naming.extension).string();
  if (output != input.string()) return output;
  return Error{"--output is required: " + output + " is the input itself"};
}

// A job with stdin as its input, stdout as its output, or both.
Result<FileJob> plan_stream(const BatchFlags& flags, const OutputNaming& naming) {
  if (flags.inputs.size() != 1) {
    return Error{"- (standard input) cannot be combined with other inputs; found " +
                 plural(flags.inputs.size(), "input")};
  }
  FileJob file;
  file.input = flags.inputs[0];
  file.to_stdout = flags.output.value_or(std::string(kStandardStream)) == kStandardStream;
  if (file.to_stdout && flags.json) {
    return Error{"--json: stdout takes the motion; --report FILE writes the same"};
  }
  if (file.input == kStandardStream && !flags.dry_run) {
    Result<StdinMotion> motion = read_stdin();
    if (!motion) return motion.error();
    file.input = motion->name;
    file.bytes = std::move(motion->bytes);
  }
  const FoundFiles found{{{file.input, file.input}}, false};
  const std::string output = file.to_stdout ? "stdout" + extension_of(file.input) : *flags.output;
  if (file.to_stdout) {
    file.output = with_extension(output, naming.extension).string();
    return file;
  }
  Result<std::vector<FilePair>> pairs = name_outputs(found, output, naming.extension);
  if (!pairs) return pairs.error();
  file.output = pairs->front().output;
  return file;
}

bool uses_streams(const BatchFlags& flags) {
  return flags.output == kStandardStream ||
         std::find(flags.inputs.begin(), flags.inputs.end(), kStandardStream) != flags.inputs.end();
}

// The jobs, without checking which files exist.
std::vector<FileJob> name_jobs(const BatchFlags& flags, const OutputNaming& naming) {
  std::vector<FileJob> files;
  if (uses_streams(flags)) {
    files.push_back(need(plan_stream(flags, naming), kBadUsage));
    return files;
  }
  const FoundFiles found =
      need(flags.files_from.empty() ? find_inputs(flags.inputs, flags.output.value_or(""))
                                    : list_inputs(flags.files_from, flags.below));
  const std::string output =
      flags.output ? *flags.output : need(default_output(found, naming), kBadUsage);
  for (const FilePair& pair : need(name_outputs(found, output, naming.extension), kBadUsage)) {
    static_cast<FilePair&>(files.emplace_back()) = pair;
  }
  return files;
}

// Keeps the files of a shard: every N-th, so that neighbouring long takes are spread over shards.
Result<void> take_shard(const std::string& text, std::vector<FileJob>& files) {
  size_t index = 0, count = 0;
  int length = -1;
  if (std::sscanf(text.c_str(), "%zu/%zu%n", &index, &count, &length) != 2 ||
      length != static_cast<int>(text.size()) || index < 1 || index > count) {
    return Error{"--shard " + panache::quoted(text) +
                 ": expected I/N with I from 1 to N, such as 2/8"};
  }
  std::vector<FileJob> taken;
  for (size_t i = index - 1; i < files.size(); i += count) taken.push_back(std::move(files[i]));
  files = std::move(taken);
  return {};
}

Result<void> check_sources(const BatchFlags& flags) {
  if (flags.inputs.empty() && flags.files_from.empty()) {
    return Error{"IN is required; see panache " + flags.verb->get_name() + " --help"};
  }
  if (!flags.inputs.empty() && !flags.files_from.empty()) {
    return Error{"--files-from: expected no other inputs, found " + flags.inputs.front()};
  }
  return {};
}

}  // namespace

std::vector<FileJob> plan_batch(const BatchFlags& flags, const OutputNaming& wanted,
                                const std::string& model) {
  need(check_sources(flags), kBadUsage);
  OutputNaming naming = wanted;
  if (!flags.to.empty()) {
    naming.extension = "." + flags.to;
    if (!has_writer(naming.extension)) {
      throw Failure{
          {"--to: expected " + list_writable_names() + ", found " + panache::quoted(flags.to)},
          kBadUsage};
    }
  }
  need(check_range("--jobs", flags.jobs, 0, 1024), kBadUsage);
  std::vector<FileJob> files = name_jobs(flags, naming);
  if (!flags.to.empty() && extension_of(files.front().output) != naming.extension) {
    throw Failure{{"--to " + flags.to + ": " + files.front().output + " has another format"},
                  kBadUsage};
  }
  if (!flags.shard.empty()) need(take_shard(flags.shard, files), kBadUsage);
  std::vector<FilePair> pairs;
  for (const FileJob& file : files) {
    if (!file.to_stdout) pairs.push_back(file);
    if (!flags.report.empty() && file.output == flags.report) {
      throw Failure{{"--report: " + flags.report + " is an output too; expected a separate file"},
                    kBadUsage};
    }
  }
  if (!flags.report.empty() && flags.skip_existing) {
    need(check_settings(flags.report, pairs, batch_settings(*flags.verb, model)));
  } else if (!flags.report.empty()) {
    need(check_output("", flags.report, flags.force));
  }
  if (flags.skip_existing) {
    std::error_code status;
    for (FileJob& file : files) {
      file.skipped = !file.to_stdout && std::filesystem::exists(file.output, status);
    }
  } else {
    need(check_outputs(pairs, flags.force));
  }
  return files;
}

}  // namespace panache::cli
