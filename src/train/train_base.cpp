#include "train/train_base.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string>

#include <torch/types.h>

#include "base/parallel.h"
#include "base/progress.h"
#include "base/stopwatch.h"
#include "learn/disturbance.h"
#include "learn/fit_style.h"
#include "learn/samples.h"
#include "pose/mirror.h"
#include "recipes/recipe.h"
#include "train/export.h"
#include "train/matrix_products.h"
#include "train/network.h"
#include "train/train_predictor.h"

namespace panache {
namespace {

constexpr int kNumbers = pose_feature_count(PoseLayout::positions);
constexpr int kJointNumbers = 3 * kHumanJoints;
constexpr int kInputs = kWindowPoses * kNumbers;
constexpr int kBatch = 256;  // Rows: pairs of neighbouring instants.
constexpr float kInputClip = 3;
constexpr float kSmoothness = 0.1f;  // Weight of the loss on the change between the two of a pair.
constexpr float kHidden = 0.15f;     // Share of the windows without a limb, for each limb.
constexpr Disturbance kDisturbance = [] {
  Disturbance how = kUsualDisturbance;
  how.posture = 0.5f, how.jitter = 0.007f, how.tempo = 0.15f;
  return how;
}();

// What the trunk must tell, in this order. Poses at these frames from now, normalised and halved:
constexpr std::array<float, 6> kTimes = {0, 3, 7.5f, 13.5f, -12, -18};
// how far each joint came in the last poses' distance;
constexpr float kStepUnit = 0.04f;  // Metres.
// whether ankles and toes are near the floor;
constexpr std::array kLowJoints = {HumanJoint::left_foot, HumanJoint::right_foot,
                                   HumanJoint::left_toes, HumanJoint::right_toes};
constexpr float kLowAnkle = 0.12f, kLowToe = 0.07f, kLowUnit = 0.015f, kLowWeight = 2;  // Metres.
// how each joint is turned away from its mean of about a second.
constexpr float kTurnWeight = 4;       // Per radian.
constexpr double kMeanDeviation = 15;  // Frames, of the Gaussian that weighs that mean.
constexpr int kTargets =
    kTimes.size() * kNumbers + kJointNumbers + kLowJoints.size() + kJointNumbers;

// Joints that are hidden together.
constexpr std::array<std::pair<HumanJoint, HumanJoint>, 6> kLimbs = {{
    {HumanJoint::spine, HumanJoint::chest},
    {HumanJoint::neck, HumanJoint::head},
    {HumanJoint::left_shoulder, HumanJoint::left_hand},
    {HumanJoint::right_shoulder, HumanJoint::right_hand},
    {HumanJoint::left_upper_leg, HumanJoint::left_toes},
    {HumanJoint::right_upper_leg, HumanJoint::right_toes},
}};

// How each joint is turned away from where it is on average around each frame: the same whatever
// the rig. [frames][63] rotation vectors, heading frame
std::vector<std::array<Vec3, kHumanJoints>> turns_from_mean(const Take& take) {
  const int frames = take.frames(), reach = static_cast<int>(3 * kMeanDeviation);
  std::vector<std::array<Quat, kHumanJoints>> steady = take.rotations;
  for (int f = 1; f < frames; ++f) {
    for (int j = 0; j < kHumanJoints; ++j) {
      Quat& q = steady[f][j];
      if (dot(q, steady[f - 1][j]) < 0) q = {-q.x, -q.y, -q.z, -q.w};
    }
  }
  std::vector<float> weight;
  for (int d = -reach; d <= reach; ++d) {
    weight.push_back(
        static_cast<float>(std::exp(-0.5 * d * d / (kMeanDeviation * kMeanDeviation))));
  }
  std::vector<std::array<Vec3, kHumanJoints>> turns(frames);
  for (int f = 0; f < frames; ++f) {
    std::array<Quat, kHumanJoints> sum;
    sum.fill({0, 0, 0, 0});
    for (int d = -reach; d <= reach; ++d) {
      const auto& other = steady[std::clamp(f + d, 0, frames - 1)];
      const float w = weight[d + reach];
      for (int j = 0; j < kHumanJoints; ++j) {
        sum[j] = {sum[j].x + w * other[j].x, sum[j].y + w * other[j].y, sum[j].z + w * other[j].z,
                  sum[j].w + w * other[j].w};
      }
    }
    for (int j = 0; j < kHumanJoints; ++j) {
      turns[f][j] = log_rotation(steady[f][j] * conjugate(normalized(sum[j])));
    }
  }
  return turns;
}

// Where takes may be looked at: actions by the square root of their frames, frames of one alike.
class Places {
 public:
  void add(const std::string& action, int take, int frames) {
    for (int f = 0; f + 2 < frames; ++f) actions_[action].emplace_back(take, f);
  }
  bool empty() const { return actions_.empty(); }
  size_t size() const {
    size_t sum = 0;
    for (const auto& [action, list] : actions_) sum += list.size();
    return sum;
  }
  std::pair<int, int> draw(Random& random) const {
    float total = 0;
    for (const auto& [action, list] : actions_) total += share(list);
    float at = random.uniform() * total;
    auto found = actions_.begin();
    while (std::next(found) != actions_.end() && at >= share(found->second)) {
      at -= share(found->second);
      ++found;
    }
    return found->second[random.below(static_cast<uint32_t>(found->second.size()))];
  }

