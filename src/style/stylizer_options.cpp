#include "style/stylizer_options.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "style/model/model.h"
#include "style/stages/gesture_player.h"

namespace panache {

namespace {

Result<void> check_sides(const std::vector<float>& sides, const Model& model) {
  if (sides.empty()) return {};
  if (sides.size() != model.styles().size()) {
    return Error{std::to_string(sides.size()) + " sides; expected " +
                 std::to_string(model.styles().size()) + ", one per style"};
  }
  for (size_t s = 0; s < sides.size(); ++s) {
    const std::string& name = model.styles()[s].name;
    if (!(std::abs(sides[s]) <= 1)) {
      return Error{"side of " + std::to_string(sides[s]) + " for style '" + name +
                   "'; expected -1 to 1"};
    }
    if (sides[s] == 1) continue;
    if (Result<void> good = check_has_sides(model); !good) return good.error();
  }
  return {};
}

}  // namespace

Result<void> check(const StylizerOptions& options, const Model& model) {
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
  if (!(options.gesture_rate >= 0 && options.gesture_rate <= GesturePlayer::kMaxOften)) {
    return Error{"gesture rate of " + std::to_string(options.gesture_rate) +
                 "; expected 0 to 10 times that of the takes"};
  }
  if (options.person != PersonNumbers{}) {
    if (Result<void> good = check_has_persons(model); !good) return good.error();
  }
  return check_sides(options.sides, model);
}

}  // namespace panache
