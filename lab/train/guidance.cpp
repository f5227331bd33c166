#include "train/guidance.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "learn/disturbance.h"
#include "train/styled_bodies.h"

namespace panache {
namespace {

constexpr int kNumbers = pose_feature_count(PoseLayout::positions);
constexpr float kLabelSmoothing = 0.1f;
// A style varies between bodies: changes within the style's own deviation plus this value are
// equally likely. In output units.
constexpr float kMinStyleDeviation = 0.15f;
constexpr float kLeanUnit = 0.1f, kFreeLean = 0.3f;   // Metres; units without penalty.
constexpr float kFloorUnit = 0.05f, kFloor = 0.045f;  // Metres; no toe of the input is lower.
constexpr double kTolerated = 0.4;                    // Share of a change that real takes agree on.
constexpr float kStill = 0.02f;  // Metres: joints that move less in a sequence do not count.
// One in so many instants is checked for joint limits, because neighbours bend alike.
constexpr int64_t kAnatomyStride = 3;

torch::Tensor joints(std::initializer_list<HumanJoint> list) {
  std::vector<int64_t> numbers;
  numbers.reserve(list.size());
  for (const HumanJoint joint : list) numbers.push_back(index(joint));
  return torch::tensor(numbers);
}
const torch::Tensor& moving_joints() {
  using enum HumanJoint;
  static const torch::Tensor list =
      joints({left_hand, right_hand, left_lower_arm, right_lower_arm, left_foot, right_foot});
  return list;
}
const torch::Tensor& foot_joints() {
  using enum HumanJoint;
  static const torch::Tensor list = joints({left_foot, right_foot, left_toes, right_toes});
  return list;
}

// Keeps the body over its feet as in the input, and above the floor. [rows][21][3]
torch::Tensor balance_loss(const torch::Tensor& in, const torch::Tensor& out) {
  const auto lean = [](const torch::Tensor& positions) {
    return positions.mean(1) - positions.index_select(1, foot_joints()).mean(1);
  };
  const torch::Tensor both = (lean(out) - lean(in)) / kLeanUnit;
  const torch::Tensor sideways = torch::cat({both.slice(1, 0, 1), both.slice(1, 2, 3)}, 1);
  const auto lowest = [](const torch::Tensor& positions) {
    return std::get<0>(positions.index_select(1, foot_joints()).select(2, 1).min(1));
  };
  const torch::Tensor depth = (lowest(in).clamp_max(kFloor) - lowest(out)) / kFloorUnit;
  return (sideways.abs() - kFreeLean).relu().square().mean() + depth.relu().square().mean();
}

// See traits(): means over the instants. [sequences][instants][21][3] -> [sequences][kGuidedTraits]
torch::Tensor traits_of(const torch::Tensor& bodies) {
  using enum HumanJoint;
  constexpr double kDegrees = 180 / std::numbers::pi;
  const auto at = [&](HumanJoint joint) { return bodies.select(2, index(joint)); };
  const auto pitch = [&](HumanJoint from, HumanJoint to) {
    const torch::Tensor up = at(to) - at(from);
    return kDegrees * torch::atan2(up.select(2, 2), up.select(2, 1));
  };
  const auto bend = [&](HumanJoint upper, HumanJoint middle, HumanJoint end) {
    const torch::Tensor a = at(middle) - at(upper), b = at(end) - at(middle);
    // Keeps the square root differentiable at a straight limb.
    const torch::Tensor across = (torch::linalg_cross(a, b).square().sum(2) + 1e-8).sqrt();
    return kDegrees / 2 * torch::atan2(across, (a * b).sum(2));
  };
  const torch::Tensor knees = bend(left_upper_leg, left_lower_leg, left_foot) +
                              bend(right_upper_leg, right_lower_leg, right_foot);
  const torch::Tensor elbows = bend(left_upper_arm, left_lower_arm, left_hand) +
                               bend(right_upper_arm, right_lower_arm, right_hand);
  const torch::Tensor stance = 100 * (at(left_foot) - at(right_foot)).select(2, 0).abs();
  const torch::Tensor hands = 100 * ((at(left_hand) + at(right_hand)) / 2 - at(hips)).select(2, 1);
  torch::Tensor speed = torch::zeros({bodies.size(0)});
  for (const HumanJoint hand : {left_hand, right_hand}) {
    const torch::Tensor step = at(hand).slice(1, 1) - at(hand).slice(1, 0, -1);
    speed = speed +
            (step.square().sum(2) + 1e-10).sqrt().mean(1) * (kTakeRate / kClassifiedSpacing / 2);
  }
  return torch::stack({pitch(hips, neck).mean(1), pitch(neck, head).mean(1), knees.mean(1),
                       elbows.mean(1), stance.mean(1), hands.mean(1), 100 * (speed + 0.05).log()},
                      1);
}

// How far a change of a trait may differ from that of the real takes.
double tolerance_of(const Signature& real, size_t trait) {
  const double min = kTraits[trait].min, share = kTolerated * std::abs(real.change[trait]);
  return real.certain[trait] ? std::max(min / 2, std::min(real.deviation[trait], share))
                             : std::max(min, real.deviation[trait]);
}

// Difference of changes from those of real takes beyond the tolerance, with linear tails. All
// arguments have one shape.
torch::Tensor beyond_tolerance(const torch::Tensor& changes, const torch::Tensor& real,
                               const torch::Tensor& tolerance) {
  const torch::Tensor off = ((changes - real).abs() / tolerance - 1).relu();
  return off.square() / (1 + off);
}

}  // namespace

torch::Tensor velocity_loss(const torch::Tensor& in, const torch::Tensor& out) {
  const auto velocity = [](const torch::Tensor& positions) {
    const torch::Tensor some = positions.index_select(2, moving_joints());
    return some.slice(1, 1) - some.slice(1, 0, -1);
  };
  const torch::Tensor a = velocity(in), b = velocity(out);
  const torch::Tensor in_square = a.square().sum({1, 3}), out_square = b.square().sum({1, 3});
  const torch::Tensor larger = torch::maximum(out_square, in_square);
  const torch::Tensor root = (in_square * larger + std::pow(kStill, 4.0f)).sqrt();
  const torch::Tensor weight = in_square.sqrt();
  return ((1 - (a * b).sum({1, 3}) / root) * weight).sum() / (weight.sum() + 1e-5);
}

torch::Tensor trait_changes(const torch::Tensor& before, const torch::Tensor& after) {
  return traits_of(after) - traits_of(before);
}

Guides train_guides(const std::vector<Take>& takes, const SampleSet& set,
                    const std::vector<int>& choice, const std::vector<std::string>& styles,
                    const GuidanceSettings& settings, uint64_t seed) {
  std::set<int> used;
  for (const int i : choice) {
    const Sample& sample = set.samples()[i];
    used.insert(sample.take);
    if (sample.styled >= 0) used.insert(sample.styled);
  }
  std::vector<Take> known;
  std::vector<std::string> labels;
  for (const int t : used) {
    known.push_back(takes[t]);
    labels.push_back(takes[t].row.style);
  }
  std::vector<std::string> classes = styles;
  classes.push_back("neutral");
  const ClassifierSettings networks = {
      .hidden = 128, .networks = settings.guides, .steps = settings.guide_steps, .disturbed = true};
  return {Classifier(known, labels, classes, seed, networks),
          StatisticsGuide(known, labels, classes)};
}

Guidance::Guidance(const SampleSet& set, const std::vector<int>& choice, const OutputUnits& units,
                   const UnlabelledMotion& motion, Guides guides,
                   const std::vector<const Signature*>& signatures,
                   const GuidanceSettings& settings, float input_clip)
    : motion_(motion),
      guides_(std::move(guides)),
      settings_(settings),
      styles_(static_cast<int>(signatures.size())),
      input_clip_(input_clip > 0 ? input_clip : INFINITY),
      input_units_(set.units()) {
  input_mean_ = torch::tensor(set.mean()).repeat({kWindowPoses});
  input_factor_ = 1 / torch::tensor(set.scale()).repeat({kWindowPoses});
  output_scale_ = torch::tensor(units.scale);

  const int64_t outputs = set.outputs();
  std::map<std::pair<int, std::string>, std::vector<int>> cells;
  for (const int i : choice) {
    const Sample& sample = set.samples()[i];
    if (sample.style >= 0) cells[{sample.style, set.content(sample)}].push_back(i);
  }
  torch::Tensor sum = torch::zeros({styles_, outputs}), squares = torch::zeros({styles_, outputs});
  torch::Tensor count = torch::zeros({styles_, 1});
  for (const auto& [cell, samples] : cells) {
    torch::Tensor rows = torch::empty({static_cast<int64_t>(samples.size()), outputs});
    float* row = rows.data_ptr<float>();
    for (const int i : samples) {
      std::copy_n(set.target(i).begin(), outputs, row);
      row += outputs;
    }
    rows = rows / output_scale_;
    sum[cell.first] += rows.mean(0);
    squares[cell.first] += rows.square().mean(0);
    count[cell.first] += 1;
  }
  count.clamp_min_(1);
  style_mean_ = sum / count;
  style_deviation_ = ((squares / count - style_mean_.square()).clamp_min(0) +
                      kMinStyleDeviation * kMinStyleDeviation)
                         .sqrt();

  signature_ = torch::zeros({styles_, kGuidedTraits});
  tolerance_ = torch::full({styles_, kGuidedTraits}, INFINITY);
  tempo_ = torch::zeros({styles_});
  tempo_tolerance_ = torch::full({styles_}, INFINITY);
  for (int s = 0; s < styles_; ++s) {
    if (!signatures[s]) continue;
    const Signature& real = *signatures[s];
    for (int t = 0; t < kGuidedTraits; ++t) {
      signature_[s][t] = real.change[t];
      tolerance_[s][t] = tolerance_of(real, t);
    }
    if (!real.certain[kTempoTrait]) continue;
    tempo_[s] = real.change[kTempoTrait] / 100;
    tempo_tolerance_[s] = tolerance_of(real, kTempoTrait) / 100;
  }
}

torch::Tensor Guidance::normalised(const torch::Tensor& windows) const {
  return ((windows - input_mean_) * input_factor_).clamp(-input_clip_, input_clip_);
}

torch::Tensor Guidance::windows(int sequences, Random& random) const {
  const torch::Tensor raw =
      torch::empty({int64_t{sequences} * kSequenceInstants, kWindowPoses * kNumbers});
  for (int s = 0; s < sequences; ++s) {
    float* first = raw.data_ptr<float>() + size_t(s) * kSequenceNumbers;
    motion_.draw(settings_.spliced, random,
                 std::span<float, kSequenceNumbers>(first, kSequenceNumbers));
  }
  return normalised(raw);
}

Guidance::Drawn Guidance::draw(Random& random) const {
  const int64_t n = settings_.sequences;
  std::vector<int64_t> styles(n);
  for (int64_t& style : styles) style = random.below(static_cast<uint32_t>(styles_));
  std::sort(styles.begin(), styles.end());
  Drawn drawn{torch::empty({n * kSequenceInstants, kWindowPoses * kNumbers}), torch::tensor(styles),
              std::vector<int64_t>(styles_)};
  for (const int64_t style : styles) drawn.group_sizes[style] += kSequenceInstants;
  float* first = drawn.windows.data_ptr<float>();
  for (int64_t s = 0; s < n; ++s, first += kSequenceNumbers) {
    const std::span<float, kSequenceNumbers> sequence(first, kSequenceNumbers);
    motion_.draw(settings_.spliced, random, sequence);
    disturb(draw_disturbance(settings_.disturbance, input_units_, random), settings_.disturbance,
            random, sequence);
  }
  return drawn;
}

torch::Tensor Guidance::loss(const NetworkTrainer& pose, double share, Random& random) const {
  const int64_t n = settings_.sequences, rows = n * kSequenceInstants;
  const auto& [raw, asked, groups] = draw(random);
  const torch::Tensor answer = pose.forward(normalised(raw), groups, &random);
  const torch::Tensor change = answer * output_scale_;

  const torch::Tensor in = raw.slice(1, 0, 3 * kHumanJoints).view({rows, kHumanJoints, 3});
  const torch::Tensor out = styled_bodies(in, change);
  const torch::Tensor root = raw.slice(1, 3 * kHumanJoints, kNumbers);
  const torch::Tensor root_change = change.slice(1, kHipsHeight + 1);

  const torch::Tensor seen =
      torch::cat({out.reshape({rows, 3 * kHumanJoints}), root + root_change}, 1)
          .view({n, kClassifiedInputs});
  const torch::Tensor style = guides_.networks.loss(seen, asked, kLabelSmoothing, random);
  const auto sequences = [&](const torch::Tensor& positions) {
    return positions.view({n, kSequenceInstants, kHumanJoints, 3});
  };
  const torch::Tensor velocity = velocity_loss(sequences(in), sequences(out));
  const torch::Tensor statistics = guides_.statistics.loss(sequences(out), asked, kLabelSmoothing);
  const torch::Tensor signature =
      beyond_tolerance(trait_changes(sequences(in), sequences(out)),
                       signature_.index_select(0, asked), tolerance_.index_select(0, asked))
          .mean();
  const auto some_instants = [&](const torch::Tensor& positions) {
    return sequences(positions)
        .slice(1, 0, kSequenceInstants, kAnatomyStride)
        .reshape({-1, kHumanJoints, 3});
  };
  const auto by_instant = [&](const torch::Tensor& numbers) {
    return numbers.view({n, kSequenceInstants, -1});
  };
  const torch::Tensor standing =
      standing_loss(sequences(in), sequences(out), by_instant(root), by_instant(root_change));
  const torch::Tensor anatomy = anatomy_loss(some_instants(in), some_instants(out));
  const torch::Tensor by_time = by_instant(answer);
  const torch::Tensor smooth = (by_time.slice(1, 1) - by_time.slice(1, 0, -1)).square().mean();
  const torch::Tensor index = asked.repeat_interleave(kSequenceInstants);
  const torch::Tensor apart =
      (answer - style_mean_.index_select(0, index)).abs() / style_deviation_.index_select(0, index);
  const torch::Tensor prior = (apart - 1).relu().square().mean();

  const double ramp = std::min(1.0, share / settings_.ramp);
  return ramp * (settings_.style * style + settings_.statistics * statistics +
                 settings_.velocity * velocity + settings_.smoothness * smooth +
                 settings_.balance * balance_loss(in, out) + settings_.prior * prior +
                 settings_.signature * signature + settings_.anatomy * anatomy +
                 settings_.standing * standing);
}

torch::Tensor Guidance::tempo_loss(const NetworkTrainer& timing, double share,
                                   Random& random) const {
  const auto& [raw, asked, groups] = draw(random);
  const torch::Tensor tempo = timing.forward(normalised(raw), groups, &random)
                                  .view({settings_.sequences, kSequenceInstants})
                                  .mean(1);
  const torch::Tensor off = beyond_tolerance(tempo, tempo_.index_select(0, asked),
                                             tempo_tolerance_.index_select(0, asked));
  return std::min(1.0, share / settings_.ramp) * settings_.tempo * off.mean();
}

}  // namespace panache
