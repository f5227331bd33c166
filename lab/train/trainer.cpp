#include "train/trainer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <optional>
#include <set>

#include "base/parallel.h"
#include "base/progress.h"
#include "learn/fit_style.h"
#include "train/checkpoint.h"
#include "train/coverage.h"
#include "train/export.h"
#include "train/fingerprint.h"
#include "train/fit_heads.h"
#include "train/guidance.h"
#include "train/removal.h"
#include "train/styled_bodies.h"
#include "train/train_predictor.h"
#include "train/training_data.h"

namespace panache {
namespace {

// Networks that share their batches, trained alternately on one thread.
struct Job {
  std::vector<NetworkTrainer*> networks;
  uint64_t seed;

  // The step to resume at. Training may have stopped between the checkpoints of two networks: the
  // one that is ahead waits for the other.
  int64_t step() const {
    int64_t first = networks.front()->step();
    for (const NetworkTrainer* network : networks) first = std::min(first, network->step());
    return first;
  }
};

torch::Tensor loss_of(const std::string& network, const torch::Tensor& out, const Batch& batch,
                      bool squared_tempo, float smoothness) {
  if (network == "contact") {
    return torch::binary_cross_entropy_with_logits(out, batch.contacts);
  }
  torch::Tensor loss;
  if (network == "pose") {
    loss = (out - batch.pose).square().mean();
  } else if (squared_tempo) {
    loss = (out - batch.log_rate).square().mean();
  } else {
    // The network predicts the logarithm of the rate, but the mean of the rate itself must be
    // right: a styled take of n frames spans the sum of its n rates. This loss (Poisson) has its
    // minimum where exp(out) is that mean.
    loss = (out.exp() - batch.log_rate.exp() * (out - batch.log_rate + 1)).mean();
  }
  if (smoothness > 0 && !batch.group_sizes.empty()) {
    // Rows come in pairs of neighbouring frames, between which the change must be smooth.
    const torch::Tensor step = out.slice(0, 1, c10::nullopt, 2) - out.slice(0, 0, c10::nullopt, 2);
    loss = loss + smoothness * step.square().mean();
  }
  return loss;
}

class Training {
 public:
  // `guidance` and `positions`: for the pose network, or null. `validation`: samples sorted by
  // style; `groups`: their number for each style.
  Training(const BatchMaker& batches, const Guidance* guidance, const PositionLoss* positions,
           std::vector<int> validation, std::vector<int64_t> groups, const TrainOptions& options,
           const Fingerprint& training)
      : settings_(options.settings),
        batches_(batches),
        guidance_(guidance),
        positions_(positions),
        validation_(std::move(validation)),
        validation_groups_(std::move(groups)),
        options_(options),
        fingerprint_(training),
        progress_("training") {}

  // Fails if a checkpoint cannot be saved; earlier checkpoints stay.
  Result<void> run(std::vector<Job> jobs, std::vector<LossPoint>& losses) {
    total_ = settings_.steps * static_cast<int64_t>(jobs.size());
    for (const Job& job : jobs) done_ += job.step();
    const int count = static_cast<int>(jobs.size());
    parallel_for(
        count, [&](int j) { run_job(jobs[static_cast<size_t>(j)], losses); }, count);
    if (unsaved_) return *unsaved_;
    std::stable_sort(losses.begin(), losses.end(),
                     [](const LossPoint& a, const LossPoint& b) { return a.network < b.network; });
    return {};
  }

