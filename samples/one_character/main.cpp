// One character, one style, sixty frames a second.

#include <cstdio>
#include <cstdlib>
#include <memory>

#include "../common/stick_figure.h"

namespace {

// What _create gives goes to _destroy, whatever happens in between.
template <auto kDestroy>
struct Destroy {
  template <class T>
  void operator()(T* object) const {
    kDestroy(object);
  }
};
using Model = std::unique_ptr<panache_model, Destroy<panache_model_destroy>>;
using Skeleton = std::unique_ptr<panache_skeleton, Destroy<panache_skeleton_destroy>>;
using Character = std::unique_ptr<panache_character, Destroy<panache_character_destroy>>;

[[noreturn]] void give_up(const char* what) {
  std::fprintf(stderr, "%s: %s\n", what, panache_last_error());
  std::exit(1);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: one_character MODEL STYLE\n");
    return 2;
  }
  const Model model(stick_load_model(argv[1]));
  const int style = panache_model_find_style(model.get(), argv[2]);
  if (style < 0) {
    std::fprintf(stderr, "the model has no style '%s'\n", argv[2]);
    return 1;
  }
  panache_skeleton* rig = nullptr;
  if (panache_skeleton_create(stick_figure, STICK_JOINTS, nullptr, &rig)) give_up("skeleton");
  const Skeleton skeleton(rig);
  panache_character* created = nullptr;
  if (panache_character_create(model.get(), skeleton.get(), nullptr, &created))
    give_up("character");
  const Character character(created);

  panache_character_set_strength(character.get(), style, 1);
  std::printf("seconds  head ahead of the hips, cm: as it walks  as '%s'\n", argv[2]);
  constexpr int kFps = 60;
  for (int frame = 0; frame <= 3 * kFps; ++frame) {
    stick_pose in, out;
    stick_walk(static_cast<double>(frame) / kFps, 0, &in);
    panache_character_step(character.get(), stick_input(&in), 1.0 / kFps, stick_output(&out));
    if (frame % (kFps / 2)) continue;
    float hips[3], head[3], new_hips[3], new_head[3];
    stick_place(&in, 0, hips), stick_place(&in, 4, head);
    stick_place(&out, 0, new_hips), stick_place(&out, 4, new_head);
    std::printf("%7.1f  %41.1f  %8.1f\n", static_cast<double>(frame) / kFps,
                100.0 * (head[2] - hips[2]), 100.0 * (new_head[2] - new_hips[2]));
  }
}
