#include "onto.h"

#include <utility>

#include "clip/motion_file.h"
#include "clip/motion_format.h"
#include "clip/text_cursor.h"
#include "formats.h"
#include "input.h"
#include "messages.h"
#include "retarget/retarget.h"
#include "rig/body_motions.h"

namespace panache::cli {
namespace {

// "'walk', 'wave' and 3 more".
std::string list_some(const std::vector<std::string>& names) {
  constexpr size_t kNamed = 4;
  std::string text;
  for (size_t i = 0; i < names.size() && i < kNamed; ++i) {
    text += (i ? ", " : "") + panache::quoted(names[i]);
  }
  return names.size() > kNamed ? text + " and " + std::to_string(names.size() - kNamed) + " more"
                               : text;
}

}  // namespace

CLI::Option* add_onto_options(CLI::App& verb, OntoFlags& flags) {
  CLI::Option* onto = add_option(verb, "--onto FILE", flags.file,
                                 "Character to put the motion on (" + motion_extensions() +
                                     "):\nits meshes, rest pose, proportions and units stay");
  add_option(verb, "--onto-map FILE", flags.map, "As --map, for the joints of that character")
      ->needs(onto);
  return onto;
}

void add_edit_options(CLI::App& verb, EditFlags& flags, const std::string& whose) {
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

EditMode edit_mode(const EditFlags& flags, bool onto) {
  if (flags.last) return EditMode::add_beside;
  return flags.replace || (onto && !flags.first) ? EditMode::replace : EditMode::add_first;
}

void add_result_options(CLI::App& verb, MotionFlags& flags) {
  verb.add_flag(
      "--in-place", flags.in_place,
      "Remove the horizontal path from hips and root, for\ngames that move the character");
  verb.add_flag("--no-body", flags.no_body,
                "Show joints that have no mesh as sticks in GLB files,\nnot as a body");
}

std::vector<ClipEdit> edits_of(const std::vector<NewMotion>& motions) {
  std::vector<ClipEdit> edits;
  edits.reserve(motions.size());
  for (const NewMotion& motion : motions) {
    edits.push_back({motion.which, &motion.clip, motion.source_frames, motion.name});
  }
  return edits;
}

void name_new_motions(FileJob& file, const std::vector<std::string>& has, const EditFlags& flags,
                      bool onto, std::vector<NewMotion>& motions) {
  const bool are_named = !holds_one_motion(extension_of(file.output)) && !flags.replace;
  const EditMode mode = edit_mode(flags, onto);
  TakenNames taken;
  if (mode != EditMode::replace) {
    for (const std::string& name : has) unique_name(name, taken);
  }
  std::vector<std::string> names;
  for (size_t i = 0; i < motions.size(); ++i) {
    if (are_named) motions[i].name = unique_name(motions[i].name, taken);
    names.push_back(motions[i].name);
    file.clips[i]["result"] = names[i];
  }
  if (!are_named) return;
  std::string text = "new: " + list_some(names);
  if (!has.empty() && mode == EditMode::replace) {
    text += "; the character's own (" + list_some(has) + ") are dropped; --first keeps them";
  } else if (!has.empty() && mode == EditMode::add_first) {
    text += ", before " + list_some(has) + "; --last puts it after, --replace in its place";
  } else if (!has.empty()) {
    text += ", after " + list_some(has);
  }
  file.added.push_back(text);
}

Result<CharacterFile> CharacterFile::open(const OntoFlags& flags, const BatchFlags& batch) {
  const std::string output = batch.to.empty() ? batch.output.value_or("") : "a." + batch.to;
  Result<std::unique_ptr<MotionFile>> file = open_motion(flags.file, {}, output);
  if (!file) return file.error();
  Result<RigOptions> options = read_rig_options({{}, "", flags.map, ""});
  if (!options) return options.error();
  print_notes((*file)->notes());
  const bool moves = !(*file)->clip_names().empty();
  const Clip* motion = moves ? &(*file)->clip(first_body_motion(**file, *options)) : nullptr;
  Result<std::pair<Clip, Rig>> body = find_body((*file)->rest(), motion, *options);
  if (!body) return located(flags.file, body.error());
  return CharacterFile(flags.file, becomes_glb(flags.file, output), *std::move(file),
                       *std::move(options), std::move(body->first), std::move(body->second));
}

std::string CharacterFile::extension() const {
  return is_glb_ ? ".glb" : std::string(find_format(formats(), extension_of(path_))->encoded_as);
}

Result<void> CharacterFile::check_outputs(const std::vector<FileJob>& files) const {
  for (const FileJob& file : files) {
    if (auto format = check_format(path_, file.output); !format) return format;
  }
  return {};
}

Result<Clip> CharacterFile::put(const Clip& motion, const Rig& rig, const std::string& where,
                                const RetargetOptions& options) const {
  Result<Retargeted> done = retarget(motion, rig, clip_, rig_, options);
  if (!done) return located(where + " onto " + path_, done.error());
  return std::move(done->clip);
}

Result<Rig> CharacterFile::rig_of(const Clip& clip, const std::string& where) const {
  return make_rig(clip, options_, where + " onto " + path_);
}

Result<std::string> CharacterFile::encode(const std::vector<NewMotion>& motions, EditMode mode,
                                          const std::string& output, bool no_body) const {
  const std::string to = extension_of(output);
  const bool whole = keeps_format(extension_of(path_), to);
  if (motions.size() > 1 && (!whole || holds_one_motion(to))) {
    return Error{output + ": takes one motion, found " + plural(motions.size(), "motion") +
                 "; --clip NAME picks one"};
  }
  if (!whole) {
    const NewMotion& only = motions.front();
    const Result<Rig> rig = rig_of(only.clip, only.name);
    return format_clip(only.clip, rig ? &*rig : &rig_, only.name, placement_of(rig_), to, no_body);
  }
  return in_container(file_->encode(edits_of(motions), mode), path_, output, options_, no_body);
}

}  // namespace panache::cli
