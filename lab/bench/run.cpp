#include "bench/run.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <type_traits>

#include "base/file.h"
#include "bench/motions.h"
#include "bench/networks.h"
#include "bench/peers.h"
#include "bench/published.h"
#include "net/dense.h"
#include "net/layer.h"
#include "net/rows.h"
#include "net/safetensors.h"

namespace panache::bench {
namespace {

// Share of the time after the networks, the steps and the crowds.
constexpr double kAfterLimits = 0.03, kAfterRace = 0.5, kAfterSteps = 0.85;
// A one-second gait cycle at 60 frames a second.
constexpr int64_t kHardShare = 10;  // Of the steps of a walk: those of each other motion.
constexpr float kPhaseStep = 1.0f / 60;

ProgressCall part_of(const ProgressCall& progress, double from, double to) {
  return [=](double share) {
    if (progress) progress(from + (to - from) * share);
  };
}

// The contestants of the race, and their data.
class Race {
 public:
  // Appends what is available to `forward_passes` and `others`, still without times.
  Result<void> prepare(Measurements& out);
  // Fills in the times.
  void run(Measurements& out, int rounds, const ProgressCall& progress);

 private:
  void add_forward_pass(Measurements& out, const std::string& key, const std::string& name,
                        std::function<void()> run);
  void add_evaluation(Measurements& out, const std::string& key,
                      std::unique_ptr<Evaluation> evaluation);
  // If `network` takes a phase, it is called with a cycling one.
  template <class Other>
  void add_other(Measurements& out, const std::string& key, const std::string& name,
                 const std::string& published, std::shared_ptr<Other> network);

