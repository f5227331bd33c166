// panache retarget: motion files in, the same motions on another character out.

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "batch.h"
#include "messages.h"
#include "new_motions.h"
#include "onto.h"
#include "retarget_file.h"
#include "rig_options.h"
#include "verbs.h"

namespace panache::cli {
namespace {

struct RetargetVerb {
  BatchFlags batch;
  RigFlags rig;
  OntoFlags onto;
  PlaceFlags place;
  std::string clip;  // The motion to take, or empty for all.
  bool no_feet = false;
  bool no_hands = false;
};

int retarget(const RetargetVerb& verb) {
  if (auto rig = check_rig_flags(verb.rig); !rig) return fail(rig.error(), kBadUsage);
  Result<CharacterFile> character = CharacterFile::open(verb.onto);
  if (!character) return fail(character.error(), kBadInput);
  int exit_code = kDone;
  Result<std::vector<FileJob>> files = plan_batch(verb.batch, character->extension(), exit_code);
  if (!files) return fail(files.error(), exit_code);
  if (auto fit = character->check_outputs(*files); !fit) return fail(fit.error(), kBadUsage);
  Result<RigOptions> rig = read_rig_options(verb.rig);
  if (!rig) return fail(rig.error(), kBadInput);
  const RetargetOptions options{!verb.no_feet, !verb.no_hands};
  return run_batch(*std::move(files), verb.batch, "retargeting", "retargeted",
                   [&](FileJob& file, const std::function<void(double)>&) {
                     return retarget_file(file, *character, verb.clip, *rig, options, verb.place,
                                          verb.batch.force);
                   });
}

}  // namespace

void add_retarget(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("retarget", "Put motion files on another character");
  auto options = std::make_shared<RetargetVerb>();
  add_batch_options(*verb, options->batch);
  add_onto_options(*verb, options->onto)->required();
  verb->add_option("--clip", options->clip, "Motion to take, if a file has several; default: all")
      ->type_name("NAME");
  add_place_options(*verb, options->place, "the character's animations");
  verb->add_flag("--no-feet", options->no_feet, "Leave feet and floor to the angles alone");
  verb->add_flag("--no-hands", options->no_hands, "Leave hands that meet to the angles alone");
  add_rig_options(*verb, options->rig);
  verb->footer(
      "The output is the character's file with the motions in it (FBX becomes GLB); as\n"
      ".bvh, or .glb from a BVH, its joints alone. docs/retargeting.md says how it is done.\n\n"
      "Examples:\n"
      "  panache retarget walk.bvh --onto hero.glb -o hero-walk.glb\n"
      "  panache retarget takes/ --onto avatar.vrm -o on-avatar/\n"
      "  panache stylize walk.bvh --onto hero.glb --style old=1 -o old-hero.glb");
  verb->callback([options, &exit_code] { exit_code = retarget(*options); });
}

}  // namespace panache::cli
