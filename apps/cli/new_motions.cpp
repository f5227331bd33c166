#include "new_motions.h"

#include "clip/motion_format.h"
#include "clip/text_cursor.h"
#include "clip/unique_name.h"
#include "formats.h"

namespace panache::cli {
namespace {

// "'walk', 'wave' and 3 more".
std::string list(const std::vector<std::string>& names) {
  constexpr size_t kNamed = 4;
  std::string text;
  for (size_t i = 0; i < names.size() && i < kNamed; ++i) {
    text += (i ? ", " : "") + panache::quoted(names[i]);
  }
  return names.size() > kNamed ? text + " and " + std::to_string(names.size() - kNamed) + " more"
                               : text;
}

}  // namespace

void add_place_options(CLI::App& verb, PlaceFlags& flags, const std::string& whose) {
  CLI::Option* replace = verb.add_flag(
      "--replace", flags.replace,
      "Replace " + whose + " instead of adding\nnew ones (a BVH file holds only one)");
  CLI::Option* first =
      verb.add_flag("--first", flags.first,
                    "Put new animations before those of the file (viewers\nplay "
                    "the first); the default, except with --onto,\nwhich drops those");
  verb.add_flag("--last", flags.last, "Put new animations after those of the file")
      ->excludes(replace)
      ->excludes(first);
  first->excludes(replace);
}

EditMode edit_mode(const PlaceFlags& flags, bool onto) {
  if (flags.last) return EditMode::add_beside;
  return flags.replace || (onto && !flags.first) ? EditMode::replace : EditMode::add_first;
}

void name_new_motions(FileJob& file, const std::vector<std::string>& has, const PlaceFlags& flags,
                      bool onto, std::vector<std::string>& names) {
  if (holds_one_motion(extension_of(file.output)) || flags.replace) return;
  const EditMode mode = edit_mode(flags, onto);
  TakenNames taken;
  if (mode != EditMode::replace) {
    for (const std::string& name : has) unique_name(name, taken);
  }
  for (std::string& name : names) name = unique_name(name, taken);
  std::string text = "new: " + list(names);
  if (!has.empty() && mode == EditMode::replace) {
    text += "; the character's own (" + list(has) + ") are dropped; --first keeps them";
  } else if (!has.empty() && mode == EditMode::add_first) {
    text += ", before " + list(has) + "; --last puts it after, --replace in its place";
  } else if (!has.empty()) {
    text += ", after " + list(has);
  }
  file.added.push_back(text);
}

}  // namespace panache::cli
