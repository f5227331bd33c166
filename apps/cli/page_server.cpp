#include "page_server.h"

#include <algorithm>
#include <cerrno>
#include <condition_variable>
#include <cstring>
#include <filesystem>
#include <list>
#include <mutex>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "base/os/os.h"

namespace panache::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kAddress = "127.0.0.1";
constexpr size_t kThreads = 8;
constexpr int kNotModified = 304, kForbidden = 403, kNotFound = 404, kMethodNotAllowed = 405;
// The page may only run its own scripts and WebAssembly, read its own files and those that the user
// opens, and must not be framed by other pages.
constexpr const char* kPolicy =
    "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self' 'unsafe-inline'; "
    "img-src 'self' data: blob:; media-src blob:; connect-src 'self' data: blob:; "
    "base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

// The folder that ./run web builds: next to an installed program's folder or next to the build's.
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

// Blocks other sites from reaching this server, by a domain name that resolves to this machine or
// by cross-origin requests from the user's browser.
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

// Whether a header that lists names, like "gzip, br", accepts this one; "br;q=0" rejects it.
bool lists(const httplib::Request& request, const char* header, std::string_view name) {
  const std::string text = request.get_header_value(header);
  std::string_view rest = text;
  while (!rest.empty()) {
    const size_t comma = std::min(rest.find(','), rest.size());
    std::string_view one = rest.substr(0, comma);
    rest.remove_prefix(std::min(comma + 1, rest.size()));
    while (one.starts_with(' ')) one.remove_prefix(1);
    while (one.ends_with(' ')) one.remove_suffix(1);
    if (one.starts_with("W/")) one.remove_prefix(2);
    if (one == name) return true;
    if (one.starts_with(name) && one.substr(name.size()).starts_with(";q=")) {
      return one.find_first_of("123456789", name.size()) != one.npos;
    }
  }
  return false;
}

// Sends a file as it is stored, or tells the browser that it has this content already.
void send_file(const PageFile& file, const httplib::Request& request, httplib::Response& answer) {
  const bool packed = !file.packed.empty() && lists(request, "Accept-Encoding", "br");
  const std::string& bytes = packed ? file.packed : file.bytes;
  const std::string& tag = packed ? file.packed_tag : file.bytes_tag;
  answer.set_header("ETag", tag);
  if (!file.packed.empty()) answer.set_header("Vary", "Accept-Encoding");
  if (lists(request, "If-None-Match", tag)) {
    answer.status = kNotModified;
    return;
  }
  if (packed) answer.set_header("Content-Encoding", "br");
  // httplib compresses contents that it holds itself, at each request.
  answer.set_content_provider(bytes.size(), file.type,
                              [&bytes](size_t offset, size_t length, httplib::DataSink& sink) {
                                return sink.write(bytes.data() + offset, length);
                              });
}

// A pool of up to kThreads threads, or as many as can be started. httplib's own pool would abort if
// a thread cannot start or a request runs out of memory; here that request gets no answer.
class PageThreads final : public httplib::TaskQueue {
 public:
  // Throws std::system_error if no thread can be started.
  PageThreads() {
    threads_.reserve(kThreads);
    while (threads_.size() < kThreads) {
      try {
        threads_.emplace_back([this] { work(); });
      } catch (...) {
        if (threads_.empty()) throw;
        break;
      }
    }
  }
  ~PageThreads() override { shutdown(); }
  PageThreads(const PageThreads&) = delete;
  PageThreads& operator=(const PageThreads&) = delete;

  // Newer releases check whether the job was accepted.
  using Enqueued = decltype(std::declval<httplib::TaskQueue&>().enqueue(nullptr));
  Enqueued enqueue(std::function<void()> job) override {
    {
      const std::scoped_lock lock(mutex_);
      jobs_.push_back(std::move(job));
    }
    changed_.notify_one();
    return Enqueued(true);
  }
  void shutdown() override {
    {
      const std::scoped_lock lock(mutex_);
      over_ = true;
    }
    changed_.notify_all();
    for (std::thread& thread : threads_) {
      if (thread.joinable()) thread.join();
    }
  }