 private:
  static float share(const std::vector<std::pair<int, int>>& list) {
    return std::sqrt(static_cast<float>(list.size()));
  }
  std::map<std::string, std::vector<std::pair<int, int>>> actions_;
};

class BaseTraining {
 public:
  BaseTraining(const std::vector<Take>& takes, InputUnits units, const TrainingSettings& settings,
               uint64_t seed)
      : takes_(takes), units_(std::move(units)), steps_(settings.base_steps), seed_(seed) {
    const std::vector<bool> validates = validation_takes(takes);
    for (size_t t = 0; t < takes.size(); ++t) {
      const ManifestRow& row = takes[t].row;
      (validates[t] ? held_ : places_).add(row.content, static_cast<int>(t), takes[t].frames());
      turns_.push_back({});
    }
    parallel_for(static_cast<int>(takes.size()),
                 [&](int t) { turns_[t] = turns_from_mean(takes_[t]); });
    networks_.emplace_back(NetworkShape{"pose", kInputs, 128, 3, kTargets}, settings.optimizer,
                           steps_, seed * 31);
    networks_.emplace_back(NetworkShape{"contact", kInputs, 32, 3, kFeet}, settings.optimizer,
                           steps_, seed * 31 + 1);
  }

  bool has_motion() const { return !places_.empty(); }
  size_t samples() const { return places_.size(); }

  void run(std::vector<LossPoint>& losses) {
    Progress progress("training the base");
    const int64_t report = std::max<int64_t>(1, steps_ / 50);
    Random fixed(9);
    std::optional<Rows> validation;
    if (!held_.empty()) validation = draw(held_, fixed, false);
    std::array<double, 2> sums{};
    for (int64_t step = 0; step < steps_; ++step) {
      Random random(seed_ * 1000003 + static_cast<uint64_t>(step) * 2);
      const Rows rows = draw(places_, random, true);
      for (size_t n = 0; n < networks_.size(); ++n) {
        const torch::Tensor loss = loss_of(n, rows, &random);
        sums[n] += loss.item<double>();
        networks_[n].learn(loss);
      }
      progress.update(static_cast<double>(step + 1) / static_cast<double>(steps_));
      if ((step + 1) % report != 0) continue;
      torch::NoGradGuard no_gradients;
      for (size_t n = 0; n < networks_.size(); ++n) {
        LossPoint point{networks_[n].shape().name, step + 1,
                        static_cast<float>(sums[n] / static_cast<double>(report))};
        if (validation) point.validation = loss_of(n, *validation, nullptr).item<float>();
        losses.push_back(point);
      }
      sums = {};
    }
    std::stable_sort(losses.begin(), losses.end(),
                     [](const LossPoint& a, const LossPoint& b) { return a.network > b.network; });
  }

