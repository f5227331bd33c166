#pragma once
// How far a long work has come: a bar on stderr, or, where that is no terminal, a line of a log now
// and then.

#include <chrono>
#include <mutex>
#include <string>

namespace panache {

class Progress {
 public:
  using Clock = std::chrono::steady_clock;
  // `every`: the time between two lines of a log.
  explicit Progress(std::string title, Clock::duration every = std::chrono::seconds(30));
  ~Progress();  // Leaves the finished bar standing, on a line of its own.
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // Shows that `share` (0 to 1) of the work is done, with the time left and `text` behind it. May
  // be called from any thread as often as one likes.
  void update(double share, const std::string& text = "");

 private:
  const std::string title_;
  const bool is_bar_;
  const Clock::duration every_;
  const Clock::time_point begin_;
  std::mutex mutex_;
  Clock::time_point drawn_;  // The last bar or line.
  bool any_ = false;
};

}  // namespace panache
