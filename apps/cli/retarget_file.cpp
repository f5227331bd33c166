#include "retarget_file.h"

#include <filesystem>
#include <functional>
#include <utility>

#include "input.h"
#include "messages.h"
#include "rig/in_place.h"
#include "rig_report.h"

namespace panache::cli {

namespace fs = std::filesystem;

namespace {

Result<void> retarget_file(FileJob& file, const CharacterFile& character,
                           const RetargetFlags& flags, const RigOptions& rig_options,
                           const RetargetOptions& options) {
  Result<std::unique_ptr<MotionFile>> motion = open_input(file, flags.read);
  if (!motion) return motion.error();
  Result<std::vector<int>> picked =
      pick_clips(**motion, flags.clip, rig_options, file.input, file.notes);
  if (!picked) return picked.error();
  const std::vector<std::string> all_names = (*motion)->clip_names();
  std::vector<NewMotion> motions;
  std::vector<std::string> names;
  std::vector<Error> failures;
  for (const int which : *picked) {
    const std::string& name = all_names[static_cast<size_t>(which)];
    const std::string place = name.empty() ? file.input : file.input + ": " + name;
    const Clip& from = (*motion)->clip(which);
    const Result<Rig> rig = make_rig(from, rig_options, place);
    Result<Clip> put = rig ? character.put(from, *rig, place, options) : Result<Clip>(rig.error());
    if (put && flags.in_place) {
      Result<Rig> onto = character.rig_of(*put, place);
      if (onto) stay_in_place(*onto, *put);
      if (!onto) put = onto.error();
    }
    if (!put) {
      failures.push_back(put.error());
      continue;
    }
    file.clips.push_back({{"name", name},
                          {"frames_in", from.frames},
                          {"frames", put->frames},
                          {"seconds", put->duration()}});
    names.push_back(title_of(name, file.input));
    file.frames += put->frames;
    file.seconds += put->duration();
    if (file.mapping.is_null()) file.mapping = mapping_json(*rig);
    note_rate(from, *rig, place, file.notes);
    motions.push_back({*std::move(put), ""});
  }
  if (motions.empty()) return failures.front();
  for (const Error& failure : failures) {
    file.notes.push_back(failure.message + "; this motion is left out");
  }
  name_new_motions(file, character.clip_names(), flags.place, true, names);
  for (size_t i = 0; i < motions.size(); ++i) {
    motions[i].name = names[i];
    file.clips[i]["result"] = names[i];
  }
  Result<std::string> bytes =
      character.encode(motions, edit_mode(flags.place, true), file.output, flags.figure);
  if (!bytes) return bytes.error();
  return write_output(file, *bytes, flags.batch.force);
}

}  // namespace

int retarget_files(const RetargetFlags& flags, const RetargetOptions& options,
                   const std::string& doing, const std::string& done) {
  need(check_rig_flags(flags.rig), kBadUsage);
  need(check_read_options(flags.read), kBadUsage);
  const CharacterFile character = need(CharacterFile::open(flags.onto));
  std::vector<FileJob> files = plan_batch(
      flags.batch, {character.extension(), "on-" + fs::path(character.path()).stem().string()}, "");
  need(character.check_outputs(files), kBadUsage);
  const RigOptions rig = need(read_rig_options(flags.rig));
  return run_batch(std::move(files), flags.batch, "", doing, done,
                   [&](FileJob& file, const std::function<void(double)>&) {
                     return retarget_file(file, character, flags, rig, options);
                   });
}

}  // namespace panache::cli
