// One step of one character, from the user's pose to the user's pose, with a shipped model.

#include <benchmark/benchmark.h>

#include "clip/motion_file.h"
#include "style/stylizer.h"

#include "../tests/make_clip.h"

namespace {

using namespace panache;

void step(benchmark::State& state, const char* path) {
  const auto model = Model::load(std::string(PANACHE_SOURCE_DIR "/models/") + path);
  if (!model) {
    state.SkipWithError(model.error().message.c_str());
    return;
  }
  const Clip clip = test::walking_clip(120, 60);
  Stylizer stylizer = *Stylizer::create(*model, *Rig::create(clip));
  Clip out = clip;
  std::vector<float> strengths((*model)->styles().size());
  strengths[0] = 1;
  int frame = 0;
  for (auto _ : state) {
    stylizer.step(clip.pose(frame), strengths, clip.frame_time, out.pose(frame));
    frame = (frame + 1) % clip.frames;
  }
}
BENCHMARK_CAPTURE(step, panache, "panache.safetensors")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(step, smith2019, "smith2019.safetensors")->Unit(benchmark::kMicrosecond);

}  // namespace

BENCHMARK_MAIN();