 private:
  void work() {
    for (;;) {
      std::function<void()> job;
      {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] { return over_ || !jobs_.empty(); });
        if (jobs_.empty()) return;
        job = std::move(jobs_.front());
        jobs_.pop_front();
      }
      try {
        job();
      } catch (...) {  // Out of memory: the request gets no answer.
      }
    }
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::list<std::function<void()>> jobs_;  // The mutex guards this and the following:
  bool over_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace

Result<std::unique_ptr<PageServer>> PageServer::create() {
  Result<std::string> page = find_page();
  if (!page) return page.error();
  Result<PageFiles> files = PageFiles::read(*page);
  if (!files) return files.error();
  std::unique_ptr<PageServer> out(new PageServer);
  out->files_ = *std::move(files);
  httplib::Server& server = out->server_;
  server.new_task_queue = [] { return new PageThreads; };
  // These headers give the page a finer clock, which measures the time of a step.
  server.set_default_headers({{"Cross-Origin-Opener-Policy", "same-origin"},
                              {"Cross-Origin-Embedder-Policy", "require-corp"},
                              {"Cross-Origin-Resource-Policy", "same-origin"},
                              {"Content-Security-Policy", kPolicy},
                              {"X-Content-Type-Options", "nosniff"},
                              {"Cache-Control", "no-cache"}});
  // Data after a rejected request must not be parsed as another request.
  server.set_keep_alive_max_count(1);
  const int port = server.bind_to_any_port(kAddress);
  if (port < 0) {
    return Error{std::string(kAddress) + ": no port to serve the page on: " + std::strerror(errno) +
                 "; is the loopback interface up, and may programs listen on it?"};
  }
  out->address_ = std::string(kAddress) + ":" + std::to_string(port);
  server.set_pre_routing_handler(
      [port, &files = out->files_](const httplib::Request& request, httplib::Response& answer) {
        const int status = status_of(request, port);
        const PageFile* file = status == 0 ? files.find(request.path) : nullptr;
        if (status == 0 && !file) return httplib::Server::HandlerResponse::Unhandled;
        if (file) {
          send_file(*file, request, answer);
        } else {
          answer.status = status;
        }
        return httplib::Server::HandlerResponse::Handled;
      });
  return out;
}

void PageServer::serve(const std::string& path, std::function<std::string()> content) {
  server_.Get(path,
              [content = std::move(content)](const httplib::Request&, httplib::Response& answer) {
                std::string bytes = content();
                if (bytes.empty()) {
                  answer.status = kNotFound;
                } else {
                  answer.set_content(std::move(bytes), "application/octet-stream");
                }
              });
}

void PageServer::serve_events(const std::string& path,
                              std::function<std::function<std::string()>()> open) {
  server_.Get(path,
              [this, open = std::move(open)](const httplib::Request&, httplib::Response& answer) {
                answer.set_chunked_content_provider(
                    "text/event-stream", [this, next = open()](size_t, httplib::DataSink& sink) {
                      // Sends a comment if there is no event, to detect disconnected readers.
                      const std::string text = next();
                      const std::string event = text.empty() ? ":\n\n" : "data: " + text + "\n\n";
                      if (!sink.write(event.data(), event.size())) return false;
                      if (stopped_) sink.done();
                      return true;
                    });
              });
}

Result<void> PageServer::listen() {
  try {
    const bool listened = server_.listen_after_bind();
    if (listened && stopped_) return {};
    return Error{address_ + ": listening failed, so the page is not served any more"};
  } catch (const std::system_error& error) {
    return Error{"no thread to serve the page could be started: " + error.code().message()};
  }
}

void PageServer::stop() {
  stopped_ = true;
  server_.stop();
}

}  // namespace panache::cli
