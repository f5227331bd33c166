#include "eval/pose_error.h"

#include <algorithm>
#include <functional>
#include <map>
#include <numbers>

#include "base/parallel.h"
#include "base/progress.h"
#include "style/pose_change.h"
#include "train/samples.h"
#include "train/trainer.h"

namespace panache {
namespace {

// The styled instants to judge, and the neutral instant of each.
struct Instant {
  int styled, frame, neutral;
  float at, rate;
};

std::vector<Instant> aligned_instants(const std::vector<Take>& takes) {
  std::vector<int> styled, neutral;
  for (size_t i = 0; i < takes.size(); ++i) {
    (takes[i].row.neutral ? neutral : styled).push_back(static_cast<int>(i));
  }
  std::vector<Instant> instants;
  for (const Pairing& p : pair_takes(takes, styled, neutral)) {
    const int frames = static_cast<int>(p.neutral_frames.size());
    for (int i = 4; i < frames - 4; ++i) {
      instants.push_back({p.styled, p.first + i, p.neutral, p.neutral_frames[i], p.rates[i]});
    }
  }
  return instants;
}

double angle_between(Quat a, Quat b) {
  return length(log_rotation(conjugate(a) * b)) * 180 / std::numbers::pi;
}

PoseError error_of(const Take& styled, int frame, const HumanPositions& body,
                   const ChangeNumbers& change, const ChangeNumbers& truth,
                   const std::array<Quat, kHumanJoints>& neutral) {
  PoseError error;
  const HumanPositions reached = change_body(body, change);
  for (int j = 0; j < kHumanJoints; ++j) {
    error.cm += 100 * length(reached[j] - styled.body[frame][j]) / kHumanJoints;
    const int parent = kHumanParent[j];
    Quat ours = joint_rotation(change, j) * neutral[j];
    Quat real = joint_rotation(truth, j) * neutral[j];
    if (parent >= 0) {
      ours = conjugate(joint_rotation(change, parent) * neutral[parent]) * ours;
      real = conjugate(joint_rotation(truth, parent) * neutral[parent]) * real;
    }
    error.degrees += angle_between(ours, real) / kHumanJoints;
  }
  return error;
}

// The mean change of each style on the training takes.
Result<std::map<std::string, ChangeNumbers>> mean_postures(const std::vector<ManifestRow>& rows) {
  Result<TrainingData> data = prepare_training(rows, PoseLayout::positions);
  if (!data) return data.error();
  std::map<std::string, std::pair<std::array<double, kChangeNumbers>, double>> sums;
  for (const Pairing& p : data->pairings) {
    const Take& styled = data->takes[p.styled];
    auto& [sum, count] = sums[styled.row.style];
    for (size_t i = 4; i + 4 < p.neutral_frames.size(); ++i) {
      const ChangeNumbers change =
          change_between(styled, p.first + static_cast<int>(i), data->takes[p.neutral],
                         p.neutral_frames[i], std::clamp(p.rates[i], 0.33f, 3.0f));
      for (int n = 0; n < kChangeNumbers; ++n) sum[n] += change[n];
      ++count;
    }
  }
  std::map<std::string, ChangeNumbers> means;
  for (const auto& [style, sum] : sums) {
    ChangeNumbers mean;
    for (int n = 0; n < kChangeNumbers; ++n) {
      mean[n] = static_cast<float>(sum.first[n] / std::max(1.0, sum.second));
    }
    means[style] = mean;
  }
  return means;
}

// What a model makes of one instant; `takes` hold the numbers of the model's layout.
ChangeNumbers model_change(StyleNetworks& networks, const std::vector<Take>& takes,
                           const Instant& at) {
  const int numbers = pose_numbers(networks.model().layout());
  std::vector<float> window(size_t(kWindowPoses) * numbers);
  take_window(takes[at.neutral], at.at, numbers, window);
  networks.forward(window);
  ChangeNumbers change;
  if (networks.model().recipe() == Recipe::panache) {
    std::copy_n(networks.pose().begin(), kChangeNumbers, change.begin());
    return change;
  }
  const std::span<const float> root(&window[numbers - kRootNumbers], kRootNumbers);
  return change_to_pose(networks.pose(), body_at(takes[at.neutral], at.at),
                        root.first<kRootNumbers>());
}

struct Sums {
  std::vector<PoseError> errors;
  size_t frames = 0;
};

}  // namespace

Result<PoseErrorTable> measure_pose_error(const std::vector<ManifestRow>& rows,
                                          const std::vector<NamedModel>& models) {
  std::vector<ManifestRow> test;
  for (const ManifestRow& row : rows) {
    const bool known = row.neutral || std::all_of(models.begin(), models.end(), [&](const auto& m) {
                         return m.model->find_style(row.style).ok();
                       });
    if (row.test && known) test.push_back(row);
  }
  Result<std::vector<Take>> loaded = load_takes(test, PoseLayout::positions);
  if (!loaded) return loaded.error();
  const std::vector<Take>& takes = *loaded;
  std::vector<Take> rotations = takes;
  for (Take& take : rotations) write_numbers(PoseLayout::rotations, take);
  const std::vector<Instant> instants = aligned_instants(takes);
  if (instants.empty()) return Error{"no styled test take has a neutral test take of its content"};
  Result<std::map<std::string, ChangeNumbers>> means = mean_postures(rows);
  if (!means) return means.error();

  PoseErrorTable table;
  table.systems = {"no transfer", "mean posture"};
  for (const NamedModel& m : models) table.systems.push_back(m.name);
  std::map<std::string, Sums> sums;
  std::vector<StyleNetworks> networks;
  for (const NamedModel& m : models) networks.emplace_back(m.model);
  Progress progress("measuring");
  for (size_t i = 0; i < instants.size(); ++i) {
    const Instant& at = instants[i];
    const Take& styled = takes[at.styled];
    const std::string& style = styled.row.style;
    const Take& from = takes[at.neutral];
    const HumanPositions body = body_at(from, at.at);
    const ChangeNumbers truth = change_between(styled, at.frame, from, at.at, 1);
    const std::array<Quat, kHumanJoints> neutral =
        from.turned[std::min(static_cast<int>(at.at + 0.5f), from.frames() - 1)];
    std::vector<ChangeNumbers> changes = {ChangeNumbers{}, (*means)[style]};
    for (size_t m = 0; m < models.size(); ++m) {
      std::vector<float> strengths(models[m].model->styles().size());
      strengths[*models[m].model->find_style(style)] = 1;
      networks[m].set_strengths(strengths);
      const bool positions = models[m].model->layout() == PoseLayout::positions;
      changes.push_back(model_change(networks[m], positions ? takes : rotations, at));
    }
    Sums& sum = sums[style];
    sum.errors.resize(changes.size());
    for (size_t s = 0; s < changes.size(); ++s) {
      const PoseError error = error_of(styled, at.frame, body, changes[s], truth, neutral);
      sum.errors[s].degrees += error.degrees;
      sum.errors[s].cm += error.cm;
    }
    ++sum.frames;
    if (i % 256 == 0)
      progress.update(static_cast<double>(i) / static_cast<double>(instants.size()));
  }
  PoseErrorRow mean{"mean", 0, std::vector<PoseError>(table.systems.size())};
  for (auto& [style, sum] : sums) {
    PoseErrorRow row{style, sum.frames, {}};
    for (size_t s = 0; s < sum.errors.size(); ++s) {
      const double count = static_cast<double>(sum.frames);
      row.errors.push_back({sum.errors[s].degrees / count, sum.errors[s].cm / count});
      mean.errors[s].degrees += row.errors[s].degrees / static_cast<double>(sums.size());
      mean.errors[s].cm += row.errors[s].cm / static_cast<double>(sums.size());
    }
    mean.frames += row.frames;
    table.rows.push_back(std::move(row));
  }
  table.rows.push_back(std::move(mean));
  return table;
}

}  // namespace panache
