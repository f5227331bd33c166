#pragma once
// A progress bar on stderr, for people only: silent unless stderr is a terminal.

#include <chrono>
#include <mutex>
#include <string>

namespace panache {

class Progress {
 public:
  explicit Progress(std::string title);
  ~Progress();  // Leaves the finished bar standing, on a line of its own.
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // Shows that `share` (0 to 1) of the work is done, with the time left and `text` behind it. May
  // be called from any thread as often as one likes.
  void update(double share, const std::string& text = "");

 private:
  using Clock = std::chrono::steady_clock;
  const std::string title_;
  const bool shown_;
  const Clock::time_point begin_;
  std::mutex mutex_;
  Clock::time_point drawn_;
  bool any_ = false;
};

}  // namespace panache
