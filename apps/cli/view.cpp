// panache view: serves the page to this machine only.

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>

#include "base/file.h"
#include "formats.h"
#include "glb.h"
#include "input.h"
#include "messages.h"
#include "model_path.h"
#include "model_report.h"
#include "page_server.h"
#include "style/model/model.h"
#include "verbs.h"

namespace panache::cli {
namespace {

namespace fs = std::filesystem;

// A file as served to the page, and its name there.
struct Served {
  std::string name, bytes;
};

// Makes the file self-contained; converts FBX to GLB.
Served read_served(const std::string& path) {
  const std::string name = fs::path(path).filename().string(), extension = extension_of(path);
  const std::string as_glb = name + ".glb";
  const std::unique_ptr<MotionFile> motion = need(open_motion(path, {}, as_glb));
  const bool is_glb = becomes_glb(path, as_glb);
  if (is_glb || must_be_encoded(extension)) {
    const std::string_view encoded_as = find_format(formats(), extension)->encoded_as;
    return Served{is_glb                    ? as_glb
                  : encoded_as == extension ? name
                                            : name + std::string(encoded_as),
                  motion->encode({}, EditMode::replace)};
  }
  return {name, need(read_file(path))};
}

// A model, unchanged but validated: the page could show an error only in the browser.
Served read_model(const std::string& path) {
  Served model{fs::path(path).filename().string(), need(read_file(path))};
  need(Model::parse(model.bytes, path));
  return model;
}

// Adds the styles of a folder to a model.
void add_library(const std::string& folder, Served& model) {
  const StyleLibrary library = need(read_library(folder));
  for (const Error& broken : library.broken) print_message("warning: " + broken.message);
  const TensorFile file = need(parse_safetensors(model.bytes, model.name));
  model.bytes = format_safetensors(with_library(file, model.name, library));
}

struct ViewVerb {
  std::string file, model, library;
  bool no_open = false;
};

// Opens an address in the user's browser; false if there is no desktop or nothing to open it with.
bool open_in_browser(const std::string& address) {
#ifdef __APPLE__
  const std::string opener = "open";
#else
  if (!std::getenv("DISPLAY") && !std::getenv("WAYLAND_DISPLAY")) return false;
  const std::string opener = "xdg-open";
#endif
  // The browser may stay as long as it likes, and its messages are not for the user.
  const std::string command = "command -v " + opener + " >/dev/null || exit 1; " + opener + " '" +
                              address + "' >/dev/null 2>&1 </dev/null &";
  return std::system(command.c_str()) == 0;
}

int view(const ViewVerb& verb) {
  Served motion, model;
  std::string query;
  const auto add = [&](const std::string& path, const char* key, Served (*read)(const std::string&),
                       Served& out) {
    if (path.empty()) return;
    out = read(path);
    query +=
        (query.empty() ? "?" : "&") + std::string(key) + "=" + percent_encoded(out.name, "-_.");
  };
  add(verb.file, "open", read_served, motion);
  const bool has_library = !verb.library.empty();
  add(has_library ? need(find_model(verb.model)) : verb.model, "model", read_model, model);
  if (has_library) add_library(verb.library, model);
  const std::unique_ptr<PageServer> server = need(PageServer::create());
  if (!motion.name.empty()) server->serve("/open/.*", [&motion] { return motion.bytes; });
  if (!model.name.empty()) server->serve("/model/.*", [&model] { return model.bytes; });
  const std::string address = "http://" + server->address() + "/" + query;
  print(address + "\n");
  const bool opened = !verb.no_open && open_in_browser(address);
  print_message(opened ? "opened in the browser; Ctrl-C ends"
                       : "open this address in a browser; Ctrl-C ends");
  std::fflush(stdout);
  // Ctrl-C ends the program, so this returns only on failure.
  return fail(server->listen().error(), kBadInput);
}

}  // namespace

void add_view(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("view", "Show and restyle motion in a browser");
  auto options = std::make_shared<ViewVerb>();
  add_option(*verb, "file FILE", options->file,
             "Motion file to open in the page; default: a walker to steer");
  add_option(*verb, "--model MODEL", options->model,
             "Model to style with; default: the page's own");
  add_option(*verb, "--library FOLDER", options->library,
             "Folder of style files whose styles are shown, too");
  verb->add_flag("--no-open", options->no_open, "Only print the address, open no browser");
  verb->footer("Example:\n  panache view walk.bvh --model mine.safetensors");
  verb->callback([options, &exit_code] { exit_code = view(*options); });
}

}  // namespace panache::cli
