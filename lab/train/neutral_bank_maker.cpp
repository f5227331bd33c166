#include "train/neutral_bank_maker.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include <torch/torch.h>

#include "base/parallel.h"
#include "base/random.h"
#include "learn/neutral_bank.h"
#include "pose/features.h"
#include "train/network.h"
#include "train/persons.h"

namespace panache {
namespace {

constexpr int64_t kMoments = 60000;    // Searched, plus as many mirrored.
constexpr int64_t kPrototypes = 3000;  // Tried; some have too few people.
constexpr int64_t kAround = 400;       // Nearest moments whose people a prototype gets.
constexpr int kPhaseFrames = 8;        // Range for shifting a person's moment to fit better.
constexpr double kGaitWeight = 4;
constexpr double kKnown = 0.75;  // Quantile of the distances of neutral motion.
constexpr int kMinFrames = 30;
constexpr float kWidest = 127;

bool is_walk_or_run(const Take& take) {
  const auto has = [&](const char* word) {
    return take.row.content.find(word) != std::string::npos;
  };
  return has("walk") || has("run") || has("jog");
}

Take mirror_take(Take take) {
  for (HumanPositions& body : take.body) body = mirrored(body);
  mirror_poses(PoseLayout::positions, take.pose_features);
  for (FootContacts& contacts : take.contacts) std::swap(contacts[0], contacts[1]);
  return take;
}

struct Moment {
  int take, frame;
};

std::vector<Moment> draw_moments(const std::vector<Take>& takes, const std::vector<int>& people,
                                 Random& random) {
  std::map<int, double> frames, all;
  for (size_t t = 0; t < takes.size(); ++t) frames[people[t]] += takes[t].frames();
  const auto weight = [&](size_t t) {
    return (is_walk_or_run(takes[t]) ? kGaitWeight : 1) / std::sqrt(frames[people[t]]);
  };
  for (size_t t = 0; t < takes.size(); ++t) {
    all[takes[t].row.set] += weight(t) * takes[t].frames();
  }
  std::vector<double> ends;
  double end = 0;
  for (size_t t = 0; t < takes.size(); ++t) {
    ends.push_back(end += weight(t) * takes[t].frames() / all[takes[t].row.set]);
  }
  std::vector<Moment> moments;
  for (int64_t i = 0; i < kMoments; ++i) {
    const auto at =
        std::upper_bound(ends.begin(), ends.end() - 1, static_cast<double>(random.uniform()) * end);
    const auto t = static_cast<int>(at - ends.begin());
    moments.push_back(
        {t, static_cast<int>(random.below(static_cast<uint32_t>(takes[t].frames())))});
  }
  return moments;
}

}  // namespace

MadeBank make_neutral_bank(const std::vector<Take>& all, uint64_t seed) {
  torch::NoGradGuard no_gradients;
  std::vector<Take> takes;
  std::vector<int> people;
  std::map<std::string, int> numbers;
  for (const Take& take : all) {
    if (take.frames() < kMinFrames) continue;
    takes.push_back(take);
    people.push_back(
        numbers.try_emplace(person_of(take), static_cast<int>(numbers.size())).first->second);
  }
  Random random(seed);
  const std::vector<Moment> picked = draw_moments(takes, people, random);
  std::vector<Take> exchanged;
  for (const Take& take : takes) exchanged.push_back(mirror_take(take));
  const int64_t count = 2 * kMoments;
  torch::Tensor moments = torch::empty({count, kMomentFeatures});
  std::vector<int> person(count);
  parallel_for(static_cast<int>(count), [&](int i) {
    const Moment& at = picked[i % kMoments];
    const Take& take = (i < kMoments ? takes : exchanged)[at.take];
    write_moment(take, static_cast<float>(at.frame), 1,
                 {moments.data_ptr<float>() + int64_t{i} * kMomentFeatures, kMomentFeatures});
    person[i] = people[at.take];
  });
  // Principal components (Pearson 1901).
  const torch::Tensor mean = moments.mean(0), centred = moments - mean;
  const torch::Tensor covariance =
      centred.t().matmul(centred).to(torch::kFloat64) / static_cast<double>(count);
  const torch::Tensor directions = std::get<1>(torch::linalg_eigh(covariance))
                                       .slice(1, kMomentFeatures - NeutralBank::kDirections)
                                       .to(torch::kFloat32);
  const torch::Tensor projections = centred.matmul(directions);

  const torch::Tensor medoids = torch::tensor([&] {
    std::vector<int64_t> drawn;
    for (int64_t p = 0; p < kPrototypes; ++p) {
      drawn.push_back(random.below(static_cast<uint32_t>(count)));
    }
    return drawn;
  }());
  // Moments are drawn at random; that of a person may fit best a few frames earlier or later.
  const auto refine = [&](int64_t moment, const torch::Tensor& wanted) {
    const Moment& at = picked[moment % kMoments];
    const Take& take = (moment < kMoments ? takes : exchanged)[at.take];
    const int first = std::max(0, at.frame - kPhaseFrames);
    const int last = std::min(take.frames() - 1, at.frame + kPhaseFrames);
    torch::Tensor near = torch::empty({last - first + 1, kMomentFeatures});
    for (int f = first; f <= last; ++f) {
      write_moment(
          take, static_cast<float>(f), 1,
          {near.data_ptr<float>() + int64_t{f - first} * kMomentFeatures, kMomentFeatures});
    }
    near = (near - mean).matmul(directions);
    const auto best = (near - wanted).square().sum(1).argmin().item<int64_t>();
    const float* pose = &take.pose_features[size_t(first + best) * NeutralBank::kPoseNumbers];
    return torch::cat(
        {near[best], torch::tensor(std::vector<float>(pose, pose + NeutralBank::kPoseNumbers))});
  };
  std::vector<torch::Tensor> rows;
  std::vector<float> members;
  constexpr int64_t kBlock = 250;
  for (int64_t begin = 0; begin < kPrototypes; begin += kBlock) {
    const torch::Tensor from = projections.index_select(0, medoids.slice(0, begin, begin + kBlock));
    const torch::Tensor near = std::get<1>(torch::cdist(from, projections).topk(kAround, 1, false));
    for (int64_t r = 0; r < near.size(0); ++r) {
      std::vector<int64_t> chosen;
      std::set<int> met;
      for (int64_t k = 0; k < kAround && chosen.size() < size_t{NeutralBank::kPeople}; ++k) {
        const int64_t moment = near[r][k].item<int64_t>();
        if (met.insert(person[moment]).second) chosen.push_back(moment);
      }
      if (chosen.size() < size_t{NeutralBank::kMinPeople}) continue;
      std::vector<torch::Tensor> fitted;
      for (const int64_t moment : chosen) fitted.push_back(refine(moment, from[r]));
      const torch::Tensor each = torch::stack(fitted), middle = each.mean(0);
      const torch::Tensor apart =
          (each - middle)
              .slice(1, NeutralBank::kDirections, NeutralBank::kDirections + 3 * kHumanJoints);
      rows.push_back(torch::cat(
          {middle, apart.reshape({-1, kHumanJoints, 3}).square().sum(2).mean(0).sqrt()}));
      for (size_t k = 0; k < size_t{NeutralBank::kPeople}; ++k) {
        members.push_back(k < chosen.size() ? static_cast<float>(person[chosen[k]]) : -1.0f);
      }
    }
  }
  const torch::Tensor table = torch::stack(rows);
  const auto prototypes = table.size(0);

  // Distances of moments from prototypes of other people.
  std::vector<float> distances;
  const int64_t step = count / 1000;
  for (int64_t i = 0; i < count; i += step) {
    torch::Tensor far = (table.slice(1, 0, NeutralBank::kDirections) - projections[i]).norm(2, 1);
    float min = 1e9f;
    for (int64_t p = 0; p < prototypes; ++p) {
      const auto of = members.begin() + p * NeutralBank::kPeople;
      if (std::find(of, of + NeutralBank::kPeople, static_cast<float>(person[i])) !=
          of + NeutralBank::kPeople) {
        continue;
      }
      min = std::min(min, far[p].item<float>());
    }
    distances.push_back(min);
  }
  std::sort(distances.begin(), distances.end());

  MadeBank made;
  made.prototypes = static_cast<size_t>(prototypes);
  made.people = numbers.size();
  const torch::Tensor offset = table.mean(0), apart = table - offset;
  const torch::Tensor scale = std::get<0>(apart.abs().max(0)) / kWidest + 1e-9;
  auto& tensors = made.file.tensors;
  tensors["rows"] = to_tensor((apart / scale).round());
  tensors["rows"].int8 = true;
  tensors["rows.scale"] = to_tensor(scale.unsqueeze(0));
  tensors["rows.offset"] = to_tensor(offset.unsqueeze(0));
  tensors["people"] = {{prototypes, NeutralBank::kPeople}, members, false, true};
  tensors["mean"] = to_tensor(mean.unsqueeze(0));
  tensors["directions"] = to_tensor(directions);
  tensors["directions"].half = true;
  tensors["known"] = {
      {1, 1}, {distances[static_cast<size_t>(kKnown * static_cast<double>(distances.size()))]}};
  made.file.metadata["format"] = "panache-neutral";
  made.file.metadata["people"] = std::to_string(made.people);
  return made;
}

}  // namespace panache
