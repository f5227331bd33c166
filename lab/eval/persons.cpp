#include "eval/persons.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>

#include <torch/torch.h>

#include "base/parallel.h"
#include "eval/discriminant.h"
#include "eval/motion_metrics.h"
#include "eval/report_numbers.h"
#include "eval/report_ood.h"
#include "learn/learn_person.h"
#include "style/restyle.h"
#include "train/persons.h"

namespace panache {
namespace {

constexpr int kJudgedFrames = 60;
constexpr int kNumbers = 6;
constexpr double kEllipsoid = 12.592;  // The 95 % quantile of chi-squared with six degrees.
constexpr int kMinFrames = 45;
constexpr size_t kMinWalks = 3;  // Of a person who is to be told.

HumanPositions mean_pose(const std::vector<HumanPositions>& poses) {
  HumanPositions mean{};
  for (const HumanPositions& pose : poses) {
    for (int j = 0; j < kHumanJoints; ++j) {
      mean[j] += pose[j] * (1 / static_cast<float>(poses.size()));
    }
  }
  return mean;
}

void add_distances(const std::vector<HumanPositions>& poses, std::vector<double>& out) {
  for (size_t a = 0; a < poses.size(); ++a) {
    for (size_t b = 0; b < a; ++b) out.push_back(distance_cm(poses[a], poses[b]));
  }
}

PersonSpread spread_of(const std::vector<double>& distances) {
  return {quantile(distances, 0.5), quantile(distances, 0.9)};
}

// Plain walks: other ones differ by more than the person.
bool is_walk(const Take& take) { return take.row.content == "walk" && take.frames() >= kMinFrames; }

std::vector<float> numbers_of(const HumanPositions& pose) {
  std::vector<float> out;
  for (const Vec3& joint : pose) out.insert(out.end(), {joint.x, joint.y, joint.z});
  return out;
}

int told_class(const torch::Tensor& scores) {
  return static_cast<int>(torch::softmax(scores, 1).mean(0).argmax().item<int64_t>());
}

// The share of the test takes whose label is told. `shifts`: of the training takes, see
// Discriminant, and `shift` of the test takes; or empty.
double told(const std::vector<Take>& training, const std::vector<std::string>& labels,
            const std::vector<Take>& test, const std::vector<std::string>& expected,
            const std::vector<torch::Tensor>& shifts = {}, const torch::Tensor& shift = {}) {
  std::vector<std::string> classes = labels;
  std::sort(classes.begin(), classes.end());
  classes.erase(std::unique(classes.begin(), classes.end()), classes.end());
  const Discriminant judge(training, labels, classes, kJudgedFrames, shifts);
  double right = 0;
  for (size_t t = 0; t < test.size(); ++t) {
    right += classes[static_cast<size_t>(told_class(judge.scores(test[t], shift)))] == expected[t];
  }
  return right / static_cast<double>(test.size());
}

}  // namespace

Result<Take> play_person(const TestInput& input, const std::shared_ptr<const Model>& model,
                         int seed, float variety, int style) {
  RestyleOptions options;
  options.timing = false;
  options.loop = LoopMode::off;
  options.stylizer.gesture_rate = 0;
  if (seed >= 0) {
    options.stylizer.person = person_of_seed(*model, static_cast<uint32_t>(seed), variety);
  }
  std::vector<StrengthTrack> tracks;
  if (style >= 0) tracks.push_back({style, {{0, 1}}});
  const Result<Restyled> restyled = restyle(input.clip, input.rig, model, tracks, options);
  if (!restyled) return restyled.error();
  Take take = make_take(restyled->clip, input.rig, PoseLayout::positions);
  take.row = input.take.row;
  return take;
}

Result<PersonsMeasure> PersonsMeasure::create(const std::vector<Take>& neutral,
                                              std::vector<TestInput> walks) {
  torch::NoGradGuard no_gradients;
  if (walks.size() < 2) return Error{"persons are measured on two walks or more"};
  PersonsMeasure out;
  out.walks_ = std::move(walks);
  std::map<std::string, std::vector<const Take*>> by_person;
  for (const Take& take : neutral) {
    if (take.row.neutral && is_walk(take)) by_person[person_of(take)].push_back(&take);
  }
  std::vector<HumanPositions> means;
  std::vector<double> own, between;
  std::vector<Take> training, test;
  std::vector<std::string> labels, expected;
  for (const auto& [person, takes] : by_person) {
    std::vector<HumanPositions> poses;
    for (const Take* take : takes) poses.push_back(mean_pose(take->body));
    add_distances(poses, own);
    means.push_back(mean_pose(poses));
    if (takes.size() < kMinWalks) continue;
    for (size_t t = 0; t < takes.size(); ++t) {
      const bool last = t + 1 == takes.size();
      (last ? test : training).push_back(*takes[t]);
      (last ? expected : labels).push_back(person);
    }
  }
  if (means.size() <= kNumbers) {
    return Error{"walks of " + std::to_string(means.size()) + " people; expected more than " +
                 std::to_string(kNumbers)};
  }
  add_distances(means, between);
  out.real_.people = means.size();
  out.real_.spread = spread_of(between);
  out.real_.own_cm = quantile(own, 0.5);
  out.real_.told_of = test.size();
  if (test.size() > 1) out.real_.told = told(training, labels, test, expected);

  std::vector<torch::Tensor> rows;
  for (const HumanPositions& pose : means) {
    rows.push_back(torch::tensor(numbers_of(pose)).to(torch::kFloat64));
  }
  torch::Tensor all = torch::stack(rows);
  all = all - all.mean(0);
  const auto [values, vectors] =
      torch::linalg_eigh(all.t().matmul(all) / static_cast<double>(means.size() - 1));
  const int64_t size = values.size(0);
  for (int k = 1; k <= kNumbers; ++k) {
    out.variances_.push_back(values[size - k].item<double>());
    const torch::Tensor direction = vectors.select(1, size - k).to(torch::kFloat32).contiguous();
    out.directions_.emplace_back(direction.data_ptr<float>(),
                                 direction.data_ptr<float>() + direction.size(0));
  }
  out.real_.kept = (values.slice(0, size - kNumbers).sum() / values.sum()).item<double>();
  return out;
}

Result<SeedPersons> PersonsMeasure::measure(const std::shared_ptr<const Model>& model, int seeds,
                                            float variety) const {
  torch::NoGradGuard no_gradients;
  const int walks = static_cast<int>(walks_.size());
  const auto takes = parallel_results<Take>(static_cast<size_t>(seeds * walks), [&](int i) {
    return play_person(walks_[i % walks], model, 1 + i / walks, variety);
  });
  if (!takes) return takes.error();
  SeedPersons out;
  out.seeds = static_cast<size_t>(seeds);
  out.walks = static_cast<size_t>(walks);
  std::vector<double> distances;
  double outside = 0, right = 0;
  // A person is what differs from the unchanged walk.
  std::vector<torch::Tensor> unchanged;
  for (const TestInput& walk : walks_) {
    unchanged.push_back(-Discriminant::mean_statistics(walk.take, kJudgedFrames));
  }
  for (int w = 0; w < walks; ++w) {
    std::vector<HumanPositions> poses;
    std::vector<Take> training, test;
    std::vector<std::string> labels, expected;
    std::vector<torch::Tensor> shifts;
    for (int s = 0; s < seeds; ++s) {
      for (int other = 0; other < walks; ++other) {
        const Take& take = (*takes)[static_cast<size_t>(s * walks + other)];
        (other == w ? test : training).push_back(take);
        (other == w ? expected : labels).push_back(std::to_string(s));
        if (other == w) poses.push_back(mean_pose(take.body));
        if (other != w) shifts.push_back(unchanged[static_cast<size_t>(other)]);
      }
    }
    add_distances(poses, distances);
    right +=
        told(training, labels, test, expected, shifts, unchanged[static_cast<size_t>(w)]) / walks;
    // From the mean person, who is the unchanged input.
    const HumanPositions middle = mean_pose(walks_[w].take.body);
    for (const HumanPositions& pose : poses) {
      double far = 0;
      for (int k = 0; k < kNumbers; ++k) {
        double along = 0;
        for (size_t j = 0; j < kHumanJoints; ++j) {
          const Vec3 apart = pose[j] - middle[j];
          const float* direction = &directions_[k][3 * j];
          along += double{apart.x * direction[0] + apart.y * direction[1] + apart.z * direction[2]};
        }
        far += along * along / variances_[k];
      }
      outside += (far > kEllipsoid) / static_cast<double>(seeds * walks);
    }
  }
  out.spread = spread_of(distances);
  out.told = right;
  out.outside = outside;
  return out;
}

Result<std::vector<double>> measure_retelling(const std::shared_ptr<const Model>& model,
                                              const NeutralBank& bank,
                                              const std::vector<Take>& neutral, size_t& people) {
  if (Result<void> good = check_has_persons(*model); !good) return good.error();
  std::map<std::string, std::vector<const Take*>> by_person;
  for (const Take& take : neutral) {
    if (take.row.neutral && is_walk(take)) by_person[person_of(take)].push_back(&take);
  }
  std::vector<PersonNumbers> first, last;
  for (const auto& [person, takes] : by_person) {
    if (takes.size() < 2) continue;
    const auto one = learn_person(model, bank, {takes.front(), 1});
    const auto other = learn_person(model, bank, {takes.back(), 1});
    if (!one || !other) continue;
    first.push_back(one->numbers), last.push_back(other->numbers);
  }
  people = first.size();
  std::vector<double> out;
  for (size_t a = 0; a < model->persons()->axes(); ++a) {
    double x = 0, y = 0, xx = 0, yy = 0, xy = 0;
    const double count = static_cast<double>(first.size());
    for (size_t p = 0; p < first.size(); ++p) {
      const double u{first[p][a]}, v{last[p][a]};
      x += u / count, y += v / count, xx += u * u / count, yy += v * v / count, xy += u * v / count;
    }
    out.push_back((xy - x * y) / std::sqrt((xx - x * x) * (yy - y * y)));
  }
  return out;
}

Result<std::vector<OodRow>> measure_persons_on(const std::vector<TestInput>& inputs,
                                               const std::shared_ptr<const Model>& model, int seeds,
                                               float variety) {
  const size_t count = inputs.size() * static_cast<size_t>(seeds);
  return parallel_results<OodRow>(count, [&](int i) -> Result<OodRow> {
    const TestInput& input = inputs[static_cast<size_t>(i / seeds)];
    const int seed = 1 + i % seeds;
    const Result<Take> take = play_person(input, model, seed, variety);
    if (!take) return take.error();
    OodRow row = compare_ood(input.take, *take);
    row.clip = std::filesystem::path(input.take.row.path).stem().string();
    row.style = std::to_string(seed);
    return row;
  });
}

ChangeSummary summarize_changes(const std::vector<OodRow>& rows) {
  ChangeSummary out;
  out.clips = rows.size();
  const std::vector<double> jerk = values_of(rows, &OodRow::jerk_ratio);
  out.jerk_median = quantile(jerk, 0.5);
  out.jerk_p90 = quantile(jerk, 0.9);
  out.beyond_limits = finite_mean(values_of(rows, &OodRow::beyond_limits));
  out.more_sliding = finite_mean(values_of(rows, &OodRow::skating_ratio)) -
                     finite_mean(values_of(rows, &OodRow::input_skating_ratio));
  out.cm = finite_mean(values_of(rows, &OodRow::distance_cm));
  std::vector<double> jumps;
  for (const OodRow& row : rows) jumps.push_back(row.jumps);
  out.jumps = finite_mean(jumps);
  return out;
}

Result<StyledPersons> measure_styled_persons(const std::vector<TestInput>& neutral,
                                             const std::vector<std::vector<std::string>>& styles,
                                             const PerformerJudges& judges,
                                             const std::shared_ptr<const Model>& model, int seeds) {
  struct Job {
    size_t input;
    std::string style;
    int index, seed;  // -1: without a person.
  };
  std::vector<Job> jobs;
  for (size_t i = 0; i < neutral.size(); ++i) {
    for (const std::string& style : styles[i]) {
      const Result<int> index = model->find_style(style);
      if (!index) continue;
      for (int seed = 0; seed <= seeds; ++seed) {
        jobs.push_back({i, style, *index, seed == 0 ? -1 : seed});
      }
    }
  }
  auto played = parallel_results<Take>(jobs.size(), [&](int i) {
    const Job& job = jobs[static_cast<size_t>(i)];
    return play_person(neutral[job.input], model, job.seed, 1, job.index);
  });
  if (!played) return played.error();
  std::vector<Take> with, without;
  for (size_t i = 0; i < jobs.size(); ++i) {
    Take& take = (jobs[i].seed < 0 ? without : with).emplace_back(std::move((*played)[i]));
    take.row.style = jobs[i].style;
    take.row.neutral = false;
  }
  const ClipSummary told = summarize_clips(judges.judge(with));
  return StyledPersons{told.clips, told.recognised,
                       summarize_clips(judges.judge(without)).recognised};
}

}  // namespace panache
