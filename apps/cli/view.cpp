// panache view: the page, served to this machine alone.

#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>

#include <httplib.h>

#include "base/file.h"
#include "base/os/os.h"
#include "formats.h"
#include "input.h"
#include "messages.h"
#include "style/model.h"
#include "verbs.h"
#include "view_threads.h"

namespace panache::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kAddress = "127.0.0.1";
constexpr size_t kThreads = 8;
constexpr int kForbidden = 403, kMethodNotAllowed = 405;
// What the page may do: run its own scripts and its WebAssembly, read its own files and those that
// a user opens, and be shown in no page of others.
constexpr const char* kPolicy =
    "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self' 'unsafe-inline'; "
    "img-src 'self' data: blob:; media-src blob:; connect-src 'self' data: blob:; "
    "base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

// A file as the page takes it, and what to call it there.
struct Served {
  std::string name, bytes;
};

// The folder that ./run web makes: beside an installed program's folder or beside the build's.
Result<std::string> find_page() {
  std::error_code status;
  const fs::path folder = fs::path(program_path()).parent_path();
  std::string looked;
  for (const char* web : {"../share/panache/web", "../web"}) {
    const fs::path page = (folder / web).lexically_normal();
    if (fs::exists(page / "index.html", status)) return page.string();
    looked += (looked.empty() ? "" : ", ") + page.string();
  }
  return Error{"the page was not found; searched " + looked + "; ./run web makes it"};
}

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

// Pages of others must not reach this server: neither under a name of theirs that leads to this
// machine, nor by requests that their browsers send here.
int status_of(const httplib::Request& request, int port) {
  const std::string end = ":" + std::to_string(port);
  const auto is_own = [&](const std::string& host) {
    return host == kAddress + end || host == "localhost" + end;
  };
  if (request.get_header_value_count("Host") != 1 || !is_own(request.get_header_value("Host"))) {
    return kForbidden;
  }
  for (size_t i = 0; i < request.get_header_value_count("Origin"); ++i) {
    const std::string origin = request.get_header_value("Origin", i), scheme = "http://";
    if (!origin.starts_with(scheme) || !is_own(origin.substr(scheme.size()))) return kForbidden;
  }
  return request.method == "GET" || request.method == "HEAD" ? 0 : kMethodNotAllowed;
}

struct ViewVerb {
  std::string file, model;
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
  if (auto read = add(verb.model, "model", read_model, model); !read) {
    return fail(read.error(), kBadInput);
  }
  Result<std::string> page = find_page();
  if (!page) return fail(page.error(), kBadInput);

  httplib::Server server;
  server.new_task_queue = [] { return new ViewThreads(kThreads); };
  // With these a page may read a finer clock, which the times of a step are told by.
  server.set_default_headers({{"Cross-Origin-Opener-Policy", "same-origin"},
                              {"Cross-Origin-Embedder-Policy", "require-corp"},
                              {"Cross-Origin-Resource-Policy", "same-origin"},
                              {"Content-Security-Policy", kPolicy},
                              {"X-Content-Type-Options", "nosniff"},
                              {"Cache-Control", "no-cache"}});
  // What follows a rejected request on its connection is not read as another one.
  server.set_keep_alive_max_count(1);
  const int port = server.bind_to_any_port(kAddress);
  const std::string address = std::string(kAddress) + ":" + std::to_string(port);
  if (port < 0) {
    return fail({std::string(kAddress) + ": no port to serve the page on: " + std::strerror(errno) +
                 "; is the loopback interface up, and may programs listen on it?"},
                kBadInput);
  }
  if (!server.set_mount_point("/", *page)) {
    return fail({*page + ": this folder of the page cannot be served"}, kBadInput);
  }
  server.set_pre_routing_handler(
      [port](const httplib::Request& request, httplib::Response& answer) {
        const int status = status_of(request, port);
        if (status == 0) return httplib::Server::HandlerResponse::Unhandled;
        answer.status = status;
        return httplib::Server::HandlerResponse::Handled;
      });
  const auto serve = [&server](const char* place, const Served& served) {
    if (served.name.empty()) return;
    server.Get(place, [&served](const httplib::Request&, httplib::Response& answer) {
      answer.set_content(served.bytes, "application/octet-stream");
    });
  };
  serve("/open/.*", motion);
  serve("/model/.*", model);
  print("http://" + address + "/" + query + "\n");
  print_message("open this address in a browser; Ctrl-C ends");
  std::fflush(stdout);
  try {
    // Ctrl-C ends the program, so this returns after a failure alone.
    server.listen_after_bind();
    return fail({address + ": listening failed, so the page is not served any more"}, kBadInput);
  } catch (const std::system_error& error) {
    return fail({"no thread to serve the page could be started: " + error.code().message()},
                kBadInput);
  }
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
  verb->footer("Example:\n  panache view walk.bvh --model mine.safetensors");
  verb->callback([options, &exit_code] { exit_code = view(*options); });
}

}  // namespace panache::cli
