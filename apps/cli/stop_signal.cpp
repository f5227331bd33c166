#include "stop_signal.h"

#include <csignal>

namespace panache::cli {
namespace {

volatile std::sig_atomic_t asked = 0;

}  // namespace

void watch_stop_signals() {
  struct sigaction action {};
  action.sa_handler = [](int) { asked = 1; };
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  // Without SA_RESTART, so that a wait ends at once.
  ::sigaction(SIGINT, &action, nullptr);
  ::sigaction(SIGTERM, &action, nullptr);
}

bool stop_asked() { return asked != 0; }

}  // namespace panache::cli
