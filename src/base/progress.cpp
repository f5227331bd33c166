#include "base/progress.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/os/os.h"

namespace panache {
namespace {

std::string clock_text(double seconds) {
  char text[32];
  // A first estimate may not fit a long; a hundred hours are enough.
  const long whole = std::lround(std::min(seconds, 360'000.0));
  std::snprintf(text, sizeof text, "%ld:%02ld", whole / 60, whole % 60);
  return text;
}

}  // namespace

Progress::Progress(std::string title, Clock::duration every)
    : title_(std::move(title)),
      is_bar_(is_terminal_stderr()),
      every_(every),
      begin_(Clock::now()),
      drawn_(begin_) {}

Progress::~Progress() {
  if (any_) std::fputc('\n', stderr);
}

void Progress::update(double share, const std::string& text) {
  const std::lock_guard lock(mutex_);
  const Clock::time_point now = Clock::now();
  const double spent = std::chrono::duration<double>(now - begin_).count();
  share = std::clamp(share, 0.0, 1.0);
  const double left = share > 0 ? spent * (1 - share) / share : 0;
  if (!is_bar_) {
    if (now - drawn_ < every_ || share == 1) return;
    drawn_ = now;
    std::fprintf(stderr, "%s: %.0f %%, %s left%s%s\n", title_.c_str(), share * 100,
                 clock_text(left).c_str(), text.empty() ? "" : ", ", text.c_str());
    return;
  }
  // Work of under a second needs no bar, and ten updates a second are enough.
  if (!any_ && (spent < 1 || share == 1)) return;
  if (any_ && share < 1 && now - drawn_ < std::chrono::milliseconds(100)) return;
  any_ = true;
  drawn_ = now;
  constexpr int kWidth = 30;
  const int full = static_cast<int>(share * kWidth);
  std::fprintf(stderr, "\r\033[K%s [%s%s] %3.0f %%  %s left  %s", title_.c_str(),
               std::string(full, '#').c_str(), std::string(kWidth - full, '.').c_str(), share * 100,
               clock_text(left).c_str(), text.c_str());
  std::fflush(stderr);
}

}  // namespace panache
