// panache retarget: motion files in, the same motions on another character out.

#include <memory>
#include <string>

#include "batch.h"
#include "input.h"
#include "new_motions.h"
#include "onto.h"
#include "retarget_file.h"
#include "rig_options.h"
#include "verbs.h"

namespace panache::cli {
namespace {

struct RetargetVerb {
  RetargetFlags flags;
  bool no_feet = false;
  bool no_hands = false;
};

int retarget(const RetargetVerb& verb) {
  return retarget_files(verb.flags, {!verb.no_feet, !verb.no_hands}, "retargeting", "retargeted");
}

}  // namespace

void add_retarget(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("retarget", "Put motion files on another character");
  auto options = std::make_shared<RetargetVerb>();
  add_batch_options(*verb, options->flags.batch);
  add_onto_options(*verb, options->flags.onto)->required();
  add_option(*verb, "--clip NAME", options->flags.clip,
             "Motion to take, if a file has several; default: all");
  add_place_options(*verb, options->flags.place, "the character's animations");
  add_in_place_option(*verb, options->flags.in_place);
  add_figure_options(*verb, options->flags.figure);
  verb->add_flag("--no-feet", options->no_feet, "Do not correct feet and floor contact");
  verb->add_flag("--no-hands", options->no_hands, "Do not correct hands that touch");
  add_rig_options(*verb, options->flags.rig);
  add_read_options(*verb, options->flags.read);
  verb->footer(
      "The output is the character's file with the motions in it (FBX becomes GLB); as\n"
      ".bvh, or .glb from a BVH, its joints alone. docs/retargeting.md explains how.\n\n"
      "Examples:\n"
      "  panache retarget walk.bvh --onto hero.glb -o hero-walk.glb\n"
      "  panache retarget takes/ --onto avatar.vrm -o on-avatar/\n"
      "  panache stylize walk.bvh --onto hero.glb --style old=1 -o old-hero.glb");
  verb->callback([options, &exit_code] { exit_code = retarget(*options); });
}

}  // namespace panache::cli