  // What the trunk was taught with is of no use to those who learn on it.
  void write(TensorFile& file) const {
    for (const NetworkTrainer& network : networks_) network.write(file);
    file.tensors.erase("pose.head.0.weight");
    file.tensors.erase("pose.head.0.bias");
  }

 private:
  struct Rows {
    torch::Tensor inputs, targets, contacts;  // [kBatch][kInputs], [kTargets], [kFeet]
  };

  // The pose of a take at a fractional frame, as far as it reaches, played `tempo` times as fast.
  void write_pose(const Take& take, float frame, float tempo, bool flipped,
                  std::span<float, kNumbers> out) const {
    frame = std::clamp(frame, 0.0f, static_cast<float>(take.frames() - 1));
    const HumanPositions body = body_at(take, frame);
    for (int j = 0; j < kHumanJoints; ++j) {
      out[3 * j] = body[j].x, out[3 * j + 1] = body[j].y, out[3 * j + 2] = body[j].z;
    }
    const auto root = root_at(take, frame);
    for (int r = 0; r < kRootFeatures; ++r) out[kJointNumbers + r] = tempo * root[r];
    if (flipped) mirror_pose(PoseLayout::positions, out);
  }

  float normalised(float value, int number) const {
    return std::clamp((value - units_.mean[number]) / units_.scale[number], -kInputClip,
                      kInputClip);
  }

  void write_targets(int t, float frame, float tempo, bool flipped, float* out) const {
    const Take& take = takes_[t];
    std::array<float, kNumbers> now, pose;
    for (const float time : kTimes) {
      write_pose(take, frame + tempo * time, tempo, flipped, pose);
      if (time == 0) now = pose;
      for (int n = 0; n < kNumbers; ++n) *out++ = normalised(pose[n], n) / 2;
    }
    constexpr auto kSpacing = static_cast<float>(kWindowSpacing * kTakeRate);
    write_pose(take, frame - tempo * kSpacing, tempo, flipped, pose);
    for (int n = 0; n < kJointNumbers; ++n) {
      *out++ = std::clamp((now[n] - pose[n]) / kStepUnit, -kInputClip, kInputClip);
    }
    for (size_t k = 0; k < kLowJoints.size(); ++k) {
      const float above = now[3 * index(kLowJoints[k]) + 1] - (k < kFeet ? kLowAnkle : kLowToe);
      *out++ = kLowWeight / (1 + std::exp(above / kLowUnit));
    }
    const float held = std::clamp(frame, 0.0f, static_cast<float>(take.frames() - 1));
    const int a = static_cast<int>(held), b = std::min(a + 1, take.frames() - 1);
    StyleDelta turn;
    for (int j = 0; j < kHumanJoints; ++j) {
      turn.rotations[j] = lerp(turns_[t][a][j], turns_[t][b][j], held - static_cast<float>(a));
    }
    if (flipped) turn = mirrored(turn);
    for (const Vec3& r : turn.rotations) {
      for (const float axis : {r.x, r.y, r.z}) *out++ = kTurnWeight * axis;
    }
  }

  Rows draw(const Places& places, Random& random, bool disturbed) const {
    Rows rows{torch::empty({kBatch, kInputs}), torch::empty({kBatch, kTargets}),
              torch::empty({kBatch, kFeet})};
    for (int r = 0; r < kBatch; r += 2) {
      const auto [t, place] = places.draw(random);
      const Take& take = takes_[t];
      const bool mirrored = random.bits() & 1;
      const Disturbance& how = disturbed ? kDisturbance : Disturbance{};
      const Disturbed draw = draw_disturbance(how, units_, random);
      std::array<bool, kLimbs.size()> hidden{};
      for (bool& limb : hidden) limb = disturbed && random.uniform() < kHidden;
      const float first = static_cast<float>(place) + random.uniform();
      for (int k = 0; k < 2; ++k) {
        const float frame = first + static_cast<float>(k) * draw.tempo;
        const std::span window(rows.inputs.data_ptr<float>() + (r + k) * kInputs, kInputs);
        write_window(take, frame, draw.tempo, mirrored, window);
        disturb(draw, how, random, window);
        for (int i = 0; i < kInputs; ++i) window[i] = normalised(window[i], i % kNumbers);
        for (size_t l = 0; l < kLimbs.size(); ++l) {
          if (!hidden[l]) continue;
          const int from = 3 * index(kLimbs[l].first), to = 3 * index(kLimbs[l].second) + 3;
          for (int p = 0; p < kInputs; p += kNumbers) {
            std::fill(window.begin() + p + from, window.begin() + p + to, 0.0f);
          }
        }
        write_targets(t, frame, draw.tempo, mirrored,
                      rows.targets.data_ptr<float>() + (r + k) * kTargets);
        const int nearest = std::clamp(static_cast<int>(std::lround(frame)), 0, take.frames() - 1);
        float* contacts = rows.contacts.data_ptr<float>() + (r + k) * kFeet;
        for (int f = 0; f < kFeet; ++f) {
          contacts[f] = take.contacts[nearest][mirrored ? 1 - f : f] ? 1.0f : 0.0f;
        }
      }
    }
    return rows;
  }

