#include "onto.h"

#include <utility>

#include "formats.h"
#include "input.h"
#include "messages.h"
#include "retarget/find_body.h"
#include "rig/body_motions.h"
#include "rig_options.h"

namespace panache::cli {
CLI::Option* add_onto_options(CLI::App& verb, OntoFlags& flags) {
  CLI::Option* onto = add_option(verb, "--onto FILE", flags.file,
                                 "Character to put the motion on (" + motion_extensions() +
                                     "):\nits meshes, rest pose, proportions and units stay");
  add_option(verb, "--onto-map FILE", flags.map, "As --map, for the joints of that character")
      ->needs(onto);
  return onto;
}

Result<CharacterFile> CharacterFile::open(const OntoFlags& flags) {
  Result<std::unique_ptr<MotionFile>> file = open_motion(flags.file);
  if (!file) return file.error();
  Result<RigOptions> options = read_rig_options({{}, "", flags.map});
  if (!options) return options.error();
  print_notes((*file)->notes());
  const bool moves = !(*file)->clip_names().empty();
  const Clip* motion = moves ? &(*file)->clip(first_body_motion(**file, *options)) : nullptr;
  Result<std::pair<Clip, Rig>> body = find_body((*file)->rest(), motion, *options);
  if (!body) return located(flags.file, body.error());
  return CharacterFile(flags.file, *std::move(file), *std::move(options), std::move(body->first),
                       std::move(body->second));
}

std::string CharacterFile::extension() const {
  const std::string own = extension_of(path_);
  const MotionFormat* format = find_format(formats(), own);
  return format ? std::string(format->encoded_as) : own;
}

Result<void> CharacterFile::check_outputs(const std::vector<FileJob>& files) const {
  for (const FileJob& file : files) {
    if (auto format = check_format(path_, file.output); !format) return format;
  }
  return {};
}

Result<Clip> CharacterFile::put(const Clip& motion, const Rig& rig, const std::string& place,
                                const RetargetOptions& options) const {
  Result<Retargeted> done = retarget(motion, rig, clip_, rig_, options);
  if (!done) return located(place + " onto " + path_, done.error());
  return std::move(done->clip);
}

Result<Rig> CharacterFile::rig_of(const Clip& clip, const std::string& place) const {
  return make_rig(clip, options_, place + " onto " + path_);
}

Result<std::string> CharacterFile::encode(const std::vector<NewMotion>& motions, EditMode mode,
                                          const std::string& output,
                                          const FigureFlags& figure) const {
  const std::string to = extension_of(output);
  const bool whole = keeps_format(extension_of(path_), to);
  if (motions.size() > 1 && (!whole || holds_one_motion(to))) {
    return Error{output + ": takes one motion, found " + plural(motions.size(), "motion") +
                 "; --clip NAME picks one"};
  }
  if (!whole) {
    const NewMotion& only = motions.front();
    const Result<Rig> rig = rig_of(only.clip, only.name);
    return format_clip(only.clip, rig ? &*rig : &rig_, only.name, placement_of(rig_), to, figure);
  }
  std::vector<ClipEdit> edits;
  edits.reserve(motions.size());
  for (const NewMotion& motion : motions) {
    edits.push_back({kNewClip, &motion.clip, {}, motion.name});
  }
  return in_container(file_->encode(edits, mode), path_, output, options_, figure);
}

}  // namespace panache::cli
