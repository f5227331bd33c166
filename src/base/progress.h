#pragma once
// The time that long work takes, and its progress: a bar on stderr, or occasional log lines if
// that is not a terminal.

#include <chrono>
#include <mutex>
#include <string>

namespace panache {

class Stopwatch {
 public:
  // Since construction.
  double seconds() const { return std::chrono::duration<double>(Clock::now() - begin_).count(); }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point begin_ = Clock::now();
};

class Progress {
 public:
  using Clock = std::chrono::steady_clock;
  // `every`: the time between two log lines.
  explicit Progress(std::string title, Clock::duration every = std::chrono::seconds(30));
  ~Progress();  // Leaves the finished bar standing, on a line of its own.
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // Shows that `share` (0 to 1) of the work is done, with the remaining time and then `text`. Can
  // be called from any thread, any number of times.
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
