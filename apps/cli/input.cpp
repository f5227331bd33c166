#include "input.h"

#include <filesystem>

#include "clip/text_cursor.h"
#include "formats.h"

namespace panache::cli {

bool is_motion_extension(const std::string& extension) { return find_format(formats(), extension); }

std::string motion_extensions() { return list_extensions(formats()); }

Result<std::unique_ptr<MotionFile>> open_motion(const std::string& path) {
  return read_motion(path, formats());
}

std::string list_clips(const MotionFile& file) {
  std::string list;
  for (const std::string& name : file.clip_names()) {
    list += (list.empty() ? "" : ", ") + panache::quoted(name);
  }
  return list;
}

Result<std::vector<int>> pick_clips(const MotionFile& file, const std::string& wanted,
                                    const std::string& path) {
  const std::vector<std::string> names = file.clip_names();
  if (names.empty()) {
    return Error{path + ": holds a skeleton and no motion; expected a file with an animation"};
  }
  std::vector<int> picked;
  for (size_t i = 0; i < names.size(); ++i) {
    if (wanted.empty() || names[i] == wanted) picked.push_back(static_cast<int>(i));
  }
  if (!picked.empty()) return picked;
  if (names.size() == 1 && names[0].empty()) {
    return Error{path + ": holds one motion, which has no name; expected no --clip, found " +
                 panache::quoted(wanted)};
  }
  return Error{path + ": holds no motion " + panache::quoted(wanted) + "; expected one of " +
               list_clips(file)};
}

std::string title_of(const std::string& clip_name, const std::string& path) {
  return clip_name.empty() ? std::filesystem::path(path).stem().string() : clip_name;
}

Result<Rig> make_rig(const Clip& clip, const RigOptions& options, const std::string& path) {
  Result<Rig> rig = Rig::create(clip, options);
  if (!rig) return Error{path + ": " + rig.error().message};
  return rig;
}

}  // namespace panache::cli
