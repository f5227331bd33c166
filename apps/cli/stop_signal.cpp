#include "stop_signal.h"

#include <csignal>

#include "base/os/os.h"

namespace panache::cli {
namespace {

volatile std::sig_atomic_t stop_flag = 0;

}  // namespace

void watch_stop_signals() {
  on_stop_signal([](int) { stop_flag = 1; });
}

bool stop_asked() { return stop_flag != 0; }

}  // namespace panache::cli
