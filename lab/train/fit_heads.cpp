#include "train/fit_heads.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "base/progress.h"
#include "style/stages/shape.h"
#include "train/styled_bodies.h"

namespace panache {
namespace {

constexpr auto kDouble = torch::kFloat64;

// Windows up to this quantile of the leverage of a style's own windows are like them.
constexpr double kAlike = 0.99;

torch::Tensor tensor_of(const panache::Tensor& from) {
  return torch::tensor(from.values).to(kDouble);
}

// Examples of standardised activations and of answers, with the weight of each.
struct Examples {
  torch::Tensor seen;     // [rows][activations]
  torch::Tensor answers;  // [rows][outputs]
  torch::Tensor weights;  // [rows], with a sum of 1.
};

class HeadFitter {
 public:
  HeadFitter(const SampleSet& set, const std::vector<int>& choice, const OutputUnits& units,
             const BatchSettings& batch, const HeadSettings& settings, const NetworkTrainer& pose,
             uint64_t seed, panache::TensorFile& model)
      : set_(set),
        settings_(settings),
        pose_(pose),
        model_(model),
        random_(seed),
        plain_(set, choice, pose.shape().heads, undisturbed(batch), units),
        disturbed_(set, choice, pose.shape().heads, batch, units),
        mean_(tensor_of(model.tensors.at("learn.mean"))),
        scale_(tensor_of(model.tensors.at("learn.scale"))) {
    samples_.resize(static_cast<size_t>(pose.shape().heads));
    for (const int i : choice) {
      const int style = set.samples()[static_cast<size_t>(i)].style;
      if (style >= 0) samples_[static_cast<size_t>(style)].push_back(i);
    }
  }

  // Motion without styles, standardised for the networks. [rows][inputs]
  void set_motion(const torch::Tensor& windows) {
    motion_ = windows;
    motion_seen_ = standardised(windows);
  }

  void fit(int style) {
    const Examples own = rows_of(style);
    Solution solution = solve(own);
    if (motion_.defined()) {
      const Examples guided = guided_rows(style, own, solution);
      Examples all{torch::cat({own.seen, guided.seen}), torch::cat({own.answers, guided.answers}),
                   torch::cat({own.weights, guided.weights})};
      all.weights = all.weights / all.weights.sum();
      solution = solve(all);
    }
    write(style, own, solution);
  }

 private:
  // answer = answers + (seen - middle) weights
  struct Solution {
    torch::Tensor middle, answer, weights, gram;
  };

  static BatchSettings undisturbed(BatchSettings batch) {
    batch.disturbed = false;
    return batch;
  }

  torch::Tensor standardised(const torch::Tensor& windows) const {
    return (pose_.activations(windows).to(kDouble) - mean_) / scale_;
  }

  // The style's samples as they are and in disturbed copies; each action counts by the square root
  // of its share.
  Examples rows_of(int style) {
    std::vector<int> samples = samples_[static_cast<size_t>(style)];
    const size_t stride = 1 + samples.size() / static_cast<size_t>(settings_.max_samples);
    std::vector<int> some;
    for (size_t i = 0; i < samples.size(); i += stride) some.push_back(samples[i]);
    std::map<std::string, double> actions;
    const auto action = [&](int i) { return set_.content(set_.samples()[static_cast<size_t>(i)]); };
    for (const int i : some) ++actions[action(i)];
    std::vector<double> weights;
    for (const int i : some) weights.push_back(1 / std::sqrt(actions[action(i)]));
    const torch::Tensor once = torch::tensor(weights, kDouble);
    std::vector<torch::Tensor> seen, answers, weight;
    for (int copy = 0; copy <= settings_.copies; ++copy) {
      const Batch batch = copy == 0 ? plain_.plain(some) : disturbed_.disturbed(some, random_);
      seen.push_back(standardised(batch.inputs));
      answers.push_back(batch.pose.to(kDouble));
      weight.push_back(once);
    }
    Examples rows{torch::cat(seen), torch::cat(answers), torch::cat(weight)};
    rows.weights = rows.weights / rows.weights.sum();
    return rows;
  }

  // The trained head's answers to other motion. Examples that are like the style's own do not
  // count.
  Examples guided_rows(int style, const Examples& own, const Solution& solution) const {
    const auto leverage = [&](const torch::Tensor& seen) {
      const torch::Tensor off = seen - solution.middle;
      const torch::Tensor inverse = torch::linalg_solve(ridged(solution.gram), off.t());
      return (off * inverse.t()).sum(1);
    };
    const double limit = leverage(own.seen).quantile(kAlike).item<double>() * settings_.alike;
    const torch::Tensor unlike = (leverage(motion_seen_) / limit - 1).clamp(0, 1);
    std::vector<int64_t> groups(static_cast<size_t>(pose_.shape().heads));
    groups[static_cast<size_t>(style)] = motion_.size(0);
    const torch::Tensor answers = pose_.forward(motion_, groups, nullptr).to(kDouble);
    return {motion_seen_, answers,
            unlike * (settings_.guided / static_cast<double>(motion_.size(0)))};
  }

