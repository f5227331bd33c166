// One step from the user's pose to the user's pose with a shipped model: of one character with one
// style or several in force, of its networks alone, and of a crowd.

#include <benchmark/benchmark.h>

#include "clip/motion_file.h"
#include "style/crowd.h"
#include "style/networks.h"

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
  const int styles = static_cast<int>(state.range(0));
  std::vector<float> strengths((*model)->styles().size());
  for (int i = 0; i < styles; ++i) strengths[size_t(i)] = 1 / static_cast<float>(styles);
  int frame = 0;
  for (auto _ : state) {
    stylizer.step(clip.pose(frame), strengths, clip.frame_time, out.pose(frame));
    frame = (frame + 1) % clip.frames;
  }
}
BENCHMARK_CAPTURE(step, panache, "panache.safetensors")
    ->Arg(1)
    ->Arg(2)
    ->Arg(5)
    ->Arg(10)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(step, panache_int8, "panache-int8.safetensors")
    ->Arg(1)
    ->Arg(2)
    ->Arg(5)
    ->Arg(10)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(step, smith2019, "smith2019.safetensors")->Arg(1)->Unit(benchmark::kMicrosecond);

// The forward pass of its networks alone.
void networks(benchmark::State& state, const char* path) {
  const auto model = Model::load(std::string(PANACHE_SOURCE_DIR "/models/") + path);
  if (!model) {
    state.SkipWithError(model.error().message.c_str());
    return;
  }
  StyleNetworks one(*model);
  std::vector<float> strengths((*model)->styles().size());
  strengths[0] = 1;
  one.set_strengths(strengths);
  const std::vector<float> window(kWindowPoses * pose_feature_count((*model)->layout()), 0.3f);
  for (auto _ : state) {
    one.forward(window);
    benchmark::DoNotOptimize(one.pose().data());
  }
}
BENCHMARK_CAPTURE(networks, panache, "panache.safetensors")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(networks, panache_int8, "panache-int8.safetensors")
    ->Unit(benchmark::kMicrosecond);

// Each with a style and a place in the walk of its own; the time is that of all, the rate is
// characters a second.
void crowd(benchmark::State& state, const char* path) {
  const auto model = Model::load(std::string(PANACHE_SOURCE_DIR "/models/") + path);
  if (!model) {
    state.SkipWithError(model.error().message.c_str());
    return;
  }
  const Clip clip = test::walking_clip(120, 60);
  const Rig rig = *Rig::create(clip);
  const size_t count = static_cast<size_t>(state.range(0));
  const size_t styles = (*model)->styles().size();
  std::vector<Stylizer> characters;
  std::vector<Clip> outs(count);
  std::vector<std::vector<float>> strengths(count, std::vector<float>(styles));
  for (size_t i = 0; i < count; ++i) {
    characters.push_back(*Stylizer::create(*model, rig));
    strengths[i][i % styles] = 1;
    outs[i].skeleton = clip.skeleton;
    outs[i].frames = 1;
    outs[i].rotations.resize(clip.joints());
    outs[i].translations.resize(clip.joints());
  }
  std::vector<CrowdMember> members(count);
  int frame = 0;
  for (auto _ : state) {
    for (size_t i = 0; i < count; ++i) {
      const int at = (frame + static_cast<int>(7 * i)) % clip.frames;
      members[i] = {&characters[i], clip.pose(at), strengths[i], outs[i].pose(0)};
    }
    step_crowd(members, clip.frame_time);
    frame = (frame + 1) % clip.frames;
  }
  state.SetItemsProcessed(static_cast<int64_t>(state.iterations() * count));
}
BENCHMARK_CAPTURE(crowd, panache, "panache.safetensors")->Arg(1000)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(crowd, panache_int8, "panache-int8.safetensors")
    ->Arg(1000)
    ->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
