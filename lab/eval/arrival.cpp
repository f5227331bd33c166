#include "eval/arrival.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <optional>
#include <set>

#include "base/parallel.h"
#include "eval/report_numbers.h"
#include "walker/walker.h"

namespace panache {
namespace {

constexpr double kVisibleSide = 0.015;  // Metres: smaller ones are not seen.
// Of the side of training takes, in test takes: styles with less of it have theirs by chance.
constexpr double kOwnSide = 0.5;
constexpr double kInStep = 0.3;  // Steps a second beyond the real takes' range.

bool walks(const Take& take) {
  return take.row.content == kWalk && take.frames() >= static_cast<int>(kTakeRate);
}

std::vector<double> column(const std::vector<Movement>& rows, size_t trait) {
  std::vector<double> values;
  values.reserve(rows.size());
  for (const Movement& row : rows) values.push_back(row[trait]);
  return values;
}

Movement median_of(const std::vector<Movement>& rows) {
  Movement out;
  for (size_t t = 0; t < out.size(); ++t) out[t] = quantile(column(rows, t), 0.5);
  return out;
}

SideVector mean_of(const std::vector<SideVector>& sides) {
  SideVector sum;
  double count = 0;
  for (const SideVector& side : sides) {
    if (side.empty()) continue;
    sum.resize(side.size());
    for (size_t i = 0; i < side.size(); ++i) sum[i] += side[i];
    ++count;
  }
  for (Vec3& v : sum) v = v * static_cast<float>(1 / count);
  return sum;
}

SideVector difference(const SideVector& a, const SideVector& b) {
  SideVector out;
  for (size_t i = 0; i < std::min(a.size(), b.size()); ++i) out.push_back(a[i] - b[i]);
  return out;
}

double dot_of(const SideVector& a, const SideVector& b) {
  double sum = 0;
  for (size_t i = 0; i < std::min(a.size(), b.size()); ++i) sum += double{dot(a[i], b[i])};
  return sum;
}

Movement change_of(const Movement& from, const Movement& to) {
  Movement out;
  for (size_t t = 0; t < out.size(); ++t) out[t] = to[t] - from[t];
  return out;
}

// What several takes have, and what they had as inputs.
struct Gaits {
  std::vector<Movement> movement;
  std::vector<SideVector> side;
  void add(const Take& take) {
    movement.push_back(movement_of(take));
    side.push_back(side_of(take));
  }
};

Gaits gaits_of(const std::vector<const Take*>& takes) {
  Gaits out;
  for (const Take* take : takes) out.add(*take);
  return out;
}

using Look = std::vector<Vec3>;

// Mean positions of the joints about the hips, height of the hips, and deviations, metres.
Look look_of(const Take& take) {
  Look out(2 * kHumanJoints);
  const float share = 1 / static_cast<float>(take.frames());
  const auto position = [&](int f, int j) {
    return j == 0 ? Vec3{0, take.body[f][0].y, 0} : take.body[f][j] - take.body[f][0];
  };
  for (int j = 0; j < kHumanJoints; ++j) {
    for (int f = 0; f < take.frames(); ++f) out[j] += position(f, j) * share;
    Vec3 squares;
    for (int f = 0; f < take.frames(); ++f) {
      const Vec3 off = position(f, j) - out[j];
      squares += Vec3{off.x * off.x, off.y * off.y, off.z * off.z} * share;
    }
    out[kHumanJoints + j] = {std::sqrt(squares.x), std::sqrt(squares.y), std::sqrt(squares.z)};
  }
  return out;
}

// Mean over the joints, cm.
double apart_cm(const Look& a, const Look& b) {
  if (a.empty() || b.empty()) return kNotMeasured;
  double sum = 0;
  for (size_t i = 0; i < a.size(); ++i) sum += double{length(a[i] - b[i])};
  return 100 * sum / kHumanJoints;
}

// What the looks of `to`, on average, have and those of `from` do not; empty if either has none.
Look change_of_look(const std::vector<const Take*>& from, const std::vector<const Take*>& to) {
  if (from.empty() || to.empty()) return {};
  Look out(2 * kHumanJoints);
  const auto add = [&](const std::vector<const Take*>& takes, float weight) {
    for (const Take* take : takes) {
      const Look look = look_of(*take);
      for (size_t i = 0; i < out.size(); ++i) {
        out[i] += look[i] * (weight / static_cast<float>(takes.size()));
      }
    }
  };
  add(to, 1), add(from, -1);
  return out;
}

// The shares of `real` and `side`, changes of real takes, that the given changes have.
ArrivedShares shares_of(const Movement& real, const SideVector& side, const Movement& change,
                        const SideVector& side_change) {
  ArrivedShares out;
  out.movement.fill(kNotMeasured);
  for (size_t t = 0; t < real.size(); ++t) {
    if (std::abs(real[t]) > kMovementTraits[t].visible) out.movement[t] = change[t] / real[t];
  }
  if (side_size(side) > kVisibleSide && !side_change.empty())
    out.side = dot_of(side_change, side) / dot_of(side, side);
  return out;
}

}  // namespace

WalkSet::WalkSet(const std::vector<Take>& training, const std::vector<Take>& test,
                 const std::vector<TestInput>& neutral, const std::vector<TestInput>& others,
                 const std::vector<TestInput>& walker) {
  std::map<std::string, Real> styles;
  const auto sort = [&](const Take& take, bool is_test) {
    if (!walks(take)) return;
    if (take.row.neutral) {
      if (!is_test) neutral_.push_back(&take);  // Those of the test split are inputs.
      return;
    }
    Real& real = styles.try_emplace(take.row.style, Real{take.row.style, take.row.set, {}, {}})
                     .first->second;
    if (real.performer != take.row.set) real.performer = -1;
    (is_test ? real.test : real.training).push_back(&take);
  };
  for (const Take& take : training) sort(take, false);
  for (const Take& take : test) sort(take, true);
  for (auto& [name, real] : styles) {
    if (!real.training.empty()) styles_.push_back(std::move(real));
  }
  const auto pick = [](const std::vector<TestInput>& from, std::vector<const TestInput*>& to) {
    for (const TestInput& input : from) {
      if (walks(input.take)) to.push_back(&input);
    }
  };
  pick(neutral, own_);
  for (const TestInput* input : own_) neutral_.push_back(&input->take);
  pick(others, others_);
  pick(walker, walker_);
}

std::vector<const TestInput*> WalkSet::inputs_of(const Real& real, Walks walks) const {
  if (walks == Walks::walker) return walker_;
  std::vector<const TestInput*> own, others = others_;
  std::set<int> seen;
  for (const TestInput* input : own_) {
    const bool is_own = input->take.row.set == real.performer;
    if (is_own) own.push_back(input);
    // One walk of each other performer.
    if (!is_own && seen.insert(input->take.row.set).second) others.push_back(input);
  }
  // A performer without a neutral walk: others stand in.
  if (walks == Walks::own) return own.empty() ? others : own;
  return others;
}

// Neutral walks of the performer, or of all performers where there are none.
std::vector<const Take*> WalkSet::neutral_of(const Real& real) const {
  std::vector<const Take*> own;
  for (const Take* take : neutral_) {
    if (take->row.set == real.performer) own.push_back(take);
  }
  return own.empty() ? neutral_ : own;
}

Result<std::vector<StyleArrival>> WalkSet::measure(const System& system) const {
  std::map<const TestInput*, Gaits> before;
  for (const auto* list : {&own_, &others_, &walker_}) {
    for (const TestInput* input : *list) before[input].add(input->take);
  }
  std::vector<StyleArrival> out(styles_.size());
  // On the walker's first walk, and what real takes change.
  std::vector<Look> looks(styles_.size()), real_looks(styles_.size());
  std::optional<Error> failed;
  std::mutex mutex;
  parallel_for(static_cast<int>(styles_.size()), [&](int s) {
    const Real& real = styles_[s];
    StyleArrival& style = out[s];
    style.style = real.style;
    const std::vector<const Take*> neutral = neutral_of(real);
    real_looks[s] = change_of_look(neutral, real.training);
    const Gaits is = gaits_of(real.training), was = gaits_of(neutral), test = gaits_of(real.test);
    style.change = change_of(median_of(was.movement), median_of(is.movement));
    const SideVector side = difference(mean_of(is.side), mean_of(was.side));
    style.side_cm = 100 * side_size(side);
    std::vector<double> steps = column(is.movement, kStepsTrait);
    for (const Movement& take : test.movement) steps.push_back(take[kStepsTrait]);
    std::erase_if(steps, [](double value) { return std::isnan(value); });
    if (!steps.empty()) {
      style.slowest = *std::ranges::min_element(steps);
      style.fastest = *std::ranges::max_element(steps);
    }
    style.real =
        shares_of(style.change, side, change_of(median_of(was.movement), median_of(test.movement)),
                  difference(mean_of(test.side), mean_of(was.side)));
    style.real.steps = quantile(column(test.movement, kStepsTrait), 0.5);
    for (const Walks walks : {Walks::own, Walks::others, Walks::walker}) {
      std::vector<Movement> changes;
      std::vector<SideVector> sides;
      std::vector<double> made_steps;
      for (const TestInput* input : inputs_of(real, walks)) {
        const StyleRequest request{real.style, {{real.style, 1.0f}}, true};
        if (!system.can_run(*input, request)) continue;
        Result<RunResult> result = system.run(*input, request);
        if (!result) {
          const std::lock_guard lock(mutex);
          failed = result.error();
          return;
        }
        const Movement made = movement_of(result->output.take);
        const Gaits& from = before.at(input);
        changes.push_back(change_of(from.movement.front(), made));
        sides.push_back(difference(side_of(result->output.take), from.side.front()));
        made_steps.push_back(made[kStepsTrait]);
        if (walks == Walks::walker && looks[s].empty()) looks[s] = look_of(result->output.take);
      }
      ArrivedShares& shares = style.made[static_cast<size_t>(walks)];
      shares = shares_of(style.change, side, median_of(changes), mean_of(sides));
      shares.steps = quantile(made_steps, 0.5);
    }
  });
  if (failed) return *failed;
  for (size_t s = 0; s < out.size(); ++s) {
    if (looks[s].empty()) continue;
    out[s].from_input_cm = apart_cm(looks[s], look_of(walker_.front()->take));
    out[s].real_from_neutral_cm = apart_cm(real_looks[s], Look(2 * kHumanJoints));
    for (size_t other = 0; other < out.size(); ++other) {
      const double apart = other == s ? kNotMeasured : apart_cm(looks[s], looks[other]);
      if (std::isnan(apart) || !(std::isnan(out[s].nearest_cm) || apart < out[s].nearest_cm)) {
        continue;
      }
      out[s].nearest_cm = apart, out[s].nearest = out[other].style;
      out[s].real_nearest_cm = apart_cm(real_looks[s], real_looks[other]);
    }
  }
  return out;
}

ArrivalSummary summarize(const std::vector<StyleArrival>& styles,
                         const ArrivedShares& (*shares)(const StyleArrival&)) {
  ArrivalSummary out;
  std::vector<double> all, half, wrong, sides;
  std::array<std::vector<double>, kMovementTraits.size()> traits;
  for (const StyleArrival& style : styles) {
    const ArrivedShares& made = shares(style);
    for (size_t t = 0; t < traits.size(); ++t) {
      if (std::isnan(made.movement[t])) continue;
      traits[t].push_back(made.movement[t]);
      all.push_back(made.movement[t]);
      half.push_back(made.movement[t] < 0.5);
      wrong.push_back(made.movement[t] < 0);
    }
    if (style.real.side >= kOwnSide && !std::isnan(made.side)) sides.push_back(made.side);
    out.in_step += made.steps >= style.slowest - kInStep && made.steps <= style.fastest + kInStep;
  }
  out.traits = all.size();
  out.median = quantile(all, 0.5);
  out.below_half = finite_mean(half);
  out.wrong_sign = finite_mean(wrong);
  for (size_t t = 0; t < traits.size(); ++t) out.by_trait[t] = quantile(traits[t], 0.5);
  out.side = finite_mean(sides);
  out.sided = sides.size();
  return out;
}

Result<std::vector<TestInput>> walker_walks(const std::string& walker_model) {
  Result<std::shared_ptr<const WalkerModel>> model = WalkerModel::load(walker_model);
  if (!model) return model.error();
  std::vector<TestInput> walks;
  for (const float speed : {1.1f, 1.4f, 1.7f}) {
    Clip clip = walk_clip(*model, {.seconds = 6, .fps = 30, .speed = speed});
    Result<Rig> rig = Rig::create(clip);
    if (!rig) return rig.error();
    Take take = make_take(clip, *rig, PoseLayout::positions);
    take.row.path = "walker";
    take.row.content = "walk";
    take.row.neutral = take.row.test = true;
    walks.push_back({std::move(clip), *std::move(rig), std::move(take)});
  }
  return walks;
}

}  // namespace panache
