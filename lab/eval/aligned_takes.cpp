#include "eval/aligned_takes.h"

#include <algorithm>
#include <optional>

#include "base/parallel.h"
#include "learn/samples.h"

namespace panache {
namespace {

constexpr size_t kInstantsPerPart = 512;  // Work of one thread at a time.

std::vector<AlignedInstant> align(const std::vector<Take>& takes) {
  std::vector<int> styled, neutral;
  for (size_t i = 0; i < takes.size(); ++i) {
    (takes[i].row.neutral ? neutral : styled).push_back(static_cast<int>(i));
  }
  std::vector<AlignedInstant> instants;
  for (const Pairing& pairing : pair_takes(takes, styled, neutral)) {
    const int frames = static_cast<int>(pairing.neutral_frames.size());
    for (int i = kTrimFrames; i < frames - kTrimFrames; ++i) {
      instants.push_back(
          {pairing.styled, pairing.first + i, pairing.neutral, pairing.neutral_frames[i]});
    }
  }
  return instants;
}

}  // namespace

AlignedTakes::AlignedTakes(std::vector<Take> takes)
    : positions_(std::move(takes)), rotations_(positions_), instants_(align(positions_)) {
  parallel_for(static_cast<int>(rotations_.size()),
               [&](int i) { write_numbers(PoseLayout::rotations, rotations_[i]); });
}

PoseErrors AlignedTakes::errors(const System& system, double strength) const {
  return system_errors(system, strength, takes(system.layout()), 1);
}

PoseErrors AlignedTakes::errors(const System& system, double strength,
                                const SeenTakes& seen) const {
  return system_errors(system, strength, seen.takes, seen.speed);
}

PoseErrors AlignedTakes::untouched_errors() const {
  return mean_errors([] { return [](const AlignedInstant&) { return StyleDelta{}; }; });
}

PoseErrors AlignedTakes::system_errors(const System& system, double strength,
                                       const std::vector<Take>& seen, float speed) const {
  if (!system.instants(strength)) return {};
  return mean_errors([&]() -> Answer {
    // Shared, because a std::function must be copyable.
    return [&, answers = std::shared_ptr(system.instants(strength))](const AlignedInstant& i) {
      return answers->change(positions_[i.styled].row.style, seen[i.neutral], i.at / speed,
                             positions_[i.neutral], i.at);
    };
  });
}

PoseErrors AlignedTakes::mean_errors(const std::function<Answer()>& make_answer) const {
  std::vector<std::optional<PoseError>> errors(instants_.size());
  const size_t parts = (instants_.size() + kInstantsPerPart - 1) / kInstantsPerPart;
  parallel_for(static_cast<int>(parts), [&](int part) {
    const Answer answer = make_answer();
    const size_t first = part * kInstantsPerPart;
    for (size_t n = first; n < std::min(first + kInstantsPerPart, instants_.size()); ++n) {
      const AlignedInstant& i = instants_[n];
      if (const std::optional<StyleDelta> change = answer(i)) {
        errors[n] = pose_error(positions_[i.styled], i.frame, positions_[i.neutral], i.at, *change);
      }
    }
  });
  // In order, so that sums do not depend on thread timing.
  PoseErrors means;
  std::map<std::pair<std::string, std::string>, double> counts;
  for (size_t n = 0; n < errors.size(); ++n) {
    if (!errors[n]) continue;
    const ManifestRow& row = positions_[instants_[n].styled].row;
    PoseError& mean = means[{row.style, row.content}];
    mean.degrees += errors[n]->degrees;
    mean.cm += errors[n]->cm;
    ++counts[{row.style, row.content}];
  }
  for (auto& [cell, mean] : means) {
    mean.degrees /= counts[cell];
    mean.cm /= counts[cell];
  }
  return means;
}

}  // namespace panache
