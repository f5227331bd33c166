#include "onto.h"

#include <utility>

#include "formats.h"
#include "input.h"
#include "messages.h"
#include "retarget/reference_pose.h"
#include "rig_options.h"

namespace panache::cli {
namespace {

// The clip that tells most of a character: its rest pose, where that is a body that stands; else
// its first motion.
Result<std::pair<Clip, Rig>> find_body(const MotionFile& file, const RigOptions& options) {
  Clip rest = file.rest();
  Result<Rig> at_rest = Rig::create(rest, options);
  const bool has_motion = !file.clip_names().empty();
  const bool stands = at_rest && find_reference_pose(rest, *at_rest).from_rest;
  // A rest pose that hangs in the air, as in BVH files, does not tell the floor.
  const bool on_floor =
      stands && std::abs(at_rest->floor()) < 0.25f * find_reference_pose(rest, *at_rest).leg;
  if (!has_motion || on_floor) {
    if (!at_rest) return at_rest.error();
    return std::pair{std::move(rest), *std::move(at_rest)};
  }
  Clip motion = file.clip(0);
  motion.skeleton = std::move(rest.skeleton);
  Result<Rig> rig = Rig::create(motion, options);
  if (!rig) return rig.error();
  return std::pair{std::move(motion), *std::move(rig)};
}

}  // namespace

CLI::Option* add_onto_options(CLI::App& verb, OntoFlags& flags) {
  CLI::Option* onto = verb.add_option("--onto", flags.file,
                                      "Character to put the motion on (" + motion_extensions() +
                                          "):\nits meshes, rest pose, proportions and units stay")
                          ->type_name("FILE");
  verb.add_option("--onto-map", flags.map, "As --map, for the joints of that character")
      ->type_name("FILE")
      ->needs(onto);
  return onto;
}

Result<CharacterFile> CharacterFile::open(const OntoFlags& flags) {
  Result<std::unique_ptr<MotionFile>> file = open_motion(flags.file);
  if (!file) return file.error();
  Result<RigOptions> options = read_rig_options({{}, "", flags.map});
  if (!options) return options.error();
  Result<std::pair<Clip, Rig>> body = find_body(**file, *options);
  if (!body) return Error{flags.file + ": " + body.error().message};
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
  if (!done) return Error{place + " onto " + path_ + ": " + done.error().message};
  return std::move(done->clip);
}

Result<Rig> CharacterFile::rig_of(const Clip& clip, const std::string& place) const {
  return make_rig(clip, options_, place + " onto " + path_);
}

Result<std::string> CharacterFile::encode(const std::vector<NewMotion>& motions, EditMode mode,
                                          const std::string& output) const {
  const std::string to = extension_of(output);
  const bool whole = keeps_format(extension_of(path_), to);
  if (motions.size() > 1 && (!whole || holds_one_motion(to))) {
    return Error{output + ": takes one motion, found " + plural(motions.size(), "motion") +
                 "; --clip NAME picks one"};
  }
  if (!whole) {
    const NewMotion& only = motions.front();
    const Result<Rig> rig = rig_of(only.clip, only.name);
    return format_clip(only.clip, rig ? &*rig : &rig_, only.name, placement_of(rig_), to);
  }
  std::vector<ClipEdit> edits;
  for (const NewMotion& motion : motions)
    edits.push_back({kNewClip, &motion.clip, {}, motion.name});
  return in_container(file_->encode(edits, mode), path_, output);
}

}  // namespace panache::cli
