#include "style/stylizer_options.h"

#include <string>

#include "style/stages/gesture_player.h"

namespace panache {

Result<void> check(const StylizerOptions& options) {
  for (const float seconds : {options.ease_seconds, options.smoothing_seconds}) {
    if (!(seconds >= 0 && seconds <= 10)) {
      return Error{"stylizer option of " + std::to_string(seconds) +
                   " seconds; expected 0 to 10 seconds"};
    }
  }
  if (!(options.max_speed > 0)) {
    return Error{"max_speed of " + std::to_string(options.max_speed) +
                 " m/s; expected more than 0"};
  }
  if (!(options.gesture_rate >= 0 && options.gesture_rate <= GesturePlayer::kMaxRate)) {
    return Error{"gesture rate of " + std::to_string(options.gesture_rate) +
                 " per second; expected 0 to 10"};
  }
  return {};
}

}  // namespace panache