  torch::Tensor ridged(const torch::Tensor& gram) const {
    return gram + settings_.penalty * torch::eye(gram.size(0), kDouble);
  }

  Solution solve(const Examples& rows) const {
    const torch::Tensor weights = rows.weights.unsqueeze(1);
    Solution out;
    out.middle = (rows.seen * weights).sum(0);
    out.answer = (rows.answers * weights).sum(0);
    const torch::Tensor seen = rows.seen - out.middle;
    const torch::Tensor weighed = seen * weights;
    out.gram = torch::mm(weighed.t(), seen);
    out.weights =
        torch::linalg_solve(ridged(out.gram), torch::mm(weighed.t(), rows.answers - out.answer));
    return out;
  }

  // How much the answers to the style's own windows must grow so that they vary as much as those of
  // the real takes: a ridge regression answers with too little. [outputs] The same for the joints
  // of a region; legs and root move as they are learnt, because more of it makes feet slide.
  torch::Tensor gains(const Examples& own, const torch::Tensor& answers) const {
    const torch::Tensor weights = own.weights.unsqueeze(1);
    const auto variance = [&](const torch::Tensor& values) {
      const torch::Tensor middle = (values * weights).sum(0);
      return ((values - middle).square() * weights).sum(0);
    };
    const torch::Tensor real = variance(own.answers), ours = variance(answers);
    std::map<int, std::vector<int64_t>> groups;
    for (int64_t o = 0; o < kHipsHeight; ++o) {
      const Region region = region_of(static_cast<int>(o / 3));
      if (region != Region::legs) groups[static_cast<int>(region)].push_back(o);
    }
    groups[kRegions] = {kHipsHeight};
    torch::Tensor gain = torch::ones({own.answers.size(1)}, kDouble);
    for (const auto& [group, outputs] : groups) {
      const torch::Tensor list = torch::tensor(outputs);
      const double wanted =
          std::sqrt(real.index_select(0, list).sum().item<double>() /
                    std::max(ours.index_select(0, list).sum().item<double>(), 1e-12));
      gain.index_fill_(0, list,
                       std::clamp(1 + settings_.gain * (wanted - 1), 1.0, settings_.max_gain));
    }
    return gain;
  }

  // Keeps the combinations of activations that explain most of the answers.
  void write(int style, const Examples& own, const Solution& solution) const {
    const torch::Tensor spread =
        torch::mm(solution.weights.t(), torch::mm(solution.gram, solution.weights));
    const auto [values, vectors] = torch::linalg_eigh(spread);
    const int64_t outputs = vectors.size(1);
    const int64_t rank = std::min<int64_t>(settings_.rank, outputs);
    const torch::Tensor main = vectors.slice(1, outputs - rank);  // [outputs][rank]
    const torch::Tensor reduce = torch::mm(solution.weights, main) / scale_.unsqueeze(1);
    const torch::Tensor middle = mean_ + solution.middle * scale_;
    const torch::Tensor answers =
        solution.answer + torch::mm(torch::mm(own.seen - solution.middle, solution.weights),
                                    torch::mm(main, main.t()));
    const torch::Tensor head = main.t() * gains(own, answers).unsqueeze(0);
    // The reduction is zero for the mean of the windows, in the precision of the file.
    const panache::Tensor weights = to_tensor(reduce, true);
    const torch::Tensor rounded =
        torch::tensor(weights.values).to(kDouble).view({reduce.size(0), reduce.size(1)});
    const std::string number = std::to_string(style);
    model_.tensors["pose.reduce." + number + ".weight"] = weights;
    model_.tensors["pose.reduce." + number + ".bias"] = to_tensor(-torch::matmul(middle, rounded));
    model_.tensors["pose.head." + number + ".weight"] = to_tensor(head, true);
    model_.tensors["pose.head." + number + ".bias"] = to_tensor(solution.answer);
  }

  const SampleSet& set_;
  const HeadSettings settings_;
  const NetworkTrainer& pose_;
  panache::TensorFile& model_;
  Random random_;
  const BatchMaker plain_, disturbed_;
  const torch::Tensor mean_, scale_;       // Of the activations on motion of all kinds.
  std::vector<std::vector<int>> samples_;  // [styles]
  torch::Tensor motion_, motion_seen_;
};

}  // namespace

void fit_heads(const SampleSet& set, const std::vector<int>& choice, const OutputUnits& units,
               const BatchSettings& batch, const HeadSettings& settings, const Guidance* guidance,
               const NetworkTrainer& pose, uint64_t seed, TensorFile& model) {
  torch::NoGradGuard no_gradients;
  Progress progress("fitting the heads");
  HeadFitter fitter(set, choice, units, batch, settings, pose, seed, model);
  if (guidance) {
    Random random(seed);
    fitter.set_motion(guidance->windows(settings.sequences, random));
  }
  const int styles = pose.shape().heads;
  for (int s = 0; s < styles; ++s) {
    fitter.fit(s);
    progress.update(static_cast<double>(s + 1) / styles);
  }
}

}  // namespace panache
