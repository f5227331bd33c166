// panache learn: a new style from a few seconds of motion.

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/file.h"
#include "base/progress.h"
#include "input.h"
#include "learn/learn_person.h"
#include "learn/learn_style.h"
#include "learn/style_file.h"
#include "messages.h"
#include "model_path.h"
#include "rig_options.h"
#include "verbs.h"

namespace panache::cli {
namespace {

struct LearnVerb {
  std::vector<std::string> clips;
  std::string name, model, description, source, licence;
  ReadOptions read;
  RigFlags rig;
  bool pose = false, person = false, force = false, json = false;
};

// A motion of a file and its rig.
struct OpenClip {
  std::string path;
  Clip clip;
  Rig rig;

  LearnClip to_learn() const { return {clip, rig, path}; }
};

// The first frame of a motion.
Clip pose_of(const Clip& clip, const Rig& rig) {
  Clip pose;
  pose.skeleton = clip.skeleton;
  pose.frame_time = clip.frame_time;
  pose.resize(1);
  sample(clip, rig.first_frame(), pose.pose(0));
  return pose;
}

OpenClip open(const std::string& path, const ReadOptions& read, const RigOptions& options,
              bool pose) {
  const std::unique_ptr<MotionFile> file = need(open_motion(path, read));
  std::vector<std::string> notes = file->notes();
  const std::vector<int> picked = need(pick_clips(*file, "", options, path, notes));
  if (picked.size() > 1) {
    throw Failure{{path + ": holds " + std::to_string(picked.size()) + " motions (" +
                   list_clips(*file, picked) +
                   "); expected one; panache convert --clip NAME takes one out of it"},
                  kBadInput};
  }
  const Clip& clip = file->clip(picked.front());
  OpenClip out{path, clip, need(make_rig(clip, options, path))};
  if (!pose) note_rate(clip, out.rig, path, notes);
  print_notes(notes);
  if (!pose) return out;
  out.clip = pose_of(clip, out.rig);
  out.rig = need(make_rig(out.clip, options, path));
  return out;
}

std::vector<LearnPair> open_pairs(const LearnVerb& verb) {
  const RigOptions options = need(read_rig_options(verb.rig));
  std::vector<OpenClip> clips;
  for (const std::string& path : verb.clips) {
    clips.push_back(open(path, verb.read, options, verb.pose));
  }
  if (clips.size() == 1) {
    const LearnClip styled = clips[0].to_learn();
    if (verb.pose) return {need(make_pose_pair(styled))};
    return {
        need(make_learn_pair(styled, *need(NeutralBank::load(need(find_shipped(kNeutralBank))))))};
  }
  std::vector<LearnPair> pairs;
  for (size_t i = 0; i < clips.size(); i += 2) {
    pairs.push_back(need(make_learn_pair(clips[i].to_learn(), clips[i + 1].to_learn())));
  }
  return pairs;
}

Json to_json(const LearntStyle& learnt, const LearnVerb& verb, size_t bytes, double seconds) {
  Json pairs = Json::array();
  for (const PairReport& pair : learnt.pairs) {
    pairs.push_back({{"neutral", pair.neutral_name},
                     {"styled", pair.styled_name},
                     {"seconds", pair.seconds},
                     {"tempo", pair.tempo},
                     {"match", pair.match},
                     {"people", pair.twin ? Json(pair.twin->people) : Json()},
                     {"certainty", pair.twin ? Json(pair.twin->certainty) : Json()},
                     {"known", pair.twin ? Json(pair.twin->is_known) : Json()},
                     {"warnings", pair.warnings}});
  }
  Json gestures = Json::array();
  for (const LearntGesture& found : learnt.gestures) {
    gestures.push_back({{"name", found.name},
                        {"styled", found.take},
                        {"start", found.start},
                        {"seconds", found.seconds}});
  }
  const auto measured = [&](double cm) { return learnt.judged ? Json(cm) : Json(); };
  return {{"style", verb.name},
          {"model", verb.model},
          {"bytes", bytes},
          {"seconds", seconds},
          {"held_back_cm", measured(learnt.held_back_cm)},
          {"mean_posture_cm", measured(learnt.mean_posture_cm)},
          {"untouched_cm", measured(learnt.untouched_cm)},
          {"verdict", learnt.judged ? Json(learnt.verdict()) : Json()},
          {"warnings", learnt.warnings},
          {"gestures", gestures},
          {"pairs", pairs}};
}

std::string describe(const LearntStyle& learnt, const LearnVerb& verb, size_t bytes,
                     double seconds) {
  std::string text = "learnt '" + verb.name + "' in " + fixed(seconds, 2) + " s into " +
                     verb.model + " (the style is " + fixed(static_cast<double>(bytes) / 1000, 1) +
                     " KB)\n";
  if (verb.pose) {
    return text + "  " + learnt.pairs[0].neutral_name + " -> " + learnt.pairs[0].styled_name +
           ": a pose; all motion is changed alike\n";
  }
  for (const PairReport& pair : learnt.pairs) {
    text += "  " + pair.neutral_name + " -> " + pair.styled_name + ": " + fixed(pair.seconds, 1) +
            " s, match " + fixed(pair.match, 2) + ", tempo " + fixed(1 / pair.tempo, 2) + " x\n";
    if (!pair.twin) continue;
    text += "  without a neutral clip: " + std::to_string(pair.twin->people) +
            " other people move alike; " + fixed(100 * pair.twin->certainty, 0) +
            " % of the difference in posture counts as style\n";
  }
  for (const LearntGesture& found : learnt.gestures) {
    text +=
        "  gesture in " + found.take + " at " + fixed(found.start, 1) + " s: " + found.name + "\n";
  }
  if (!learnt.judged) {
    return text + "  too short to hold a quarter back, so the error is unknown\n";
  }
  text += std::string("  ") + learnt.verdict() + ": joints " + fixed(learnt.held_back_cm, 1) +
          " cm off on the held-back quarter (mean posture alone " +
          fixed(learnt.mean_posture_cm, 1) + ", no style " + fixed(learnt.untouched_cm, 1) + ")\n";
  return text;
}

Result<void> check_usage(const LearnVerb& verb) {
  if (verb.pose && verb.clips.size() > 2) {
    return Error{"--pose: expected POSE or NEUTRAL POSE, found " +
                 plural(verb.clips.size(), "clip")};
  }
  if (verb.clips.size() > 1 && verb.clips.size() % 2 != 0) {
    return Error{"there are " + plural(verb.clips.size(), "clip") +
                 "; expected STYLED, or NEUTRAL STYLED, or several such pairs"};
  }
  if (!verb.model.ends_with(".safetensors")) {
    return Error{"--into " + verb.model + ": expected a name that ends in .safetensors"};
  }
  if (auto name = check_style_name(verb.name); !name) {
    return located("--name", name.error());
  }
  if (auto read = check_read_options(verb.read); !read) return read;
  return check_rig_flags(verb.rig);
}

// The numbers of the person who moves in the clips.
int find_person(const LearnVerb& verb) {
  need(check_read_options(verb.read), kBadUsage);
  need(check_rig_flags(verb.rig), kBadUsage);
  const std::string path = need(find_model(verb.model));
  const auto model = need(Model::load(path));
  need(check_has_persons(*model));
  const RigOptions rig = need(read_rig_options(verb.rig));
  std::vector<Take> takes;
  for (const std::string& clip : verb.clips) {
    const OpenClip opened = open(clip, verb.read, rig, false);
    takes.push_back(make_take(opened.clip, opened.rig, PoseLayout::positions));
  }
  const auto bank = need(NeutralBank::load(need(find_shipped(kNeutralBank))));
  const LearntPerson found = need(learn_person(model, *bank, takes));
  const std::vector<std::string>& names = model->persons()->names();
  Json numbers = Json::object();
  std::string option, text;
  for (size_t a = 0; a < names.size(); ++a) {
    const double number{found.numbers[a]};
    numbers[names[a]] = rounded(number);
    option += (a ? "," : "") + fixed(number, 2);
    text += "  " + names[a] + " " + fixed(number, 2) + "\n";
  }
  if (verb.json) {
    print(dump(
        Json{{"person", numbers}, {"seconds", found.seconds}, {"explained", found.explained}}));
    return kDone;
  }
  print("from " + fixed(found.seconds, 1) + " s, in deviations from the mean of people:\n" + text +
        "  they carry " + fixed(100 * std::max(found.explained, 0.0), 0) +
        " % of what differs from others\nuse it: panache stylize walk.bvh --person=" + option +
        "\n");
  return kDone;
}

int learn(const LearnVerb& verb) {
  if (verb.person) return find_person(verb);
  need(check_usage(verb), kBadUsage);
  // A new model begins as a copy of the shipped one.
  std::error_code unknown;
  const bool is_new = !std::filesystem::exists(verb.model, unknown);
  const std::string base = is_new ? need(find_model("")) : verb.model;
  if (!is_new) need(check_writable(verb.model));
  const TensorFile model = need(read_tensors(base));
  // Checked before the work: the name is taken.
  if (need(Model::create(model, base))->find_style(verb.name) && !verb.force) {
    const std::string owner =
        is_new ? "the shipped model, which " + verb.model + " starts from," : base + ":";
    return fail({owner + " has a style '" + verb.name +
                 "' already; give another --name, or --force to replace it"},
                kBadInput);
  }
  const std::vector<LearnPair> pairs = open_pairs(verb);
  const Stopwatch watch;
  LearntStyle learnt = need(learn_style(model, base, pairs, verb.name, verb.description));
  const double seconds = watch.seconds();
  set_source(verb.source, verb.licence, learnt.file);
  const TensorFile merged = need(add_style(model, base, learnt.file, verb.name, verb.force));
  need(is_new ? write_file(verb.model, format_safetensors(merged), false)
              : replace_model(verb.model, merged));
  for (const PairReport& pair : learnt.pairs) {
    for (const std::string& warning : pair.warnings) print_message("warning: " + warning);
  }
  for (const std::string& warning : learnt.warnings) print_message("warning: " + warning);
  const size_t bytes = format_safetensors(learnt.file).size();
  print(verb.json ? dump(to_json(learnt, verb, bytes, seconds))
                  : describe(learnt, verb, bytes, seconds));
  return kDone;
}

}  // namespace

void add_learn(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("learn", "Learn a style from a few seconds of motion");
  auto options = std::make_shared<LearnVerb>();
  verb->add_option("CLIPS", options->clips,
                   "Motion files (" + motion_extensions() +
                       "):\na neutral clip, then the same action in the style, 2 to\n"
                       "3 s each; more such pairs may follow. Or one clip in the\n"
                       "style: how other people do it takes the neutral one's place")
      ->required()
      ->type_name("");
  CLI::Option* name = add_option(*verb, "--name NAME", options->name,
                                 "Name of the style, as in stylize --style NAME=1")
                          ->required();
  CLI::Option* into = add_option(*verb, "--into MODEL", options->model,
                                 "Model to add it to (.safetensors); if it does not\n"
                                 "exist, it starts as a copy of the shipped one")
                          ->required();
  add_option(*verb, "--description TEXT", options->description,
             "Description, shown by panache styles");
  add_option(*verb, "--source TEXT", options->source,
             "Where the motion comes from, for those who get\nthe style");
  add_option(*verb, "--licence TEXT", options->licence, "Licence of the style, likewise");
  verb->add_flag("--pose", options->pose,
                 "CLIPS are a neutral pose and a posed one, or only the\n"
                 "latter: of a motion its first frame. The style changes\n"
                 "all motion by their difference");
  verb->add_flag_callback(
      "--person",
      [options, name, into] {
        options->person = true;
        name->required(false);
        into->required(false);
      },
      "CLIPS are neutral motion of one person: print the\nnumbers of the person, for stylize "
      "--person");
  add_rig_options(*verb, options->rig);
  add_read_options(*verb, options->read);
  verb->add_flag("--force", options->force, "Replace a style of the same name");
  verb->add_flag("--json", options->json, "Print what was learnt as JSON");
  verb->footer(
      "The clips of a pair need joints of the same names and parents, and start with the\n"
      "same foot or hand; their rest poses and bone lengths may differ.\n\n"
      "Examples:\n"
      "  panache learn walk.bvh dizzy.bvh --name dizzy --into mine.safetensors\n"
      "  panache learn dizzy.bvh --name dizzy --into mine.safetensors\n"
      "  panache learn --person anna-1.bvh anna-2.bvh\n"
      "  panache stylize run.bvh --model mine.safetensors --style dizzy=1 -o out.bvh");
  verb->callback([options, &exit_code] { exit_code = learn(*options); });
}

}  // namespace panache::cli
