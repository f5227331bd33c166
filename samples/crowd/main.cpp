// A thousand characters share a model and a rig; each is another person and has a style of its own.

#include <chrono>
#include <cstdio>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "../common/stick_figure.h"

int main(int argc, char** argv) {
  const int count = argc > 2 ? std::atoi(argv[2]) : 1000;
  const bool with_persons = argc < 4 || std::string(argv[3]) != "clones";
  if (argc < 2 || count < 1) {
    std::fprintf(stderr, "usage: crowd MODEL [CHARACTERS [clones]]\n");
    return 2;
  }
  panache_model* model = stick_load_model(argv[1]);
  panache_skeleton* skeleton = nullptr;
  if (panache_skeleton_create(stick_figure, STICK_JOINTS, nullptr, &skeleton)) {
    std::fprintf(stderr, "skeleton: %s\n", panache_last_error());
    return 1;
  }
  std::vector<panache_character*> characters(static_cast<size_t>(count));
  std::vector<stick_pose> poses(characters.size());
  std::vector<panache_input_pose> in;
  std::vector<panache_output_pose> out;
  for (size_t i = 0; i < characters.size(); ++i) {
    if (panache_character_create(model, skeleton, nullptr, &characters[i])) {
      std::fprintf(stderr, "character: %s\n", panache_last_error());
      return 1;
    }
    const auto style = static_cast<int32_t>(i) % panache_model_style_count(model);
    panache_character_set_strength(characters[i], style, 1);
    const auto seed = static_cast<uint32_t>(i);
    if (panache_character_set_person(characters[i], seed, with_persons ? 1.0f : 0.0f)) {
      std::fprintf(stderr, "person: %s\n", panache_last_error());
      return 1;
    }
    in.push_back(stick_input(&poses[i]));
    out.push_back(stick_output(&poses[i]));  // Styled in place.
  }

  constexpr int kFrames = 60;
  double spent = 0;
  for (int frame = 0; frame < kFrames; ++frame) {
    for (size_t i = 0; i < poses.size(); ++i) {
      stick_walk(frame / 60.0, static_cast<double>(i) / count, &poses[i]);
    }
    const auto begin = std::chrono::steady_clock::now();
    panache_step_many(characters.data(), count, in.data(), 1.0 / 60, out.data());
    spent += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  }
  const double step = spent / kFrames / count;
  std::printf("%d characters: %.2f us a step, so %.0f at 60 frames a second on this core\n", count,
              1e6 * step, 1 / (60 * step));
  for (panache_character* character : characters) panache_character_destroy(character);
  panache_skeleton_destroy(skeleton);
  panache_model_destroy(model);
}
