// long_run MODEL FRAMES [SEED]: so many live frames through the C interface: walks, runs, pauses,
// leaps, cuts, frames that come late or twice, and changes of style. Ends with 1 and a message
// where
// - a character without a style does not return its input, bit for bit,
// - a styled pose is not finite, or a rotation of it no unit quaternion,
// - a character restored from another at a random moment does not go on with its bits,
// - a step allocates, or the process grows.

#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <random>
#include <vector>

#include "../../samples/common/stick_figure.h"
#include "../count_allocations.h"

namespace {

using panache::test::allocations;

constexpr int64_t kWarmUp = 2000;  // Frames after which nothing may grow any more.

class Failure {};

void require(bool good, const char* what, int64_t frame) {
  if (good) return;
  std::fprintf(stderr, "long_run: frame %" PRId64 ": %s\n", frame, what);
  throw Failure();
}

// A figure whose motion changes every few seconds.
class Actor {
 public:
  explicit Actor(unsigned seed) : random_(seed) {}

  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  bool once_in(double frames) { return uniform(0, frames) < 1; }

  // Seconds until the next frame.
  double step() {
    if (once_in(300)) speed_ = once_in(3) ? 0 : uniform(0.2, 3);  // A pause, or up to a run.
    if (once_in(500) && !(leap_ > 0)) leap_ = kLeap;
    double seconds = 1.0 / 60;
    if (once_in(200)) seconds = once_in(2) ? 0 : uniform(0, 0.4);
    phase_ += speed_ * seconds;
    stick_walk(phase_, 0, &pose_);
    distance_ += 1.2 * speed_ * seconds;
    if (once_in(5000)) distance_ = 0;  // A cut.
    pose_.translations[0][2] = static_cast<float>(distance_);
    if (leap_ > 0) {  // A flight of half a second: 9.81 / 2 * t * (T - t).
      pose_.translations[0][1] += static_cast<float>(4.9 * leap_ * (kLeap - leap_));
      leap_ -= seconds;
    }
    return seconds;
  }
  const stick_pose& pose() const { return pose_; }

 private:
  static constexpr double kLeap = 0.5;
  std::mt19937 random_;
  stick_pose pose_{};
  double speed_ = 1, phase_ = 0, distance_ = 0, leap_ = 0;
};

void require_sound(const stick_pose& pose, int64_t frame) {
  for (int j = 0; j < STICK_JOINTS; ++j) {
    float length = 0;
    for (const float n : pose.rotations[j]) length += n * n;
    require(std::abs(length - 1) < 1e-3f, "a rotation is not a unit quaternion", frame);
    for (const float n : pose.translations[j]) require(std::isfinite(n), "not finite", frame);
  }
}

bool same_bits(const stick_pose& a, const stick_pose& b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

[[maybe_unused]] long resident_pages() {
  long size = 0, resident = 0;
  FILE* file = std::fopen("/proc/self/statm", "r");
  if (file) {
    if (std::fscanf(file, "%ld %ld", &size, &resident) != 2) resident = 0;
    std::fclose(file);
  }
  return resident;
}

panache_character* make_character(const panache_model* model, const panache_skeleton* skeleton,
                                  const panache_character_options& options) {
  panache_character* character = nullptr;
  if (panache_character_create(model, skeleton, &options, &character) == PANACHE_OK) {
    return character;
  }
  std::fprintf(stderr, "long_run: %s\n", panache_last_error());
  throw Failure();
}

void run(panache_model* model, int64_t frames, unsigned seed) {
  panache_skeleton* skeleton = nullptr;
  require(panache_skeleton_create(stick_figure, STICK_JOINTS, nullptr, &skeleton) == PANACHE_OK,
          "no skeleton", 0);
  panache_character_options options = PANACHE_CHARACTER_OPTIONS;
  panache_character* const neutral = make_character(model, skeleton, options);
  options.max_lag = 1.5;
  options.max_lead = 0.1;
  options.skip_cycles = 1;
  panache_character* const styled = make_character(model, skeleton, options);
  panache_character* const twin = make_character(model, skeleton, options);
  std::vector<char> state(panache_character_state_size(styled));

  Actor actor(seed);
  const int styles = panache_model_style_count(model);
  std::vector<float> strengths(static_cast<size_t>(styles));
  int64_t twin_until = 0, restored = 0, changes = 0;
  long counted = 0;
  [[maybe_unused]] long pages = 0;
  stick_pose out, other;
  for (int64_t f = 0; f < frames; ++f) {
    if (f == kWarmUp) {
      pages = resident_pages();
      counted = allocations;
    }
    if (actor.once_in(120)) {
      const int style = static_cast<int>(actor.uniform(0, styles - 1e-9));
      const float strength = actor.once_in(2) ? 0 : static_cast<float>(actor.uniform(-1, 2));
      strengths[static_cast<size_t>(style)] = strength;
      panache_character_set_strength(styled, style, strength);
      panache_character_set_strength(twin, style, strength);
      ++changes;
    }
    if (actor.once_in(20000)) {
      panache_character_reset(styled);
      panache_character_reset(twin);
    }
    if (f >= twin_until && actor.once_in(300)) {
      panache_character_save(styled, state.data());
      require(panache_character_restore(twin, state.data(), state.size()) == PANACHE_OK,
              "a saved state is not taken", f);
      twin_until = f + static_cast<int64_t>(actor.uniform(1, 600));
      ++restored;
    }
    const double seconds = actor.step();
    panache_character_step(neutral, stick_input(&actor.pose()), seconds, stick_output(&out));
    require(same_bits(out, actor.pose()), "the input is not returned without a style", f);
    panache_character_step(styled, stick_input(&actor.pose()), seconds, stick_output(&out));
    require_sound(out, f);
    if (f < twin_until) {
      panache_character_step(twin, stick_input(&actor.pose()), seconds, stick_output(&other));
      require(same_bits(out, other), "a restored character goes on otherwise", f);
    }
  }
  if (frames > kWarmUp) {
    require(allocations == counted, "steps allocate", frames);
#ifndef PANACHE_SANITIZED  // It keeps what is freed for a while.
    require(resident_pages() - pages <= 64, "the process has grown by more than 256 KB", frames);
#endif
  }
  std::printf("%" PRId64 " frames (%.2f hours at 60 a second), seed %u: %" PRId64
              " changes of style, %" PRId64 " states restored\n",
              frames, static_cast<double>(frames) / 60 / 3600, seed, changes, restored);
  panache_character_destroy(twin);
  panache_character_destroy(styled);
  panache_character_destroy(neutral);
  panache_skeleton_destroy(skeleton);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3 && argc != 4) {
    return std::fputs("usage: long_run MODEL FRAMES [SEED]\n", stderr), 2;
  }
  panache_model* model = stick_load_model(argv[1]);
  int failed = 0;
  try {
    run(model, std::atoll(argv[2]), argc == 4 ? static_cast<unsigned>(std::atoi(argv[3])) : 1u);
  } catch (const Failure&) {
    failed = 1;
  }
  panache_model_destroy(model);
  return failed;
}
