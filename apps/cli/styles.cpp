// panache styles: what a model can do, and its styles taken out, put in, removed and renamed.

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/file.h"
#include "learn/style_file.h"
#include "learn/thumbnail.h"
#include "messages.h"
#include "model_edit.h"
#include "model_path.h"
#include "model_report.h"
#include "style/restyle.h"
#include "style_library.h"
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
  const Result<StyleLibrary> library = read_library(folder);
  if (!library) return fail(library.error(), kBadInput);
  if (json) {
    print(to_json(*library));
  } else {
    print(describe(*library));
  }
  for (const Error& broken : library->broken) print_message(broken.message);
  return library->broken.empty() ? kDone : kBadInput;
}

int show(const std::string& path, bool json) {
  std::error_code status;
  if (std::filesystem::is_directory(path, status)) return show_library(path, json);
  const Result<TensorFile> file = read_tensors(path);
  // An unreadable file is reported as models are everywhere.
  if (file && is_style_file(*file)) return report(load_style(path), json);
  return report(load_model(path), json);
}

// A model after a change, and what was done to it in a few words.
struct Changed {
  TensorFile file;
  std::string deed;
};

Result<Changed> add(TensorFile model, const StylesVerb& verb) {
  std::vector<std::string> names;
  for (const std::string& path : verb.add) {
    Result<TensorFile> style = read_tensors(path);
    if (!style) return style.error();
    Result<TensorFile> merged = add_style(model, verb.model, *style, path, verb.force);
    if (!merged) return merged.error();
    model = *std::move(merged);
    names.push_back(style->metadata.at("style"));
  }
  return Changed{std::move(model), "added " + list(names) + " to " + verb.model};
}

Result<Changed> remove(TensorFile model, const StylesVerb& verb) {
  for (const std::string& name : verb.remove) {
    Result<TensorFile> rest = remove_style(model, name, verb.model);
    if (!rest) return rest.error();
    model = *std::move(rest);
  }
  return Changed{std::move(model), "removed " + list(verb.remove) + " from " + verb.model};
}

Result<Changed> rename(const TensorFile& model, const StylesVerb& verb) {
  const size_t equals = verb.rename.find('=');
  const std::string from = verb.rename.substr(0, equals), to = verb.rename.substr(equals + 1);
  Result<TensorFile> renamed = rename_style(model, from, to, verb.model);
  if (!renamed) return renamed.error();
  return Changed{*std::move(renamed), "renamed '" + from + "' to '" + to + "' in " + verb.model};
}

int change(const StylesVerb& verb) {
  Result<TensorFile> model = read_tensors(verb.model);
  if (!model) return fail(model.error(), kBadInput);
  Result<Changed> changed = !verb.add.empty()      ? add(*std::move(model), verb)
                            : !verb.remove.empty() ? remove(*std::move(model), verb)
                                                   : rename(*model, verb);
  if (!changed) return fail(changed.error(), kBadInput);
  if (auto open = check_writable(verb.model); !open) return fail(open.error(), kBadInput);
  if (auto written = replace_model(verb.model, changed->file); !written) {
    return fail(written.error(), kBadInput);
  }
  const Result<LoadedModel> loaded = load_model(verb.model);
  if (!loaded || verb.json) return report(loaded, true);
  print(changed->deed + ", which has " + plural(loaded->model->styles().size(), "style") +
        " now and " + std::to_string(loaded->bytes) + " bytes\n");
  return kDone;
}

// A style that has no picture of its own gets one of a generated walk in it, where the walker's
// model is at hand.
void add_thumbnail(const TensorFile& file, const std::string& path, const std::string& style,
                   TensorFile& out) {
  const Result<std::shared_ptr<const Model>> model = Model::create(file, path);
  const Result<std::string> found = find_shipped(kWalkerModel);
  if (out.metadata.contains("thumbnail") || !model || !found) return;
  const Result<std::shared_ptr<const WalkerModel>> walker = WalkerModel::load(*found);
  if (!walker) return;
  WalkClipOptions how;
  how.seconds = 3;
  const Clip walk = walk_clip(*walker, how);
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
  Result<TensorFile> model = read_tensors(path);
  if (!model) return fail(model.error(), kBadInput);
  Result<TensorFile> style = extract_style(*model, verb.extract, path);
  if (!style) return fail(style.error(), kBadInput);
  add_thumbnail(*model, path, verb.extract, *style);
  const std::string bytes = format_safetensors(*style);
  if (auto written = write_file(verb.output, bytes, verb.force); !written) {
    return fail(written.error(), kBadInput);
  }
  if (verb.json) return show(verb.output, true);
  print("copied '" + verb.extract + "' from " + path + " to " + verb.output + ", which has " +
        std::to_string(bytes.size()) + " bytes\n");
  return kDone;
}

bool changes(const StylesVerb& verb) {
  return !verb.add.empty() || !verb.remove.empty() || !verb.rename.empty();
}

// Whether the options go together.
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
  if (auto usage = check_usage(verb); !usage) return fail(usage.error(), kBadUsage);
  if (changes(verb)) return change(verb);
  Result<std::string> path = find_model(verb.model);
  if (!path) return fail(path.error(), kBadInput);
  return verb.extract.empty() ? show(*path, verb.json) : extract(*path, verb);
}

}  // namespace

void add_styles(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("styles", "List or change the styles of a model");
  auto options = std::make_shared<StylesVerb>();
  verb->add_option("MODEL", options->model,
                   "Model, or the file of a single style, or a folder of\n"
                   "such files; default: $PANACHE_MODEL, else the one shipped")
      ->type_name("");
  verb->add_option("--extract", options->extract, "Copy a style to a file (-o)")->type_name("NAME");
  verb->add_option("--add", options->add, "Add the styles of such files to MODEL")
      ->type_name("FILE");
  verb->add_option("--remove", options->remove, "Remove styles from MODEL")->type_name("NAME");
  verb->add_option("--rename", options->rename, "Rename a style of MODEL")->type_name("OLD=NEW");
  verb->add_option("-o,--output", options->output, "File for the style (.safetensors)")
      ->type_name("OUT");
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
