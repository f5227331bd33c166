#pragma once
// Serves the page over HTTP, to this machine only.

#include <atomic>
#include <functional>
#include <memory>
#include <string>

#include <httplib.h>

#include "base/result.h"
#include "page_files.h"

namespace panache::cli {

class PageServer {
 public:
  // Finds the page's folder and binds a free port of the loopback address. Fails if there is
  // neither.
  static Result<std::unique_ptr<PageServer>> create();

  // "127.0.0.1:40123"
  const std::string& address() const { return address_; }

  // Call before listen(). `path`: a regular expression for the URL path. `content` is called in a
  // server thread for each request; while it returns an empty string, the response is 404.
  void serve(const std::string& path, std::function<std::string()> content);
  // Server-sent events: `open` is called for each reader and returns a function that yields the
  // next line, or an empty one after a timeout.
  void serve_events(const std::string& path, std::function<std::function<std::string()>()> open);

  // Answers requests until stop(), which is thread-safe.
  Result<void> listen();
  void stop();

 private:
  PageServer() = default;

  PageFiles files_;
  httplib::Server server_;
  std::string address_;
  std::atomic<bool> stopped_ = false;
};

}  // namespace panache::cli
