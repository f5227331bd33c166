// A character of the C interface: calls in any order, poses and times of any bits.

#include <cmath>
#include <cstring>
#include <limits>

#include <fuzzer/FuzzedDataProvider.h>

#include "../../samples/common/stick_figure.h"
#include "use_motion.h"

namespace {

// Any number, the odd ones often.
float any_number(FuzzedDataProvider& data) {
  constexpr float kOdd[] = {0,
                            -0.0f,
                            1,
                            std::numeric_limits<float>::infinity(),
                            -std::numeric_limits<float>::infinity(),
                            std::numeric_limits<float>::quiet_NaN(),
                            std::numeric_limits<float>::denorm_min(),
                            std::numeric_limits<float>::max(),
                            -std::numeric_limits<float>::max(),
                            1e9f,
                            -1e-9f};
  if (data.ConsumeBool()) return data.PickValueInArray(kOdd);
  const auto bits = data.ConsumeIntegral<uint32_t>();
  float number;
  std::memcpy(&number, &bits, sizeof number);
  return number;
}

void check(bool good, const char* what) {
  if (!good) panache::fuzz::fail(what);
}

bool is_finite(const stick_pose& pose) {
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

struct Stage {
  panache_model* model = nullptr;
  panache_skeleton* skeleton = nullptr;
  Stage() {
    const std::string bytes =
        panache::format_safetensors(panache::test::make_model({"old", "proud"}));
    check(panache_model_create(bytes.data(), bytes.size(), &model) == PANACHE_OK, "no model");
    check(panache_skeleton_create(stick_figure, STICK_JOINTS, nullptr, &skeleton) == PANACHE_OK,
          "no skeleton");
  }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
  static const Stage stage;
  FuzzedDataProvider data(bytes, size);
  panache_character_options options = PANACHE_CHARACTER_OPTIONS;
  if (data.ConsumeBool()) options.ease_seconds = any_number(data);
  if (data.ConsumeBool()) options.smoothing_seconds = any_number(data);
  options.hold_feet = data.ConsumeBool();
  options.style_root = data.ConsumeBool();
  panache_character* character = nullptr;
  if (panache_character_create(stage.model, stage.skeleton, &options, &character) != PANACHE_OK) {
    check(panache_last_error()[0] != '\0', "an error without a message");
    return 0;
  }
  std::string saved;
  double seconds = 0;
  stick_pose in, out;
  stick_walk(0, 0, &in);
  for (int call = 0; call < 100 && data.remaining_bytes() > 0; ++call) {
    switch (data.ConsumeIntegralInRange(0, 8)) {
      case 0: {  // A hostile pose.
        float* numbers = data.ConsumeBool() ? &in.rotations[0][0] : &in.translations[0][0];
        const int most = numbers == &in.rotations[0][0] ? 4 * STICK_JOINTS : 3 * STICK_JOINTS;
        const int changes = data.ConsumeIntegralInRange(1, 6);
        for (int i = 0; i < changes; ++i) {
          numbers[data.ConsumeIntegralInRange(0, most - 1)] = any_number(data);
        }
        break;
      }
      case 1:
        stick_walk(seconds, 0, &in);
        break;
      case 2:
        panache_character_set_strength(character, data.ConsumeIntegralInRange(0, 1),
                                       any_number(data));
        break;
      case 3:
        panache_character_reset(character);
        break;
      case 4:
        saved.resize(panache_character_state_size(character));
        panache_character_save(character, saved.data());
        break;
      case 5: {  // A state that was saved, or one that was changed on the way.
        std::string state = saved;
        if (data.ConsumeBool() && !state.empty()) {
          state[data.ConsumeIntegralInRange<size_t>(0, state.size() - 1)] =
              data.ConsumeIntegral<char>();
        }
        if (data.ConsumeBool()) state = data.ConsumeRandomLengthString(64);
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
        seconds += 1 / 60.0;
      }
    }
  }
  panache_character_destroy(character);
  return 0;
}
