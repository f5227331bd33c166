// panache stylize: restyles the motions of files.

#include <algorithm>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "clip/text_cursor.h"
#include "formats.h"
#include "input.h"
#include "learn/recognise.h"
#include "messages.h"
#include "model_path.h"
#include "onto.h"
#include "person_options.h"
#include "restyle_report.h"
#include "rig/body_motions.h"
#include "rig/figures.h"
#include "rig_report.h"
#include "sides.h"
#include "strengths.h"
#include "style/restyle.h"
#include "style_options.h"
#include "verbs.h"

namespace panache::cli {
namespace {

struct StylizeOptions : MotionFlags {
  ShapeFlags shape;
  std::vector<std::string> styles, sides;
  std::string strengths;  // A CSV, or empty.
  std::string model;
  RemovalFlags removal;
  PersonFlags person;
  std::string loop = "auto";
  bool no_timing = false;
  bool no_feet = false;
  bool verbose = false;
};

// Settings shared by all files.
struct Wanted {
  std::shared_ptr<const Model> model;
  std::optional<Removal> removal;
  std::optional<PersonWish> person;
  std::vector<StrengthWish> wishes;
  RigOptions rig;
  RestyleOptions restyle_options;
  bool in_place = false;
  bool verbose = false;
  std::optional<CharacterFile> onto;
};

Json tracks_json(const std::vector<StrengthTrack>& tracks, const Wanted& wanted) {
  Json styles = Json::array();
  for (const StrengthTrack& track : tracks) {
    Json points = Json::array();
    for (const StrengthTrack::Point& point : track.points) {
      points.push_back({{"seconds", point.seconds}, {"strength", point.strength}});
    }
    const std::string& name = wanted.model->styles()[static_cast<size_t>(track.style)].name;
    const double side{side_of(wanted.restyle_options.stylizer.sides, track.style)};
    styles.push_back({{"name", name}, {"side", rounded(side)}, {"points", points}});
  }
  return styles;
}

Json person_json(const Wanted& wanted, const std::string& input) {
  if (!wanted.person) return {};
  const PersonWish& person = *wanted.person;
  Json numbers = Json::object();
  const PersonNumbers own = person.numbers_for(input, *wanted.model);
  const std::vector<std::string>& names = wanted.model->persons()->names();
  for (size_t a = 0; a < names.size(); ++a) numbers[names[a]] = rounded(double{own[a]});
  return {{"seed", person.numbers ? Json() : Json(person.seed_for(input))},
          {"variety", rounded(double{person.variety})},
          {"numbers", numbers}};
}

// "walk (old 1)", "walk (old off, limping 1 mirrored, person 7)".
std::string result_name(const std::string& title, const std::string& input, const Wanted& wanted) {
  std::string styles;
  if (wanted.removal) styles = describe(*wanted.removal);
  for (const StrengthWish& wish : wanted.wishes) {
    const std::string& style = wanted.model->styles()[static_cast<size_t>(wish.track.style)].name;
    styles += (styles.empty() ? "" : ", ") + style + " " + describe(wish) +
              describe_side(side_of(wanted.restyle_options.stylizer.sides, wish.track.style));
  }
  if (wanted.person) styles += (styles.empty() ? "" : ", ") + wanted.person->describe(input);
  const double energy{wanted.restyle_options.stylizer.shape.energy};
  if (energy != 1) styles += (styles.empty() ? "" : ", ") + ("energy " + fixed(energy, 2));
  return title + " (" + styles + ")";
}

// The options for each figure that is styled: all that the clip moves, unless one is given.
std::vector<RigOptions> figures_to_style(const Clip& clip, const Wanted& wanted) {
  std::vector<RigOptions> all;
  if (wanted.rig.figure.empty() && wanted.rig.joints.empty() && !wanted.onto) {
    for (const Figure& figure : find_figures(clip)) {
      if (!figure.moves) continue;
      all.push_back(wanted.rig);
      all.back().figure = figure.name;
    }
  }
  if (all.size() < 2) all = {wanted.rig};
  return all;
}

// Whether a motion shows nothing to take off, because it is neutral; then with a note.
bool note_neutral(const Removal& removal, const Clip& clip, const Rig& rig,
                  const std::string& where, FileJob& file) {
  constexpr float kNeutral = 0.95f;
  const auto shares = recognise_styles(removal.remover, clip, rig);
  if (!shares || shares->front().style >= 0 || shares->front().share < kNeutral) return false;
  file.notes.push_back(where + ": is " +
                       fixed(100.0 * static_cast<double>(shares->front().share), 0) +
                       " % neutral, so no style is taken off");
  return true;
}

// name: the motion's name in its file.
NewMotion restyle_clip(const MotionFile& motion, int which, const std::string& name,
                       const Wanted& wanted, FileJob& file,
                       const std::function<void(double)>& progress) {
  const std::string where = name.empty() ? file.input : file.input + ": " + name;
  const std::vector<RigOptions> figures = figures_to_style(motion.clip(which), wanted);
  Rig rig = need(make_rig(motion.clip(which), figures.front(), where));
  if (file.mapping.is_null()) file.mapping = mapping_json(rig);
  note_rate(motion.clip(which), rig, where, file.notes);
  note_remarks(rig, file.input, file.notes);
  // Retargets first and then restyles, with the same result as two runs of the program.
  Clip put;
  if (wanted.onto) {
    put = need(wanted.onto->put(motion.clip(which), rig, where));
    rig = need(wanted.onto->rig_of(put, where));
  }
  const Clip& clip = wanted.onto ? put : motion.clip(which);
  const std::vector<StrengthTrack> tracks = tracks_for(
      wanted.wishes, rig.first_frame() * clip.frame_time, (clip.frames - 1) * clip.frame_time);
  RestyleOptions restyle_options = wanted.restyle_options;
  if (wanted.person) {
    restyle_options.stylizer.person = wanted.person->numbers_for(file.input, *wanted.model);
  }
  if (figures.size() > 1) {  // They keep the same time.
    restyle_options.timing = false;
    restyle_options.loop = LoopMode::off;
  }
  const bool removes = wanted.removal && !note_neutral(*wanted.removal, clip, rig, where, file);
  const auto restyle_one = [&](const Clip& from, const Rig& of) {
    Result<Restyled> done =
        removes ? restyle_without(from, of, *wanted.removal, wanted.model, tracks, restyle_options,
                                  progress)
                : restyle(from, of, wanted.model, tracks, restyle_options, progress);
    if (!done) throw Failure{located(where, done.error()), kBadInput};
    return done;
  };
  Result<Restyled> restyled = restyle_one(clip, rig);
  for (size_t i = 1; i < figures.size(); ++i) {
    const Rig other = need(make_rig(motion.clip(which), figures[i], where));
    restyled->clip = std::move(restyle_one(restyled->clip, other)->clip);
    if (wanted.in_place) stay_in_place(other, restyled->clip);
  }
  NewMotion out{.name = result_name(title_of(name, file.input), file.input, wanted)};
  // Skips a leading reference pose, which is not restyled.
  const auto first = static_cast<size_t>(std::min(rig.first_frame(), clip.frames - 1));
  const RestyleFacts facts = restyle_facts(clip, rig, *restyled);
  const GateReport gate = report_gate(std::span(restyled->gates).subspan(first));
  file.clips.push_back({{"name", name},
                        {"result", out.name},
                        {"frames_in", motion.clip(which).frames},
                        {"frames_out", restyled->clip.frames},
                        {"seconds", restyled->clip.duration()},
                        {"removed", removed_json(removes ? wanted.removal : std::nullopt)},
                        {"styles", tracks_json(tracks, wanted)},
                        {"person", person_json(wanted, file.input)},
                        {"gate", to_json(gate)},
                        {"facts", to_json(facts)}});
  file.facts.push_back(where + ": " + describe(facts));
  if (wanted.person) {
    file.facts.push_back(where + ": moves as " + wanted.person->describe(file.input));
  }
  if (wanted.verbose) file.details.push_back(where + ": " + describe(gate));
  if (gate.eased > 0.5) file.notes.push_back(where + ": " + describe_eased(gate));
  if (wanted.in_place) stay_in_place(rig, restyled->clip);
  file.frames += restyled->clip.frames;
  file.seconds += restyled->clip.duration();
  out.clip = std::move(restyled->clip);
  if (!wanted.onto) {
    out.which = which;
    out.source_frames = std::move(restyled->source_frames);
  }
  out.rig = std::move(rig);
  return out;
}

// The bytes of the result: the character's or input's file with its new motions, or a new file of
// another format with the only motion.
std::string encode(const MotionFile& motion, std::vector<NewMotion> motions, FileJob& file,
                   const Wanted& wanted, const StylizeOptions& options) {
  const EditMode mode = edit_mode(options.edit, wanted.onto.has_value());
  if (wanted.onto) {
    name_new_motions(file, wanted.onto->clip_names(), options.edit, true, motions);
    return need(wanted.onto->encode(motions, mode, file.output, options.no_body));
  }
  const bool keeps = keeps_format(extension_of(file.input), extension_of(file.output));
  const std::vector<std::string> has = keeps ? motion.clip_names() : std::vector<std::string>();
  name_new_motions(file, has, options.edit, false, motions);
  if (keeps) {
    return need(in_container(motion.encode(edits_of(motions), mode), file.input, file.output,
                             wanted.rig, options.no_body));
  }
  const NewMotion& only = motions.front();
  return need(format_clip(only.clip, &*only.rig, only.name, placement_of(*only.rig),
                          extension_of(file.output), options.no_body));
}

void stylize_file(FileJob& file, const Wanted& wanted, const StylizeOptions& options,
                  const std::function<void(double)>& progress) {
  const std::unique_ptr<MotionFile> motion = open_input(file, options.read);
  const std::vector<int> picked =
      need(pick_clips(*motion, options.clip, wanted.rig, file.input, file.notes));
  if (!wanted.onto) need(check_fits(*motion, picked, file.input, file.output));
  const std::vector<std::string> names = motion->clip_names();
  std::vector<NewMotion> motions;
  std::vector<Error> failures;
  for (size_t i = 0; i < picked.size(); ++i) {
    const auto part = [&](double done) {
      progress((static_cast<double>(i) + done) / static_cast<double>(picked.size()));
    };
    const std::string& name = names[static_cast<size_t>(picked[i])];
    try {
      motions.push_back(restyle_clip(*motion, picked[i], name, wanted, file, part));
    } catch (const Failure& failure) {
      // All motions of a file share their joints: if one is not humanoid, none is.
      if (picked.size() > 1 && failure.error.kind == ErrorKind::not_humanoid) {
        throw Failure{{failure.error.message + "; so its other motions are not restyled either"},
                      kBadInput};
      }
      failures.push_back(failure.error);
    }
  }
  if (motions.empty()) throw Failure{failures.front(), kBadInput};
  for (const Error& failure : failures) {
    file.notes.push_back(failure.message + "; this motion is left unchanged");
  }
  write_output(file, encode(*motion, std::move(motions), file, wanted, options),
               options.batch.force);
}

// The requested strengths, from the options and the table.
std::vector<StrengthWish> collect_wishes(const StylizeOptions& options, const Model& model) {
  const bool asks_for_more =
      options.removal.given() || options.person.given() || options.shape.shape.energy != 1;
  if (options.styles.empty() && options.strengths.empty() && !asks_for_more) {
    throw Failure{missing_style(options.batch.inputs, model), kBadUsage};
  }
  std::vector<StrengthWish> wishes = need(parse_styles(options.styles, model), kBadUsage);
  if (options.strengths.empty()) return wishes;
  const std::vector<StrengthWish> table = need(read_strengths(options.strengths, model));
  for (const StrengthWish& wish : table) {
    for (const StrengthWish& other : wishes) {
      if (other.track.style != wish.track.style) continue;
      const std::string& name = model.styles()[static_cast<size_t>(wish.track.style)].name;
      throw Failure{{"style '" + name + "' has strengths both from --style and from " +
                     options.strengths + "; expected one of them"},
                    kBadUsage};
    }
  }
  wishes.insert(wishes.end(), table.begin(), table.end());
  return wishes;
}

// "old-proud", "limping-left": the default suffix of result names.
std::string name_styles(const StylizeOptions& options) {
  std::vector<std::string> parts;
  parts.reserve(options.styles.size() + 1);
  if (options.removal.given() && options.styles.empty() && options.strengths.empty()) {
    parts.emplace_back("neutral");
  }
  for (const std::string& style : options.styles) parts.push_back(style.substr(0, style.find('=')));
  for (const std::string& side : options.sides) {
    const std::string value = side.substr(side.find('=') + 1);
    parts.push_back((parse_number(value) ? "side" : "") + value);
  }
  if (!options.strengths.empty()) {
    parts.push_back(std::filesystem::path(options.strengths).stem().string());
  }
  if (options.person.given()) parts.push_back("person-" + options.person.person);
  if (options.shape.shape.energy != 1) {
    parts.push_back(options.shape.shape.energy < 1 ? "calm" : "lively");
  }
  std::string name;
  for (const std::string& part : parts) name += (name.empty() ? "" : "-") + part;
  std::replace(name.begin(), name.end(), '/', '-');
  return name;
}

LoopMode read_loop(const std::string& text) {
  if (text == "auto") return LoopMode::detect;
  if (text == "on") return LoopMode::force;
  if (text == "off") return LoopMode::off;
  throw Failure{{"--loop " + panache::quoted(text) + ": expected auto, on or off"}, kBadUsage};
}

int stylize(const StylizeOptions& options) {
  need(check_rig_flags(options.rig), kBadUsage);
  need(check_read_options(options.read), kBadUsage);
  Wanted wanted;
  RestyleOptions& restyle_options = wanted.restyle_options;
  need(read_shape(options.shape, restyle_options.stylizer), kBadUsage);
  restyle_options.loop = read_loop(options.loop);
  restyle_options.stylizer.foot_lock = !options.no_feet;
  // With timing 0, the tempo of a removed style stays, too.
  restyle_options.timing = !options.no_timing && restyle_options.stylizer.shape.timing != 0;
  wanted.in_place = options.in_place;
  wanted.verbose = options.verbose;
  const std::string path = need(find_model(options.model));
  wanted.model = need(Model::load(path));
  // Before the files, so that a missing style is reported before a missing output.
  wanted.wishes = collect_wishes(options, *wanted.model);
  need(check_sides_used(options.sides, wanted.wishes, *wanted.model), kBadUsage);
  restyle_options.stylizer.sides = need(parse_sides(options.sides, *wanted.model), kBadUsage);
  wanted.removal = read_removal(options.removal);
  wanted.person = read_person_options(options.person, *wanted.model);
  const std::optional<CharacterFile>& onto = wanted.onto;
  if (!options.onto.file.empty())
    wanted.onto = need(CharacterFile::open(options.onto, options.batch));
  std::vector<FileJob> files =
      plan_batch(options.batch, {onto ? onto->extension() : "", name_styles(options)}, path);
  if (onto) need(onto->check_outputs(files), kBadUsage);
  for (const FileJob& file : files) {
    if (!onto) need(check_format(file.input, file.output), kBadUsage);
  }
  wanted.rig = need(read_rig_options(options.rig));
  return run_batch(std::move(files), options.batch, path, "restyling", "restyled",
                   [&](FileJob& file, const std::function<void(double)>& progress) {
                     stylize_file(file, wanted, options, progress);
                   });
}

}  // namespace

void add_stylize(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("stylize", "Restyle motion files");
  auto options = std::make_shared<StylizeOptions>();
  add_batch_options(*verb, options->batch);
  // One value per option, so that files may follow.
  add_option(*verb, "--style STYLE", options->styles,
             "NAME=STRENGTH: 0 is neutral, 1 the style as captured,\n"
             "above 1 exaggerates (-4 to 4). NAME=1..0 changes evenly\n"
             "from the first frame to the last. One --style per style")
      ->allow_extra_args(false);
  add_side_option(*verb, options->sides);
  add_option(*verb, "--strengths FILE", options->strengths,
             "CSV with a column 'seconds' and a column per style");
  add_option(*verb, "--model FILE", options->model,
             "Model; default: $PANACHE_MODEL, else the one shipped");
  add_removal_options(*verb, options->removal);
  add_person_options(*verb, options->person);
  add_option(*verb, "--clip NAME", options->clip,
             "Motion to restyle, if a file has several;\ndefault: all of them");
  add_onto_options(*verb, options->onto);
  add_edit_options(*verb, options->edit, "the original animations");
  add_result_options(*verb, *options);
  add_shape_options(*verb, options->shape);
  add_option(*verb, "--loop LOOP", options->loop,
             "Make the result loop: if the motion does (auto, the\n"
             "default), always (on) or never (off)");
  verb->add_flag("--no-timing", options->no_timing, "The same as --timing off");
  verb->add_flag("--no-feet", options->no_feet, "Do not hold planted feet in place");
  verb->add_flag("--verbose", options->verbose,
                 "Show how similar each motion is to the training data\nof the styles");
  add_rig_options(*verb, options->rig);
  add_read_options(*verb, options->read);
  verb->footer(
      "Rig, joint names, channel order and frame rate are kept. The output may be of\n"
      "another format (docs/formats.md).\n\n"
      "Examples:\n"
      "  panache stylize walk.bvh --style old=1 -o old.bvh\n"
      "  panache stylize walk.bvh --style old=1           (into walk-old.bvh)\n"
      "  panache stylize walk.bvh --style limping=1 --side limping=left -o left.bvh\n"
      "  panache stylize drunk.bvh --remove drunk --style proud=1 -o proud.bvh\n"
      "  panache stylize crowd/ --person random -o people/\n"
      "  panache stylize takes/ --style proud=0.7 --style angry=0..1 -o restyled/\n"
      "  panache stylize hero.glb --clip walk --style moping=1 -o moping-hero.glb");
  verb->callback([options, &exit_code] { exit_code = stylize(*options); });
}

}  // namespace panache::cli
