#pragma once
// A character of the C interface: calls in any order, poses and times of any bits.

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <thread>

#include "../../samples/common/stick_figure.h"
#include "any_number.h"

namespace panache::fuzz {

inline void check(bool good, const char* what) {
  if (good) return;
  std::fprintf(stderr, "fuzz: %s\n", what);
  std::abort();
}

inline bool is_finite(const stick_pose& pose) {
  for (int j = 0; j < STICK_JOINTS; ++j) {
    for (const float n : pose.rotations[j]) {
      if (!std::isfinite(n)) return false;
    }
    for (const float n : pose.translations[j]) {
      if (!std::isfinite(n)) return false;
    }
  }
  return true;
}

// Changes a few numbers of a pose to any others.
template <class Data>
void spoil(stick_pose& pose, Data& data) {
  float* numbers = data.ConsumeBool() ? &pose.rotations[0][0] : &pose.translations[0][0];
  const int max = numbers == &pose.rotations[0][0] ? 4 * STICK_JOINTS : 3 * STICK_JOINTS;
  const int changes = data.ConsumeIntegralInRange(1, 6);
  for (int i = 0; i < changes; ++i) {
    numbers[data.ConsumeIntegralInRange(0, max - 1)] = any_number(data);
  }
}

// A state that was saved, or one that was changed on the way.
template <class Data>
std::string any_state(std::string saved, Data& data) {
  if (data.ConsumeBool() && !saved.empty()) {
    saved[data.ConsumeIntegralInRange(size_t{0}, saved.size() - 1)] =
        data.template ConsumeIntegral<char>();
  }
  if (data.ConsumeBool()) saved = data.ConsumeRandomLengthString(64);
  return saved;
}

// What all poses come to that a character gives; `data`, a FuzzedDataProvider or what has its
// names, says which calls are made. Ends the program where a pose is not finite.
template <class Data>
uint64_t call_in_any_order(const panache_model* model, const panache_skeleton* skeleton,
                           Data& data) {
  panache_character_options options = PANACHE_CHARACTER_OPTIONS;
  if (data.ConsumeBool()) options.ease_seconds = any_number(data);
  if (data.ConsumeBool()) options.smoothing_seconds = any_number(data);
  options.hold_feet = data.ConsumeBool();
  options.style_root = data.ConsumeBool();
  panache_character* character = nullptr;
  if (panache_character_create(model, skeleton, &options, &character) != PANACHE_OK) {
    check(panache_last_error()[0] != '\0', "an error without a message");
    return 0;
  }
  uint64_t sum = 14695981039346656037u;  // FNV-1a.
  std::string saved;
  double seconds = 0;
  stick_pose in, out;
  stick_walk(0, 0, &in);
  for (int call = 0; call < 100 && data.remaining_bytes() > 0; ++call) {
    if (call == 20) std::this_thread::yield();  // So that others come in between, on one core too.
    switch (data.ConsumeIntegralInRange(0, 8)) {
      case 0:
        spoil(in, data);
        break;
      case 1:
        stick_walk(seconds, 0, &in);
        break;
      case 2: {
        const int style = data.ConsumeIntegralInRange(0, 1);
        panache_character_set_strength(character, style, any_number(data));
        break;
      }
      case 3:
        panache_character_reset(character);
        break;
      case 4:
        saved.resize(panache_character_state_size(character));
        panache_character_save(character, saved.data());
        break;
      case 5: {
        const std::string state = any_state(saved, data);
        static_cast<void>(panache_character_restore(character, state.data(), state.size()));
        break;
      }
      case 6: {
        panache_shape shape = PANACHE_SHAPE;
        shape.posture = any_number(data);
        shape.left_arm = any_number(data);
        static_cast<void>(panache_character_set_shape(character, &shape));
        break;
      }
      default: {
        const double step = data.ConsumeBool() ? 1 / 60.0 : static_cast<double>(any_number(data));
        panache_character_step(character, stick_input(&in), step, stick_output(&out));
        check(is_finite(out), "a pose that is not finite");
        const auto* bytes = reinterpret_cast<const unsigned char*>(&out);
        for (size_t i = 0; i < sizeof out; ++i) sum = (sum ^ bytes[i]) * 1099511628211u;
        seconds += 1 / 60.0;
      }
    }
  }
  panache_character_destroy(character);
  return sum;
}

}  // namespace panache::fuzz