  std::vector<Contestant> contestants_;
  std::vector<std::unique_ptr<Evaluation>> evaluations_;
  std::vector<float> x_ = random_numbers(1024, 1), y_ = std::vector<float>(1024);
  AlignedVector<float> as_many_;  // As many as the slides' networks have.
};

void Race::add_forward_pass(Measurements& out, const std::string& key, const std::string& name,
                            std::function<void()> run) {
  out.forward_passes.push_back({key, name, Timing{}, ""});
  contestants_.push_back({key, std::move(run)});
}

void Race::add_evaluation(Measurements& out, const std::string& key,
                          std::unique_ptr<Evaluation> evaluation) {
  evaluations_.push_back(std::move(evaluation));
  Evaluation* const networks = evaluations_.back().get();
  add_forward_pass(out, key, networks->library(), [this, networks] {
    networks->run(std::span(x_).first(kSlidesInputs), std::span(y_).first(kSlidesOutputs));
  });
}

template <class Other>
void Race::add_other(Measurements& out, const std::string& key, const std::string& name,
                     const std::string& published, std::shared_ptr<Other> network) {
  out.others.push_back({key, name, network->bytes(), published, Timing{}});
  const auto x = std::span<const float>(x_).first(Other::kInputs);
  const auto y = std::span(y_).first(Other::kOutputs);
  contestants_.push_back({key, [network, x, y, phase = 0.0f]() mutable {
                            if constexpr (std::is_same_v<Other, ModeNetwork>) {
                              network->run(x, y);
                            } else {
                              network->run(x, phase, y);
                            }
                            phase += kPhaseStep;
                            if (phase >= 1) phase -= 1;
                          }});
}

Result<void> Race::prepare(Measurements& out) {
  const std::vector<Network> networks = slides_networks();
  out.network_bytes = sizeof(float) * parameter_count(networks);
  for (const bool int8 : {false, true}) {
    auto own = make_own_evaluation(networks, int8);
    if (!own) return own.error();
    add_evaluation(out, int8 ? "panache_half" : "panache", *std::move(own));
  }
  for (Peer& peer : make_peers(networks)) {
    if (peer.evaluation) {
      add_evaluation(out, peer.key, std::move(peer.evaluation));
    } else {
      out.forward_passes.push_back({peer.key, peer.name, std::nullopt, peer.missing});
    }
  }
  as_many_.assign(parameter_count(networks), 1.0f);
  add_forward_pass(out, "read_limit", "reading the weights, no more",
                   [this] { y_[0] = sum_in_any_order(as_many_); });

  const auto phase_network = std::make_shared<PhaseNetwork>();
  add_other(out, "pfnn_cubic", "phase-functioned, cubic (2017)", "1.8 ms, 10 MB", phase_network);
  add_other(out, "pfnn_constant", "phase-functioned, constant (2017)", "0.8 ms, 125 MB",
            std::make_shared<PhaseTable>(*phase_network));
  add_other(out, "mann", "mode-adaptive (2018)", "2 ms, 22 MB", std::make_shared<ModeNetwork>());
  add_other(out, "mason", "phase-functioned with style adapters (2018)", "1.1 ms, 126 KB a style",
            std::make_shared<StyleAdapterNetwork>());
  return {};
}

void Race::run(Measurements& out, int rounds, const ProgressCall& progress) {
  const std::vector<Timing> timings = race(contestants_, rounds, progress);
  size_t next = 0;
  for (ForwardPass& pass : out.forward_passes) {
    if (pass.timing) pass.timing = timings[next++];
  }
  for (OtherNetwork& other : out.others) other.timing = timings[next++];
}

}  // namespace

int Options::rounds() const { return static_cast<int>(std::clamp<int64_t>(steps / 1000, 1, 1000)); }
int Options::crowd_rounds() const {
  return static_cast<int>(std::clamp<int64_t>(steps / 25'000, 1, 40));
}

std::optional<double> Measurements::forward_us(const std::string& key) const {
  for (const ForwardPass& pass : forward_passes) {
    if (pass.key == key && pass.timing) return pass.timing->warm;
  }
  return std::nullopt;
}

Result<Measurements> measure_all(const Options& options, const ProgressCall& progress) {
  // Steps that may fail come first.
  const Result<std::string> bytes = read_file(options.model);
  if (!bytes) return bytes.error();
  const Result<TensorFile> tensors = parse_safetensors(*bytes, options.model);
  if (!tensors) return tensors.error();
  const std::string int8_bytes = format_safetensors(quantize(*tensors));
  const auto model = Model::parse(int8_bytes, options.model);
  if (!model) return model.error();
  const Result<Clip> walk = make_walk(options.walker_model);
  if (!walk) return walk.error();
  const Result<Clip> clap = make_clap(options.walker_model);
  if (!clap) return clap.error();
  const Result<Clip> crouch = make_crouch(options.walker_model);
  if (!crouch) return crouch.error();

  Measurements out;
  out.pinned = pin_to_one_core();
  out.kernels = kernel_target();
  out.clock_ns = clock_cost_ns();
  out.rounds = options.rounds();
  out.model = std::filesystem::path(options.model).filename();
  out.limits = measure_limits();
  if (progress) progress(kAfterLimits);
  {
    Race race;
    if (Result<void> ready = race.prepare(out); !ready) return ready.error();
    race.run(out, out.rounds, part_of(progress, kAfterLimits, kAfterRace));
  }
  out.model_bytes = bytes->size();
  out.int8_model_bytes = int8_bytes.size();
  const Result<double> character = bytes_per_character(*bytes, *walk);
  if (!character) return character.error();
  out.character_bytes = *character;

  out.steps = time_steps(*model, *walk, options.steps, part_of(progress, kAfterRace, kAfterSteps));
  const int64_t some = options.steps / kHardShare;
  out.hard_steps = {{"clap", time_steps(*model, *clap, some)},
                    {"crouch", time_steps(*model, *crouch, some)}};
  constexpr double kAfterCrowds = (kAfterSteps + 1) / 2;
  auto crowds = time_crowds(*bytes, *walk, options.crowd_rounds(),
                            part_of(progress, kAfterSteps, kAfterCrowds));
  if (!crowds) return crowds.error();
  out.crowds = *std::move(crowds);
  auto int8_crowds =
      time_crowds(int8_bytes, *walk, options.crowd_rounds(), part_of(progress, kAfterCrowds, 1));
  if (!int8_crowds) return int8_crowds.error();
  out.int8_crowds = *std::move(int8_crowds);
  return out;
}

}  // namespace panache::bench