 private:
  void run_job(Job& job, std::vector<LossPoint>& losses) {
    const int64_t report = std::max<int64_t>(1, settings_.steps / 50);
    const int64_t keep = 5 * report;
    std::vector<double> sums(job.networks.size());
    for (int64_t step = job.step(); step < settings_.steps && !is_unsaved(); ++step) {
      const uint64_t start =
          options_.seed * 1000003 + job.seed * 7919 + static_cast<uint64_t>(step) * 2;
      Random random(start);
      // Separate, so that the contact network's draws do not depend on the timing network.
      Random tempo_random(start + (uint64_t{1} << 32));
      const Batch batch = batches_.make(random);
      for (size_t n = 0; n < job.networks.size(); ++n) {
        NetworkTrainer& network = *job.networks[n];
        const torch::Tensor out = network.forward(batch.inputs, batch.group_sizes, &random);
        if (network.step() > step) continue;  // Keeps the draws of the other networks the same.
        torch::Tensor loss = loss_of(network.shape().name, out, batch, settings_.squared_tempo,
                                     settings_.smoothness);
        sums[n] += loss.item<float>();
        if (positions_ && network.shape().name == "pose") {
          loss = loss + settings_.positions * (*positions_)(out, batch);
        }
        if (guidance_ && step % settings_.guidance.every == 0) {
          const double share = static_cast<double>(step) / static_cast<double>(settings_.steps);
          if (network.shape().name == "pose") {
            loss = loss + settings_.guidance.weight * guidance_->loss(network, share, random);
          } else if (network.shape().name == "timing") {
            loss = loss + guidance_->tempo_loss(network, share, tempo_random);
          }
        }
        network.learn(loss);
      }
      const int64_t done = ++done_;
      progress_.update(static_cast<double>(done) / static_cast<double>(total_), status_text());
      if ((step + 1) % report == 0) report_losses(job, step + 1, report, sums, losses);
      if (!options_.checkpoint.empty() && (step + 1) % keep == 0) {
        for (const NetworkTrainer* network : job.networks) save(*network, losses);
      }
    }
  }

  void save(const NetworkTrainer& network, const std::vector<LossPoint>& losses) {
    Result<void> saved = save_checkpoint(options_.checkpoint, fingerprint_, network,
                                         losses_for_checkpoint(losses, network));
    if (saved) return;
    const std::lock_guard lock(mutex_);
    unsaved_ = saved.error();
  }

  bool is_unsaved() {
    const std::lock_guard lock(mutex_);
    return unsaved_.has_value();
  }

  // Whether this line of the table comes from a checkpoint.
  bool is_reported(const NetworkTrainer& network, int64_t step,
                   const std::vector<LossPoint>& losses) {
    const std::lock_guard lock(mutex_);
    return std::any_of(losses.begin(), losses.end(), [&](const LossPoint& point) {
      return point.network == network.shape().name && point.step >= step;
    });
  }

  std::string status_text() {
    const std::lock_guard lock(mutex_);
    return status_;
  }

  std::vector<LossPoint> losses_for_checkpoint(const std::vector<LossPoint>& losses,
                                               const NetworkTrainer& network) {
    const std::lock_guard lock(mutex_);
    std::vector<LossPoint> own;
    for (const LossPoint& point : losses) {
      if (point.network == network.shape().name) own.push_back(point);
    }
    return own;
  }

  void report_losses(const Job& job, int64_t step, int64_t since, std::vector<double>& sums,
                     std::vector<LossPoint>& losses) {
    for (size_t n = 0; n < job.networks.size(); ++n) {
      const NetworkTrainer& network = *job.networks[n];
      if (is_reported(network, step, losses)) continue;
      LossPoint point{network.shape().name, step,
                      static_cast<float>(sums[n] / static_cast<double>(since)),
                      validation_loss(network)};
      sums[n] = 0;
      const std::lock_guard lock(mutex_);
      if (point.network == "pose") {
        char text[64];
        std::snprintf(text, sizeof text, "pose loss %.4f", point.train);
        status_ = text;
        if (!std::isnan(point.validation)) {
          std::snprintf(text, sizeof text, ", validation %.4f", point.validation);
          status_ += text;
        }
      }
      losses.push_back(std::move(point));
    }
  }

  float validation_loss(const NetworkTrainer& network) const {
    if (validation_.empty()) return std::numeric_limits<float>::quiet_NaN();
    torch::NoGradGuard no_gradients;
    Batch batch = batches_.plain(validation_);
    batch.group_sizes = validation_groups_;
    const torch::Tensor out = network.forward(batch.inputs, batch.group_sizes, nullptr);
    return loss_of(network.shape().name, out, batch, settings_.squared_tempo, 0).item<float>();
  }

