#pragma once
// The page over HTTP, for this machine alone.

#include <atomic>
#include <functional>
#include <memory>
#include <string>

#include <httplib.h>

#include "base/result.h"

namespace panache::cli {

class PageServer {
 public:
  // Finds the folder of the page and binds a free port of the loopback address. Fails with a
  // message where there is neither.
  static Result<std::unique_ptr<PageServer>> create();

  // "127.0.0.1:40123"
  const std::string& address() const { return address_; }

  // Before listen(). `path`: a regular expression of what follows the address. `content` is called
  // in a thread of its own for each request; the answer is 404 while it is empty.
  void serve(const std::string& path, std::function<std::string()> content);
  // Server-sent events: `open` is called for each reader, and what it returns gives the next line
  // or, after a while at the latest, an empty one.
  void serve_events(const std::string& path, std::function<std::function<std::string()>()> open);

  // Answers requests until stop(), which any thread may call.
  Result<void> listen();
  void stop();

 private:
  PageServer() = default;

  httplib::Server server_;
  std::string address_;
  std::atomic<bool> stopped_ = false;
};

}  // namespace panache::cli
