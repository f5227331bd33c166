// Two threads, two characters of one model and one skeleton, a style learnt in each, by further
// threads, and calls in any order: the thread sanitizer watches.

#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "../fuzz/character_calls.h"
#include "panache/panache.h"
#include "stick_figure.h"

namespace {

constexpr int kFrames = 300;

// Steps a character of his own and, every other frame, a crowd of two; makes errors, too.
std::vector<stick_pose> animate(const panache_model* model, const panache_skeleton* skeleton,
                                int style) {
  panache_character_options timed = PANACHE_CHARACTER_OPTIONS;
  timed.max_lag = 0.5;
  timed.max_lead = 0.1;
  panache_character* pair[2] = {};
  panache_character_create(model, skeleton, nullptr, &pair[0]);
  panache_character_create(model, skeleton, &timed, &pair[1]);
  for (panache_character* one : pair) panache_character_set_strength(one, style, 1);
  std::vector<stick_pose> out(2 * kFrames);
  for (int f = 0; f < kFrames; ++f) {
    stick_pose in;
    stick_walk(f / 60.0, style, &in);
    const panache_input_pose from[] = {stick_input(&in), stick_input(&in)};
    const panache_output_pose to[] = {stick_output(&out[2 * f]), stick_output(&out[2 * f + 1])};
    if (f % 2 == 0) {
      panache_step_many(pair, 2, from, 1 / 60.0, to);
    } else {
      for (int i = 0; i < 2; ++i) panache_character_step(pair[i], from[i], 1 / 60.0, to[i]);
    }
    panache_model* none = nullptr;
    if (f % 50 == 0) panache_model_create("no model", 8, &none);
  }
  for (panache_character* one : pair) panache_character_destroy(one);
  return out;
}

// The bytes of the model with a style learnt from a walk and the same walk bent forward by `angle`.
std::string learn(const std::string& model, const panache_skeleton* skeleton, float angle) {
  constexpr int kWalkFrames = 180;
  std::vector<float> neutral, bent, translations;
  for (int f = 0; f < kWalkFrames; ++f) {
    stick_pose pose;
    stick_walk(f / 60.0, 0, &pose);
    const panache_input_pose in = stick_input(&pose);
    neutral.insert(neutral.end(), in.rotations, in.rotations + 4 * STICK_JOINTS);
    translations.insert(translations.end(), in.translations, in.translations + 3 * STICK_JOINTS);
    stick_bend(&pose, 1, angle);
    bent.insert(bent.end(), in.rotations, in.rotations + 4 * STICK_JOINTS);
  }
  const panache_pair pair = {{skeleton, kWalkFrames, 1 / 60.0, neutral.data(), translations.data()},
                             {skeleton, kWalkFrames, 1 / 60.0, bent.data(), translations.data()}};
  panache_learnt* learnt = nullptr;
  if (panache_learn(model.data(), model.size(), &pair, 1, "bent", 0, &learnt) != PANACHE_OK) {
    std::fprintf(stderr, "%s\n", panache_last_error());
    return "";
  }
  size_t size = 0;
  const void* bytes = panache_learnt_model(learnt, &size);
  std::string out(static_cast<const char*>(bytes), size);
  panache_learnt_destroy(learnt);
  return out;
}

bool same(const std::vector<stick_pose>& a, const std::vector<stick_pose>& b) {
  return std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0;
}

// Random numbers by the names of libFuzzer's FuzzedDataProvider.
class RandomData {
 public:
  explicit RandomData(unsigned seed) : random_(seed) {}

  size_t remaining_bytes() const { return 1; }  // They never end.
  bool ConsumeBool() { return random_() % 2; }
  template <class T>
  T ConsumeIntegral() {
    return static_cast<T>(random_());
  }
  template <class T>
  T ConsumeIntegralInRange(T low, T high) {
    return low + static_cast<T>(random_() % (static_cast<size_t>(high - low) + 1));
  }
  template <class T, size_t n>
  T PickValueInArray(const T (&values)[n]) {
    return values[random_() % n];
  }
  std::string ConsumeRandomLengthString(size_t max) {
    std::string out(random_() % (max + 1), '\0');
    for (char& c : out) c = ConsumeIntegral<char>();
    return out;
  }

 private:
  std::mt19937 random_;
};

// Whether characters that are called in any order, each in a thread, move as they do alone.
bool any_order_is_alone(const panache_model* model, const panache_skeleton* skeleton) {
  constexpr unsigned kRounds = 100, kCharacters = 3;
  const auto call = [&](unsigned seed) {
    RandomData data(seed);
    return panache::fuzz::call_in_any_order(model, skeleton, data);
  };
  for (unsigned round = 0; round < kRounds; ++round) {
    uint64_t beside[kCharacters] = {};
    std::vector<std::thread> threads;
    for (unsigned i = 0; i < kCharacters; ++i) {
      threads.emplace_back([&, i] { beside[i] = call(kCharacters * round + i); });
    }
    for (std::thread& thread : threads) thread.join();
    for (unsigned i = 0; i < kCharacters; ++i) {
      if (beside[i] != call(kCharacters * round + i)) return false;
    }
  }
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return std::fputs("usage: test_threads MODEL\n", stderr), 2;
  std::ifstream file(argv[1], std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  panache_model* model = nullptr;
  panache_skeleton* skeleton = nullptr;
  if (panache_model_create(bytes.data(), bytes.size(), &model) != PANACHE_OK ||
      panache_skeleton_create(stick_figure, STICK_JOINTS, nullptr, &skeleton) != PANACHE_OK) {
    return std::fprintf(stderr, "%s\n", panache_last_error()), 1;
  }
  std::vector<stick_pose> first, second;
  std::string learnt, learnt_too;
  std::thread a([&] {
    first = animate(model, skeleton, 0);
    learnt = learn(bytes, skeleton, 0.4f);
  });
  std::thread b([&] {
    second = animate(model, skeleton, 1);
    learnt_too = learn(bytes, skeleton, 0.2f);
  });
  a.join();
  b.join();
  const bool alone =
      same(first, animate(model, skeleton, 0)) && same(second, animate(model, skeleton, 1));
  const bool learnt_alone = !learnt.empty() && learnt != learnt_too &&
                            learnt == learn(bytes, skeleton, 0.4f) &&
                            learnt_too == learn(bytes, skeleton, 0.2f);
  const bool in_any_order = any_order_is_alone(model, skeleton);
  panache_skeleton_destroy(skeleton);
  panache_model_destroy(model);
  if (!in_any_order) {
    return std::fputs("called in any order beside each other they move otherwise than alone\n",
                      stderr),
           1;
  }
  if (!alone) return std::fputs("beside each other they move otherwise than alone\n", stderr), 1;
  if (!learnt_alone)
    return std::fputs("beside each other they learn otherwise than alone\n", stderr), 1;
  return 0;
}
