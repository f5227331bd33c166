// panache retarget: motion files in, the same motions on another character out.

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "input.h"
#include "messages.h"
#include "onto.h"
#include "rig/body_motions.h"
#include "rig_report.h"
#include "verbs.h"

namespace panache::cli {
namespace {

struct RetargetVerb : MotionFlags {
  bool no_feet = false;
  bool no_hands = false;
  bool path_on_hips = false;
};

void retarget_file(FileJob& file, const CharacterFile& character, const MotionFlags& flags,
                   const RigOptions& rig_options, const RetargetOptions& options) {
  const std::unique_ptr<MotionFile> motion = open_input(file, flags.read);
  const std::vector<std::string> names = motion->clip_names();
  std::vector<NewMotion> motions;
  std::vector<Error> failures;
  for (const int which :
       need(pick_clips(*motion, flags.clip, rig_options, file.input, file.notes))) {
    const std::string& name = names[static_cast<size_t>(which)];
    const std::string where = name.empty() ? file.input : file.input + ": " + name;
    const Clip& from = motion->clip(which);
    try {
      const Rig rig = need(make_rig(from, rig_options, where));
      Clip put = need(character.put(from, rig, where, options));
      if (flags.in_place) stay_in_place(need(character.rig_of(put, where)), put);
      file.clips.push_back({{"name", name},
                            {"frames_in", from.frames},
                            {"frames", put.frames},
                            {"seconds", put.duration()}});
      file.frames += put.frames;
      file.seconds += put.duration();
      if (file.mapping.is_null()) file.mapping = mapping_json(rig);
      note_rate(from, rig, where, file.notes);
      note_remarks(rig, file.input, file.notes);
      motions.push_back({std::move(put), title_of(name, file.input)});
    } catch (const Failure& failure) {
      failures.push_back(failure.error);
    }
  }
  if (motions.empty()) throw Failure{failures.front(), kBadInput};
  for (const Error& failure : failures) {
    file.notes.push_back(failure.message + "; this motion is left out");
  }
  name_new_motions(file, character.clip_names(), flags.edit, true, motions);
  write_output(
      file,
      need(character.encode(motions, edit_mode(flags.edit, true), file.output, flags.no_body)),
      flags.batch.force);
}

}  // namespace

int retarget_files(const MotionFlags& flags, const RetargetOptions& options,
                   const std::string& doing, const std::string& done) {
  need(check_rig_flags(flags.rig), kBadUsage);
  need(check_read_options(flags.read), kBadUsage);
  const CharacterFile character = need(CharacterFile::open(flags.onto, flags.batch));
  std::vector<FileJob> files = plan_batch(
      flags.batch,
      {character.extension(), "on-" + std::filesystem::path(character.path()).stem().string()}, "");
  need(character.check_outputs(files), kBadUsage);
  const RigOptions rig = need(read_rig_options(flags.rig));
  return run_batch(std::move(files), flags.batch, "", doing, done,
                   [&](FileJob& file, const std::function<void(double)>&) {
                     retarget_file(file, character, flags, rig, options);
                   });
}

void add_retarget(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("retarget", "Put motion files on another character");
  auto options = std::make_shared<RetargetVerb>();
  add_batch_options(*verb, options->batch);
  add_onto_options(*verb, options->onto)->required();
  add_option(*verb, "--clip NAME", options->clip,
             "Motion to take, if a file has several; default: all");
  add_edit_options(*verb, options->edit, "the character's animations");
  add_result_options(*verb, *options);
  verb->add_flag("--no-feet", options->no_feet, "Do not correct feet and floor contact");
  verb->add_flag("--no-hands", options->no_hands, "Do not correct hands that touch");
  verb->add_flag("--path-on-hips", options->path_on_hips,
                 "Keep the path over the ground on the hips, even if the\ncharacter has a root "
                 "joint for it");
  add_rig_options(*verb, options->rig);
  add_read_options(*verb, options->read);
  verb->footer(
      "The output is the character's file with the motions in it; as\n"
      ".bvh, or .glb from a BVH, its joints alone. docs/retargeting.md explains how.\n\n"
      "Examples:\n"
      "  panache retarget walk.bvh --onto hero.glb -o hero-walk.glb\n"
      "  panache retarget takes/ --onto avatar.vrm -o on-avatar/\n"
      "  panache stylize walk.bvh --onto hero.glb --style old=1 -o old-hero.glb");
  verb->callback([options, &exit_code] {
    exit_code =
        retarget_files(*options, {!options->no_feet, !options->no_hands, !options->path_on_hips},
                       "retargeting", "retargeted");
  });
}

}  // namespace panache::cli
