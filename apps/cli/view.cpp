// panache view: the page, served to this machine alone.

#include <cctype>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include "base/file.h"
#include "formats.h"
#include "input.h"
#include "messages.h"
#include "model_path.h"
#include "page_server.h"
#include "style/model.h"
#include "style_library.h"
#include "verbs.h"

namespace panache::cli {
namespace {

namespace fs = std::filesystem;

// A file as the page takes it, and what to call it there.
struct Served {
  std::string name, bytes;
};

// All that a file points to goes into what is served, and FBX comes as GLB.
Result<Served> read_served(const std::string& path) {
  Result<std::unique_ptr<MotionFile>> motion = open_motion(path);
  if (!motion) return motion.error();
  const std::string name = fs::path(path).filename().string(), extension = extension_of(path);
  if (must_be_encoded(extension)) {
    const std::string_view encoded_as = find_format(formats(), extension)->encoded_as;
    return Served{encoded_as == extension ? name : name + std::string(encoded_as),
                  (*motion)->encode({}, EditMode::replace)};
  }
  Result<std::string> bytes = read_file(path);
  if (!bytes) return bytes.error();
  return Served{name, *std::move(bytes)};
}

// A model as it is, checked: the page has no other place to tell of a wrong one than its own view.
Result<Served> read_model(const std::string& path) {
  Result<std::string> bytes = read_file(path);
  if (!bytes) return bytes.error();
  if (auto model = Model::parse(*bytes, path); !model) return model.error();
  return Served{fs::path(path).filename().string(), *std::move(bytes)};
}

// Puts the styles of a folder into a model.
Result<void> add_library(const std::string& folder, Served& model) {
  const Result<StyleLibrary> library = read_library(folder);
  if (!library) return library.error();
  for (const Error& broken : library->broken) print_message("warning: " + broken.message);
  Result<TensorFile> file = parse_safetensors(model.bytes, model.name);
  if (!file) return file.error();
  model.bytes = format_safetensors(with_library(*std::move(file), model.name, *library));
  return {};
}

// In the path of an address.
std::string percent_encoded(const std::string& text) {
  std::string out;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isalnum(byte) || c == '-' || c == '_' || c == '.') {
      out += c;
    } else {
      char code[4];
      std::snprintf(code, sizeof code, "%%%02X", byte);
      out += code;
    }
  }
  return out;
}

struct ViewVerb {
  std::string file, model, library;
};

int view(const ViewVerb& verb) {
  Served motion, model;
  std::string query;
  const auto add = [&](const std::string& path, const char* key,
                       Result<Served> (*read)(const std::string&), Served& out) -> Result<void> {
    if (path.empty()) return {};
    Result<Served> served = read(path);
    if (!served) return served.error();
    out = *std::move(served);
    query += (query.empty() ? "?" : "&") + std::string(key) + "=" + percent_encoded(out.name);
    return {};
  };
  if (auto read = add(verb.file, "open", read_served, motion); !read) {
    return fail(read.error(), kBadInput);
  }
  const bool has_library = !verb.library.empty();
  const Result<std::string> path = has_library ? find_model(verb.model) : verb.model;
  if (!path) return fail(path.error(), kBadInput);
  if (auto read = add(*path, "model", read_model, model); !read) {
    return fail(read.error(), kBadInput);
  }
  if (has_library) {
    if (auto added = add_library(verb.library, model); !added) {
      return fail(added.error(), kBadInput);
    }
  }
  Result<std::unique_ptr<PageServer>> server = PageServer::create();
  if (!server) return fail(server.error(), kBadInput);
  if (!motion.name.empty()) (*server)->serve("/open/.*", [&motion] { return motion.bytes; });
  if (!model.name.empty()) (*server)->serve("/model/.*", [&model] { return model.bytes; });
  print("http://" + (*server)->address() + "/" + query + "\n");
  print_message("open this address in a browser; Ctrl-C ends");
  std::fflush(stdout);
  // Ctrl-C ends the program, so this returns after a failure alone.
  const Result<void> listened = (*server)->listen();
  return fail(listened.error(), kBadInput);
}

}  // namespace

void add_view(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("view", "Show and restyle motion in a browser");
  auto options = std::make_shared<ViewVerb>();
  verb->add_option("file", options->file,
                   "Motion file to open in the page; default: a walker to steer")
      ->type_name("FILE");
  verb->add_option("--model", options->model, "Model to style with; default: the page's own")
      ->type_name("MODEL");
  verb->add_option("--library", options->library,
                   "Folder of style files whose styles are shown, too")
      ->type_name("FOLDER");
  verb->footer("Example:\n  panache view walk.bvh --model mine.safetensors");
  verb->callback([options, &exit_code] { exit_code = view(*options); });
}

}  // namespace panache::cli