  const TrainingSettings& settings_;
  const BatchMaker& batches_;
  const Guidance* guidance_;
  const PositionLoss* positions_;
  std::vector<int> validation_;
  std::vector<int64_t> validation_groups_;
  const TrainOptions& options_;
  const Fingerprint fingerprint_;
  Progress progress_;
  std::mutex mutex_;
  std::string status_;
  std::optional<Error> unsaved_;
  std::atomic<int64_t> done_ = 0;
  int64_t total_ = 1;
};

// Up to 4,000 validation samples sorted by style, and their number for each style.
std::vector<int> pick_validation(const SampleSet& set, const std::vector<int>& samples, int styles,
                                 std::vector<int64_t>& groups) {
  const size_t stride = std::max<size_t>(1, samples.size() / 4000);
  std::vector<int> picked;
  for (size_t i = 0; i < samples.size(); i += stride) {
    if (set.samples()[samples[i]].style >= 0) picked.push_back(samples[i]);
  }
  std::stable_sort(picked.begin(), picked.end(),
                   [&](int a, int b) { return set.samples()[a].style < set.samples()[b].style; });
  groups.assign(styles, 0);
  for (const int i : picked) ++groups[set.samples()[i].style];
  return picked;
}

// The pose network's activations on undisturbed training windows; with guidance, a third of
// the rows are of its unlabelled motion.
torch::Tensor clean_features(const SampleSet& set, const std::vector<int>& choice, int styles,
                             BatchSettings batch, const OutputUnits& units,
                             const Guidance* guidance, const NetworkTrainer& pose, uint64_t seed) {
  constexpr int kBatches = 100;
  torch::NoGradGuard no_gradients;
  batch.disturbed = false;
  const BatchMaker batches(set, choice, styles, batch, units);
  Random random(seed);
  std::vector<torch::Tensor> rows;
  rows.reserve(kBatches + 1);  // With those of guidance.
  for (int b = 0; b < kBatches; ++b) {
    rows.push_back(pose.hidden(batches.make(random).inputs, nullptr));
  }
  if (guidance) {
    const int sequences = kBatches * batch.size / 2 / kSequenceInstants;
    rows.push_back(pose.hidden(guidance->windows(sequences, random), nullptr));
  }
  return torch::cat(rows);
}

// The neutral takes of pairs with training samples, which are mixed with unlabelled motion.
std::vector<int> neutral_takes_of(const SampleSet& set, const std::vector<int>& choice) {
  std::set<int> takes;
  for (const int i : choice) takes.insert(set.samples()[i].take);
  return {takes.begin(), takes.end()};
}

}  // namespace

Result<Trained> train(const std::vector<ManifestRow>& rows, const std::vector<StyleName>& styles,
                      const TrainOptions& options, const std::vector<ManifestRow>& unlabelled) {
  // Early, before reading hours of motion.
  if (Result<void> good = check_styles(rows, styles); !good) return good.error();
  if (options.note) {
    for (const std::string& line : list_unpaired(rows)) options.note(line);
  }
  if (options.remover_of) {
    for (const StyleName& style : styles) {
      if (style.name != kAnyStyle) continue;
      return Error{std::string("a style is called '") + kAnyStyle +
                   "'; in a remover this name stands for unknown styles, so rename it"};
    }
    Result<TrainingData> data = prepare_training(rows, PoseLayout::positions);
    if (!data) return data.error();
    Result<void> added = prepare_removal(*options.remover_of, unlabelled, options.seed, *data);
    if (!added) return added.error();
    std::vector<StyleName> removed = styles;
    removed.push_back({kAnyStyle, {}, "whatever style it is"});
    // A style that is to be removed shows its side, so its mirror image can be removed as well.
    TrainOptions of_both_sides = options;
    of_both_sides.settings.batch.mirrored = true;
    of_both_sides.settings.heads.rank = 0;
    return train(*std::move(data), removed, of_both_sides);
  }
  Result<TrainingData> data = prepare_training(rows, PoseLayout::positions, unlabelled);
  if (!data) return data.error();
  return train(*std::move(data), styles, options);
}

Result<Trained> train(TrainingData data, const std::vector<StyleName>& styles,
                      const TrainOptions& options) {
  const Recipe& recipe = *options.recipe;
  const TrainingSettings& settings = options.settings;
  for (Take& take : data.takes) write_numbers(recipe.layout, take);
  for (Take& take : data.unlabelled) write_numbers(recipe.layout, take);

  std::vector<std::string> names;
  names.reserve(styles.size());
  for (const StyleName& style : styles) names.push_back(style.name);
  const int count = static_cast<int>(names.size());
  const bool removes = !data.removal.empty();
  SampleSet set(data.takes, removes ? data.removal : data.pairings, names, recipe,
                settings.neutral_samples);
  if (recipe.learns_styles) {
    // A style that was removed leaves neutral motion of any person.
    if (!removes) take_off_performers(data.takes, set);
  }
  const std::vector<bool> validates = validation_takes(data.takes);
  std::vector<int> choice, held;
  for (size_t i = 0; i < set.samples().size(); ++i) {
    const Sample& sample = set.samples()[i];
    const bool validation = sample.styled >= 0 && validates[take_with_style(data.takes, sample)];
    (validation ? held : choice).push_back(static_cast<int>(i));
  }

  Trained trained;
  trained.styles = cover_styles(data.takes, set, choice, names);
  if (options.note) {
    for (const std::string& line : list_too_short(data.takes, set)) options.note(line);
  }
  if (Result<void> good = check_samples(trained.styles); !good) return good.error();

  const OutputUnits units = output_units(set, choice);
  const BatchMaker batches(set, choice, count, settings.batch, units);
  std::vector<NetworkTrainer> networks;
  for (const NetworkShape& shape : network_shapes(set, count)) {
    networks.emplace_back(shape, settings.optimizer, settings.steps,
                          options.seed * 31 + networks.size());
  }
  trained.samples = choice.size();
  trained.read_seconds = data.read_seconds;
  trained.pair_seconds = data.pair_seconds;
  const Fingerprint training_print = fingerprint(data, set, choice, styles, options);
  if (!options.checkpoint.empty()) {
    for (NetworkTrainer& network : networks) {
      Result<void> loaded =
          load_checkpoint(options.checkpoint, training_print, network, trained.losses);
      if (!loaded) return loaded.error();
    }
  }
  const Stopwatch watch;
  std::optional<UnlabelledMotion> motion;
  std::optional<Guidance> guidance;
  if (settings.guidance.sequences > 0 && !data.unlabelled.empty()) {
    motion.emplace(data.unlabelled, data.takes, neutral_takes_of(set, choice));
    if (motion->empty()) {
      return Error{"the unlabelled motion is too short; expected a take of more than 1.5 seconds"};
    }
    Guides guides =
        train_guides(data.takes, set, choice, names, settings.guidance, options.seed + 2);
    const Signatures found(data.takes, data.pairings);
    std::vector<const Signature*> signatures;
    signatures.reserve(names.size());
    for (const std::string& style : names) signatures.push_back(found.find(style));
    guidance.emplace(set, choice, units, *motion, std::move(guides), signatures, settings.guidance,
                     settings.batch.input_clip);
  }
  const Guidance* guide = guidance ? &*guidance : nullptr;
  std::optional<PositionLoss> positions;
  if (settings.positions > 0) positions.emplace(set, units);
  {
    std::vector<int64_t> groups;
    std::vector<int> validation = pick_validation(set, held, count, groups);
    Training training(batches, guide, positions ? &*positions : nullptr, std::move(validation),
                      std::move(groups), options, training_print);
    // The pose network costs as much as the other two together: one thread each.
    Result<void> done =
        training.run({{{&networks[0]}, 1}, {{&networks[1], &networks[2]}, 2}}, trained.losses);
    if (!done) return done.error();
  }
  for (NetworkTrainer& network : networks) network.round_halves();
  trained.model = export_model(set, units, styles, networks, options);
  Result<float> error = export_error(trained.model, set, batches, networks, choice);
  if (!error) return error.error();
  trained.export_error = *error;
  // After the comparison, because libtorch's forward pass has no gate.
  if (recipe.learns_styles) {
    fit_gate(
        clean_features(set, choice, count, settings.batch, units, guide, networks[0], options.seed),
        trained.model, removes ? kTrustedByRemovers : kTrusted);
    if (auto added = add_activation_statistics(data.takes, trained.model); !added) {
      return added.error();
    }
    if (settings.heads.rank > 0) {
      fit_heads(set, choice, units, settings.batch, settings.heads, guide, networks[0],
                options.seed + 3, trained.model);
    }
  }
  if (removes) {
    Result<void> added = add_recognition(data.takes, options.seed, trained.model);
    if (!added) return added.error();
  }
  if (settings.predictor_steps > 0) {
    Progress progress("training the input predictor");
    train_predictor(
        data.takes, settings.predictor_steps, options.seed,
        [&](double share) { progress.update(share); }, trained.model, trained.losses);
  }
  trained.train_seconds = watch.seconds();
  return trained;
}

}  // namespace panache
