// c_step MODEL FILE OUT: steps a character through the motion of a BVH file in style "old", twenty
// times over. Writes the last round's poses, rotations then translations of each frame, to OUT, and
// prints the median time of a step in microseconds.

#include <panache/panache.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace {

std::string read(const char* path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void check(panache_status status) {
  if (status == PANACHE_OK) return;
  std::fprintf(stderr, "c_step: %s\n", panache_last_error());
  std::exit(1);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  const std::string model_bytes = read(argv[1]), motion = read(argv[2]);
  panache_model* model;
  check(panache_model_create(model_bytes.data(), model_bytes.size(), &model));
  panache_motion_file* file;
  check(panache_motion_file_create(motion.data(), motion.size(), argv[2], &file));
  panache_skeleton* skeleton;
  check(panache_motion_file_create_skeleton(file, 0, nullptr, &skeleton));
  panache_clip clip;
  check(panache_motion_file_get_clip(file, 0, &clip));
  panache_character* character;
  check(panache_character_create(model, skeleton, nullptr, &character));
  panache_character_set_strength(character, panache_model_find_style(model, "old"), 1);

  const size_t joints = static_cast<size_t>(panache_skeleton_joint_count(skeleton));
  std::vector<float> rotations(4 * joints), translations(3 * joints);
  std::vector<double> times;
  std::ofstream out(argv[3], std::ios::binary);
  for (int round = 0; round < 20; ++round) {
    panache_character_reset(character);
    for (size_t f = 0; f < static_cast<size_t>(clip.frame_count); ++f) {
      const auto begin = std::chrono::steady_clock::now();
      panache_character_step(character,
                             {clip.rotations + f * 4 * joints, clip.translations + f * 3 * joints},
                             clip.frame_seconds, {rotations.data(), translations.data()});
      const std::chrono::duration<double, std::micro> time =
          std::chrono::steady_clock::now() - begin;
      times.push_back(time.count());
      if (round < 19) continue;
      for (const std::vector<float>* numbers : {&rotations, &translations}) {
        out.write(reinterpret_cast<const char*>(numbers->data()),
                  static_cast<std::streamsize>(numbers->size() * sizeof(float)));
      }
    }
  }
  std::nth_element(times.begin(), times.begin() + times.size() / 2, times.end());
  std::printf("%.3f\n", times[times.size() / 2]);
  panache_character_destroy(character);
  panache_skeleton_destroy(skeleton);
  panache_motion_file_destroy(file);
  panache_model_destroy(model);
}
