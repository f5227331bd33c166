// panache styles: lists a model's styles, and extracts, adds, removes and renames them.

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/file.h"
#include "learn/style_file.h"
#include "messages.h"
#include "model_path.h"
#include "model_report.h"
#include "style/restyle.h"
#include "verbs.h"
#include "walker/walker.h"

namespace panache::cli {
namespace {

struct StylesVerb {
  std::string model, extract, output, rename;
  std::vector<std::string> add, remove;
  bool force = false;
  bool json = false;
};

// "'old', 'proud'"
std::string list(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "'" : ", '") + name + "'";
  return text;
}

int show_library(const std::string& folder, bool json) {
  const StyleLibrary library = need(read_library(folder));
  report(library, json);
  for (const Error& broken : library.broken) print_message(broken.message);
  return library.broken.empty() ? kDone : kBadInput;
}

int show(const std::string& path, bool json) {
  std::error_code status;
  if (std::filesystem::is_directory(path, status)) return show_library(path, json);
  const Result<TensorFile> file = read_tensors(path);
  // Reports an unreadable file with the usual error for models.
  if (file && is_style_file(*file)) return report(need(load_style(path)), json);
  return report(need(load_model(path)), json);
}

// These edit the model and describe the edit in a few words.
std::string add(TensorFile& model, const StylesVerb& verb) {
  std::vector<std::string> names;
  for (const std::string& path : verb.add) {
    const TensorFile style = need(read_tensors(path));
    model = need(add_style(model, verb.model, style, path, verb.force));
    names.push_back(style.metadata.at("style"));
  }
  return "added " + list(names) + " to " + verb.model;
}

std::string remove(TensorFile& model, const StylesVerb& verb) {
  for (const std::string& name : verb.remove) model = need(remove_style(model, name, verb.model));
  return "removed " + list(verb.remove) + " from " + verb.model;
}

std::string rename(TensorFile& model, const StylesVerb& verb) {
  const size_t equals = verb.rename.find('=');
  const std::string from = verb.rename.substr(0, equals), to = verb.rename.substr(equals + 1);
  model = need(rename_style(model, from, to, verb.model));
  return "renamed '" + from + "' to '" + to + "' in " + verb.model;
}

int change(const StylesVerb& verb) {
  TensorFile model = need(read_tensors(verb.model));
  const std::string deed = !verb.add.empty()      ? add(model, verb)
                           : !verb.remove.empty() ? remove(model, verb)
                                                  : rename(model, verb);
  need(check_writable(verb.model));
  need(replace_model(verb.model, model));
  const LoadedModel loaded = need(load_model(verb.model));
  if (verb.json) return report(loaded, true);
  print(deed + ", which has " + plural(loaded.model->styles().size(), "style") + " now and " +
        std::to_string(loaded.bytes) + " bytes\n");
  return kDone;
}

// Gives a style without a thumbnail one, from a generated walk in that style, if the walker's model
// is installed.
void add_thumbnail(const TensorFile& file, const std::string& path, const std::string& style,
                   TensorFile& out) {
  const Result<std::shared_ptr<const Model>> model = Model::create(file, path);
  const Result<std::string> found = find_shipped(kWalkerModel);
  if (out.metadata.contains("thumbnail") || !model || !found) return;
  const Result<std::shared_ptr<const WalkerModel>> walker = WalkerModel::load(*found);
  if (!walker) return;
  WalkClipOptions walk_options;
  walk_options.seconds = 3;
  const Clip walk = walk_clip(*walker, walk_options);
  const Rig rig = *Rig::create(walk);
  RestyleOptions options;
  options.loop = LoopMode::off;
  const StrengthTrack track{*(*model)->find_style(style), {{0, 1}}};
  const Result<Restyled> styled = restyle(walk, rig, *model, {track}, options);
  if (!styled) return;
  out.metadata["thumbnail"] = thumbnail_of(make_take(styled->clip, rig, PoseLayout::positions));
}

int extract(const std::string& path, const StylesVerb& verb) {
  if (!verb.output.ends_with(".safetensors")) {
    return fail({verb.output + ": expected a name that ends in .safetensors"}, kBadUsage);
  }
  const TensorFile model = need(read_tensors(path));
  TensorFile style = need(extract_style(model, verb.extract, path));
  add_thumbnail(model, path, verb.extract, style);
  const std::string bytes = format_safetensors(style);
  need(write_file(verb.output, bytes, verb.force));
  if (verb.json) return show(verb.output, true);
  print("copied '" + verb.extract + "' from " + path + " to " + verb.output + ", which has " +
        std::to_string(bytes.size()) + " bytes\n");
  return kDone;
}

bool changes(const StylesVerb& verb) {
  return !verb.add.empty() || !verb.remove.empty() || !verb.rename.empty();
}

// Checks that the options can be combined.
Result<void> check_usage(const StylesVerb& verb) {
  const std::array wishes = {!verb.extract.empty(), !verb.add.empty(), !verb.remove.empty(),
                             !verb.rename.empty()};
  if (std::ranges::count(wishes, true) > 1) {
    return Error{"--extract, --add, --remove and --rename: expected one of them at a time"};
  }
  if (changes(verb) && !verb.output.empty()) {
    return Error{"--output: goes with --extract; --add, --remove and --rename change MODEL itself"};
  }
  if (verb.extract.empty() != verb.output.empty()) {
    return Error{"--extract NAME and --output FILE: expected both or neither"};
  }
  if (changes(verb) && verb.model.empty()) {
    return Error{
        "--add, --remove and --rename change a model in its place; expected its name, as "
        "in panache styles model.safetensors --remove old"};
  }
  if (!verb.rename.empty() && verb.rename.find('=') == std::string::npos) {
    return Error{"--rename " + verb.rename + ": expected OLD=NEW"};
  }
  return {};
}

int styles(const StylesVerb& verb) {
  need(check_usage(verb), kBadUsage);
  if (changes(verb)) return change(verb);
  const std::string path = need(find_model(verb.model));
  return verb.extract.empty() ? show(path, verb.json) : extract(path, verb);
}

}  // namespace

void add_styles(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("styles", "List or change the styles of a model");
  auto options = std::make_shared<StylesVerb>();
  verb->add_option("MODEL", options->model,
                   "Model, or the file of a single style, or a folder of\n"
                   "such files; default: $PANACHE_MODEL, else the one shipped")
      ->type_name("");
  add_option(*verb, "--extract NAME", options->extract, "Copy a style to a file (-o)");
  add_option(*verb, "--add FILE", options->add, "Add the styles of such files to MODEL");
  add_option(*verb, "--remove NAME", options->remove, "Remove styles from MODEL");
  add_option(*verb, "--rename OLD=NEW", options->rename, "Rename a style of MODEL");
  add_option(*verb, "-o,--output OUT", options->output, "File for the style (.safetensors)");
  verb->add_flag("--force", options->force, "Overwrite the file; replace styles of the same name");
  verb->add_flag("--json", options->json, "Print JSON");
  verb->footer(
      "--add, --remove and --rename change MODEL in place. A style works with the model that\n"
      "it comes from, and with its int8 version.\n\n"
      "Examples:\n"
      "  panache styles\n"
      "  panache styles library/\n"
      "  panache styles mine.safetensors --extract limping -o limping.safetensors\n"
      "  panache styles other.safetensors --add limping.safetensors\n"
      "  panache styles mine.safetensors --rename limping=hurt");
  verb->callback([options, &exit_code] { exit_code = styles(*options); });
}

}  // namespace panache::cli
