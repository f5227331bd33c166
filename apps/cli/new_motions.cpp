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
  CLI::Option* replace = verb.add_flag("--replace", flags.replace,
                                       "Replace " + whose +
                                           " instead of adding\nnew ones (a BVH file holds only "
                                           "one)");
  verb.add_flag("--first", flags.first,
                "Put new animations first, for viewers that play\nthe first one")
      ->excludes(replace);
}

EditMode edit_mode(const PlaceFlags& flags) {
  if (flags.replace) return EditMode::replace;
  return flags.first ? EditMode::add_first : EditMode::add_beside;
}

void name_new_motions(FileJob& file, const std::vector<std::string>& has, const PlaceFlags& flags,
                      std::vector<std::string>& names) {
  if (holds_one_motion(extension_of(file.output)) || flags.replace) return;
  TakenNames taken;
  for (const std::string& name : has) unique_name(name, taken);
  for (std::string& name : names) name = unique_name(name, taken);
  std::string text = "new: " + list(names);
  if (!has.empty() && flags.first) text += ", before " + list(has);
  if (!has.empty() && !flags.first) {
    text += ", after " + list(has) + "; --first puts it before, --replace in its place";
  }
  file.added.push_back(text);
}

}  // namespace panache::cli
