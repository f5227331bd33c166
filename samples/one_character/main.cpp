// One character, one style, sixty frames a second.

#include <cstdio>
#include <exception>
#include <fstream>
#include <iterator>
#include <panache/panache.hpp>
#include <stdexcept>
#include <string>

#include "../common/stick_figure.h"

namespace {

panache::Model load_model(const char* path) {
  std::ifstream file(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  if (bytes.empty()) throw std::runtime_error(std::string(path) + ": cannot be read");
  return panache::Model(bytes.data(), bytes.size());
}

void walk(const char* model_path, const char* style) {
  const panache::Model model = load_model(model_path);
  const panache::Skeleton skeleton(stick_figure, STICK_JOINTS);
  panache::Character character(model, skeleton);
  character.set_strength(model.find_style(style), 1);

  std::printf("seconds  head ahead of the hips, cm: as it walks  as '%s'\n", style);
  constexpr int kFps = 60;
  for (int frame = 0; frame <= 3 * kFps; ++frame) {
    stick_pose in, out;
    stick_walk(static_cast<double>(frame) / kFps, 0, &in);
    character.step(stick_input(&in), 1.0 / kFps, stick_output(&out));
    if (frame % (kFps / 2)) continue;
    float hips[3], head[3], new_hips[3], new_head[3];
    stick_position(&in, 0, hips), stick_position(&in, 4, head);
    stick_position(&out, 0, new_hips), stick_position(&out, 4, new_head);
    std::printf("%7.1f  %41.1f  %8.1f\n", static_cast<double>(frame) / kFps,
                100.0 * (head[2] - hips[2]), 100.0 * (new_head[2] - new_hips[2]));
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: one_character MODEL STYLE\n");
    return 2;
  }
  try {
    walk(argv[1], argv[2]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
