#include "learn/learn_person.h"

#include <algorithm>
#include <array>
#include <iterator>

#include "learn/fit_style.h"
#include "learn/pairing.h"
#include "learn/samples.h"
#include "rig/canonical_body.h"
#include "style/networks/networks.h"

namespace panache {
namespace {

constexpr double kWorstPersonMatch = 0.6;  // As in learn_style.cpp.
constexpr int kMaxTake = 300;              // Frames.
constexpr size_t kMaxSamples = 1200;
// The cost of a squared number of the person, in the variance of an axis' outputs: what differs
// from one take to the next.
constexpr double kNumberPenalty = 0.3;
constexpr double kTempoUnit = 0.1;  // Logarithm of the rate that counts as much as 0.25 rad.

// The middle of a take, without twist, which the bank does not know.
Take middle_of_person(const Take& take) {
  const int first = std::max(0, (take.frames() - kMaxTake) / 2);
  const int last = std::min(take.frames(), first + kMaxTake);
  const int numbers = static_cast<int>(take.pose_features.size()) / take.frames();
  Take out;
  out.row = take.row;
  out.body.assign(take.body.begin() + first, take.body.begin() + last);
  out.root.assign(take.root.begin() + first, take.root.begin() + last);
  out.contacts.assign(take.contacts.begin() + first, take.contacts.begin() + last);
  out.pose_features.assign(take.pose_features.begin() + first * numbers,
                           take.pose_features.begin() + last * numbers);
  for (const HumanPositions& body : out.body) {
    canonical_frames(body, 0, out.rotations.emplace_back());
  }
  return out;
}

// A change and a tempo in units that count alike.
std::array<double, StyleDelta::kSize + 1> in_units(const Model& model,
                                                   std::span<const float> change, double log_rate) {
  std::array<double, StyleDelta::kSize + 1> out;
  for (size_t i = 0; i < StyleDelta::kSize; ++i) {
    out[i] = double{change[i]} / double{model.output_scale()[i]};
  }
  out.back() = log_rate / kTempoUnit;
  return out;
}

}  // namespace

PersonMatch match_person(const NeutralBank& bank, const Take& whole) {
  if (whole.frames() < 2) return {};
  Take take = middle_of_person(whole);
  NeutralTwin twin = bank.twin(take, true);
  if (!twin.facts.is_known) return {};
  take.row.neutral = false;
  take.row.style = "person";
  twin.take.row.neutral = true;
  twin.take.row.style = "neutral";
  twin.take.row.set = take.row.set = 0;
  twin.take.row.content = take.row.content;
  PersonMatch out;
  out.takes = {std::move(twin.take), std::move(take)};
  out.pairings = pair_in_phase(out.takes, 1, 0, 0);
  if (mean_cost(out.pairings) > kWorstPersonMatch) return {};
  return out;
}

Result<LearntPerson> learn_person(const std::shared_ptr<const Model>& model,
                                  const NeutralBank& bank, std::span<const Take> takes) {
  if (Result<void> good = check_has_persons(*model); !good) return good.error();
  std::vector<Take> all;
  std::vector<Pairing> pairings;
  for (const Take& take : takes) {
    PersonMatch match = match_person(bank, take);
    const int first = static_cast<int>(all.size());
    std::move(match.takes.begin(), match.takes.end(), std::back_inserter(all));
    for (Pairing& pairing : match.pairings) {
      pairing.neutral += first, pairing.styled += first;
      pairings.push_back(std::move(pairing));
    }
  }
  if (pairings.empty()) {
    return Error{
        "no take shows what other people do, too; give two seconds or more of a plain walk"};
  }
  const SampleSet set(all, pairings, {"person"}, model->recipe(), false);
  const size_t axes = model->persons()->axes(), count = set.samples().size();
  const size_t step = (count + kMaxSamples - 1) / kMaxSamples;
  StyleNetworks networks(model);
  Ridge ridge(static_cast<int>(axes), 1);
  std::vector<float> window(set.inputs());
  std::vector<double> rows, targets;
  double variance = 0;
  for (size_t i = 0; i < count; i += step) {
    set.window(i, window);
    std::vector<double> outputs((StyleDelta::kSize + 1) * axes);
    for (size_t a = 0; a < axes; ++a) {
      PersonNumbers one{};
      one[a] = 1;
      networks.set_person(one);
      networks.forward(window);
      const auto output = in_units(*model, networks.pose(), double{networks.log_rate()});
      for (size_t n = 0; n < output.size(); ++n) {
        outputs[n * axes + a] = output[n];
        variance += output[n] * output[n] / static_cast<double>(axes);
      }
    }
    const Sample& sample = set.samples()[i];
    const auto target = in_units(*model, set.target(i), double{sample.log_rate});
    ridge.add(outputs, target);
    rows.insert(rows.end(), outputs.begin(), outputs.end());
    targets.insert(targets.end(), target.begin(), target.end());
  }
  const std::vector<double> numbers =
      ridge.solve(std::vector<double>(axes, kNumberPenalty * variance + 1e-9));
  LearntPerson out;
  for (size_t a = 0; a < axes; ++a) {
    out.numbers[a] = std::clamp(static_cast<float>(numbers[a]), -kMaxPerson, kMaxPerson);
  }
  double left = 0, whole = 0;
  for (size_t n = 0; n < targets.size(); ++n) {
    double output = 0;
    for (size_t a = 0; a < axes; ++a) output += rows[n * axes + a] * numbers[a];
    left += (targets[n] - output) * (targets[n] - output);
    whole += targets[n] * targets[n];
  }
  out.explained = whole > 0 ? 1 - left / whole : 0;
  for (const Pairing& pairing : pairings) {
    out.seconds += static_cast<double>(pairing.neutral_frames.size()) / kTakeRate / 3;
  }
  return out;
}

}  // namespace panache