  void write_window(const Take& take, float frame, float tempo, bool mirrored,
                    std::span<float> out) const {
    constexpr auto kSpacing = static_cast<float>(kWindowSpacing * kTakeRate);
    for (int p = 0; p < kWindowPoses; ++p) {
      write_pose(take, frame - static_cast<float>(p) * kSpacing * tempo, tempo, mirrored,
                 out.subspan(size_t(p) * kNumbers).first<kNumbers>());
    }
  }

  torch::Tensor loss_of(size_t network, const Rows& rows, Random* random) const {
    const torch::Tensor out = networks_[network].forward(rows.inputs, {}, random);
    if (network == 1) return torch::binary_cross_entropy_with_logits(out, rows.contacts);
    const torch::Tensor step = out.slice(0, 1, c10::nullopt, 2) - out.slice(0, 0, c10::nullopt, 2);
    return (out - rows.targets).square().mean() + kSmoothness * step.square().mean();
  }

  const std::vector<Take>& takes_;
  const InputUnits units_;
  const int64_t steps_;
  const uint64_t seed_;
  Places places_, held_;
  std::vector<std::vector<std::array<Vec3, kHumanJoints>>> turns_;  // [takes][frames]
  std::vector<NetworkTrainer> networks_;                            // Pose, contact.
};

}  // namespace

Result<Trained> train_base(const std::vector<ManifestRow>& rows, const TrainOptions& options) {
  if (Result<void> prepared = prepare_matrix_products(); !prepared) return prepared.error();
  const Stopwatch watch;
  Result<std::vector<Take>> takes = read_training_takes(rows, options.recipe->layout, "reading");
  if (!takes) return takes.error();
  const double read_seconds = watch.seconds();
  Result<Trained> trained = train_base(*std::move(takes), options);
  if (trained) trained->read_seconds = read_seconds;
  return trained;
}

Result<Trained> train_base(std::vector<Take> takes, const TrainOptions& options) {
  const Recipe& recipe = *options.recipe;
  const Stopwatch watch;
  std::vector<int> all;
  for (size_t t = 0; t < takes.size(); ++t) {
    all.push_back(static_cast<int>(t));
    takes[t].row.neutral = true;  // Whatever it shows: nobody asked for a style.
  }
  const InputUnits units = input_units(takes, all, recipe.layout);
  BaseTraining training(takes, units, options.settings, options.seed);
  if (!training.has_motion()) {
    return Error{"there is no motion to train a base on; expected a take of several frames"};
  }
  Trained trained;
  training.run(trained.losses);
  trained.samples = training.samples();

  TensorFile& file = trained.model;
  file = model_header(recipe, {}, options, units, kInputClip);
  file.metadata["steps"] = std::to_string(options.settings.base_steps);
  file.metadata["samples"] = std::to_string(trained.samples);
  training.write(file);
  if (auto added = add_activation_statistics(takes, file); !added) return added.error();
  if (options.settings.predictor_steps > 0) {
    Progress progress("training the input predictor");
    train_predictor(
        takes, options.settings.predictor_steps, options.seed,
        [&](double share) { progress.update(share); }, file, trained.losses);
  }
  trained.train_seconds = watch.seconds();
  return trained;
}

}  // namespace panache
