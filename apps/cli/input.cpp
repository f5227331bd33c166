#include "input.h"

#include <algorithm>
#include <filesystem>

#include "clip/text_cursor.h"
#include "formats.h"
#include "messages.h"
#include "pose/step_rate.h"
#include "rig/body_motions.h"

namespace panache::cli {
namespace {

constexpr const char* kClipTakesPose = "; --clip NAME takes one all the same";

}  // namespace

bool is_motion_extension(const std::string& extension) { return find_format(formats(), extension); }

std::string motion_extensions() { return list_extensions(formats()); }

Result<std::unique_ptr<MotionFile>> open_motion(const std::string& path, const ReadOptions& options,
                                                const std::string& output) {
  if (becomes_glb(path, output)) return read_fbx_as_glb(path, options);
  return read_motion(path, formats(), options);
}

void add_read_options(CLI::App& verb, ReadOptions& options) {
  add_option(verb, "--fps N", options.fps,
             "Frames a second, where a file's rate is wrong or missing");
}

Result<void> check_read_options(const ReadOptions& options) {
  return options.fps ? check_range("--fps", *options.fps, kMinFps, kMaxFps) : Result<void>();
}

std::string list_clips(const MotionFile& file, std::span<const int> clips) {
  const std::vector<std::string> names = file.clip_names();
  std::string list;
  for (const int clip : clips) {
    list += (list.empty() ? "" : ", ") + panache::quoted(names[static_cast<size_t>(clip)]);
  }
  return list;
}

Result<std::vector<int>> pick_clips(const MotionFile& file, const std::string& wanted,
                                    const RigOptions& rig, const std::string& path,
                                    std::vector<std::string>& notes) {
  const std::vector<std::string> names = file.clip_names();
  if (names.empty()) {
    return Error{path + ": holds a skeleton and no motion; expected a file with an animation"};
  }
  const BodyMotions body = find_body_motions(file, rig);
  std::vector<int> picked;
  std::vector<std::string> passed_over;
  for (size_t i = 0; i < names.size(); ++i) {
    if (!wanted.empty() && names[i] != wanted) continue;
    const int clip = static_cast<int>(i);
    const auto is_in = [&](const std::vector<int>& list) {
      return std::find(list.begin(), list.end(), clip) != list.end();
    };
    // A pose (a single frame) is used only if asked for by name.
    if (is_in(body.clips) || (!wanted.empty() && is_in(body.poses))) {
      picked.push_back(clip);
    } else {
      passed_over.push_back(names[i]);
    }
  }
  if (!picked.empty()) {
    if (!passed_over.empty()) {
      notes.push_back(path + ": " + note_passed_over(file, body) +
                      (body.poses.empty() ? "" : kClipTakesPose));
    }
    return picked;
  }
  if (!passed_over.empty()) {
    return Error{
        path + ": " + describe_still(passed_over, body.humanoid) + "; expected " +
        (body.clips.empty() ? "an animation that does" : "one of " + list_clips(file, body.clips))};
  }
  if (names.size() == 1 && names[0].empty()) {
    return Error{path + ": holds one motion, which has no name; expected no --clip, found " +
                 panache::quoted(wanted)};
  }
  return Error{path + ": holds no motion " + panache::quoted(wanted) + "; expected one of " +
               list_clips(file, body.clips)};
}

void note_rate(const Clip& clip, const Rig& rig, const std::string& path,
               std::vector<std::string>& notes) {
  if (const auto doubt = doubtful_rate(clip, rig)) {
    notes.push_back(path + ": " + *doubt + kRateHint);
  }
}

void note_remarks(const Rig& rig, const std::string& path, std::vector<std::string>& notes) {
  for (const std::string& remark : rig.remarks()) {
    const std::string note = path + ": " + remark;
    if (std::find(notes.begin(), notes.end(), note) == notes.end()) notes.push_back(note);
  }
}

void print_notes(const std::vector<std::string>& notes) {
  for (const std::string& note : notes) print_message(note);
}

std::string title_of(const std::string& clip_name, const std::string& path) {
  return clip_name.empty() ? std::filesystem::path(path).stem().string() : clip_name;
}

Result<Rig> make_rig(const Clip& clip, const RigOptions& options, const std::string& path) {
  Result<Rig> rig = Rig::create(clip, options);
  if (!rig) return located(path, rig.error());
  return rig;
}

}  // namespace panache::cli
