// onnx_windows MODEL FOLDER COUNT [MANIFEST...]: writes into FOLDER, as raw float32, COUNT windows
// of the motion of the manifests (of the walker, where there are none), strengths for each, and
// what the library answers: windows, strengths, changes (or poses), log_rates, contacts and gate.
// Prints what the windows are of.

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "base/random.h"
#include "learn/samples.h"
#include "style/networks/networks.h"
#include "takes/load_takes.h"
#include "takes/manifest.h"
#include "walker/walker.h"

using namespace panache;

namespace {

constexpr size_t kTakes = 400;  // Of all manifests, evenly.
constexpr uint64_t kSeed = 20240117;

template <class T>
T must(Result<T> result) {
  if (result) return *std::move(result);
  std::fprintf(stderr, "onnx_windows: %s\n", result.error().message.c_str());
  std::exit(1);
}

std::vector<Take> walker_takes(PoseLayout layout) {
  const auto model = must(WalkerModel::load(PANACHE_SOURCE_DIR "/models/walker.safetensors"));
  std::vector<Take> takes;
  for (const float speed : {0.0f, 0.7f, 1.4f, 2.2f, 3.0f}) {
    for (const float turn : {-0.4f, 0.0f, 0.3f}) {
      WalkClipOptions options;
      options.seconds = 30;
      options.speed = speed;
      options.turn = turn;
      const Clip clip = walk_clip(model, options);
      takes.push_back(make_take(clip, must(Rig::create(clip)), layout));
    }
  }
  return takes;
}

std::vector<Take> takes_of(const std::vector<std::string>& manifests, PoseLayout layout) {
  if (manifests.empty()) return walker_takes(layout);
  std::vector<ManifestRow> all, some;
  for (const std::string& manifest : manifests) {
    const auto rows = must(read_manifest(manifest, next_set(all)));
    all.insert(all.end(), rows.begin(), rows.end());
  }
  const size_t step = std::max<size_t>(1, all.size() / kTakes);
  for (size_t i = 0; i < all.size(); i += step) some.push_back(all[i]);
  return must(load_takes(some, layout));
}

// None, one as captured, or a few of any strength.
std::vector<float> random_strengths(size_t styles, Random& random) {
  std::vector<float> out(styles);
  const auto any = [&] { return out.begin() + static_cast<long>(random.uniform() * styles); };
  const float kind = random.uniform();
  if (kind < 0.1f) return out;
  if (kind < 0.5f) {
    *any() = 1;
    return out;
  }
  for (int i = 0; i < 3; ++i) *any() = 8 * random.uniform() - 4;
  return out;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) return 2;
  const auto model = must(Model::load(argv[1]));
  const std::vector<Take> takes = takes_of({argv + 4, argv + argc}, model->layout());
  const auto count = static_cast<size_t>(std::atol(argv[3]));
  const bool heads = model->recipe().style_heads;
  const int numbers = pose_feature_count(model->layout());
  const auto file = [&](const char* name) {
    return std::ofstream(std::string(argv[2]) + "/" + name, std::ios::binary);
  };
  std::ofstream windows = file("windows"), strengths = file("strengths"),
                pose = file(heads ? "changes" : "poses"), log_rates = file("log_rates"),
                contacts = file("contacts"), gate;
  if (heads) gate = file("gate");
  const auto write = [](std::ofstream& out, std::span<const float> values) {
    out.write(reinterpret_cast<const char*>(values.data()),
              static_cast<std::streamsize>(values.size_bytes()));
  };
  StyleNetworks networks(model);
  Random random(kSeed);
  std::vector<float> window(static_cast<size_t>(kWindowPoses * numbers));
  double shut = 0;
  for (size_t i = 0; i < count; ++i) {
    const Take& take = takes[i % takes.size()];
    take_window(take, random.uniform() * static_cast<float>(take.frames() - 1), numbers, window);
    const std::vector<float> wanted = random_strengths(model->styles().size(), random);
    networks.set_strengths(wanted);
    networks.forward(window);
    const float rate = networks.log_rate(), open = networks.gate();
    shut += open < 0.99f;
    write(windows, window), write(strengths, wanted), write(pose, networks.pose());
    write(log_rates, {&rate, 1}), write(contacts, networks.contact());
    if (heads) write(gate, {&open, 1});
  }
  std::printf("%zu windows of %zu takes of %s, seed %llu; the gate is not fully open on %.1f %%\n",
              count, takes.size(), argc > 4 ? "real motion" : "the walker",
              static_cast<unsigned long long>(kSeed), 100 * shut / static_cast<double>(count));
}
