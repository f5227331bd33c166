#include "learn/pairing.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <span>
#include <tuple>
#include <utility>

#include "base/parallel.h"
#include "net/dense.h"
#include "pose/features.h"
#include "pose/loop.h"

namespace panache {

namespace {

constexpr std::array kKeyJoints = {HumanJoint::chest,           HumanJoint::head,
                                   HumanJoint::left_lower_arm,  HumanJoint::left_hand,
                                   HumanJoint::right_lower_arm, HumanJoint::right_hand,
                                   HumanJoint::left_lower_leg,  HumanJoint::left_foot,
                                   HumanJoint::left_toes,       HumanJoint::right_lower_leg,
                                   HumanJoint::right_foot,      HumanJoint::right_toes};
constexpr int kNumbers = 6 * static_cast<int>(kKeyJoints.size()) + 1;

// Per styled frame the neutral side advances 0 to 3 frames; the distance is multiplied by this.
constexpr float kPenalty[4] = {1.15f, 1.0f, 1.1f, 1.3f};
// It may wait this many frames in a row: a styled action may dwell where the neutral one does not.
constexpr int kMaxWaits = 2;
constexpr int kSmoothFrames = 7;
// Smaller movements are ignored: 5 cm, 0.15 m/s.
constexpr float kStillDistance = 0.05f, kStillSpeed = 0.15f;
constexpr float kFar = 1e30f;
// Short windows always fit a little better. For takes in step they cost at least 0.75 of what long
// ones do; for runs and backward walks that long ones align out of step, 0.14 to 0.68.
constexpr float kOutOfStep = 0.7f;
// Short windows need at least this much of a neutral take to be in step.
constexpr double kMinNeutral = 1.2;
// Feet whose mean distance along the heading is below this take no steps. Metres.
constexpr double kFeetTogether = 0.1;

// Features of a take for the comparison: positions and velocities of the key joints in the body
// frame, and the height of the hips. [frames][kNumbers]
std::vector<float> comparison_numbers(const Take& take) {
  const int frames = take.frames();
  std::vector<float> numbers;
  numbers.reserve(size_t(frames) * kNumbers);
  for (int f = 0; f < frames; ++f) {
    const int a = std::max(f - 1, 0), b = std::min(f + 1, frames - 1);
    for (const HumanJoint joint : kKeyJoints) {
      const int j = index(joint);
      const Vec3 p = take.body[f][j];
      const Vec3 v =
          b > a ? (take.body[b][j] - take.body[a][j]) / static_cast<float>(b - a) : Vec3{};
      for (const float n : {p.x, p.y, p.z, v.x, v.y, v.z}) numbers.push_back(n);
    }
    numbers.push_back(take.body[f][0].y);
  }
  return numbers;
}

// All takes of one action in one style: their features, standardised together, so that the style's
// own posture does not affect the comparison.
struct Group {
  std::vector<int> takes;
  std::vector<float> numbers;  // [frames][kNumbers]
  std::vector<int> begin;      // First frame of each take, and the total.
};

// The noise of a feature that hardly moves must not dominate the others: while a hand is raised,
// only that arm shows the phase of the action.
float still(int number) {
  const bool speed = number + 1 < kNumbers && number % 6 >= 3;
  return speed ? kStillSpeed / static_cast<float>(kTakeRate) : kStillDistance;
}

Group make_group(const std::vector<Take>& takes, std::vector<int> members) {
  Group group;
  group.takes = std::move(members);
  std::vector<float>& all = group.numbers;
  group.begin.push_back(0);
  for (const int t : group.takes) {
    const std::vector<float> numbers = comparison_numbers(takes[t]);
    all.insert(all.end(), numbers.begin(), numbers.end());
    group.begin.push_back(static_cast<int>(all.size()) / kNumbers);
  }
  const double frames = group.begin.back();
  for (int i = 0; i < kNumbers; ++i) {
    double sum = 0, squares = 0;
    for (size_t at = i; at < all.size(); at += kNumbers) {
      sum += all[at];
      squares += double(all[at]) * all[at];
    }
    const double mean = sum / frames, variance = std::max(0.0, squares / frames - mean * mean);
    const double factor = 1 / std::hypot(std::sqrt(variance), still(i));
    for (size_t at = i; at < all.size(); at += kNumbers) {
      all[at] = static_cast<float>((all[at] - mean) * factor);
    }
  }
  return group;
}

// The neutral side of the warping: its frames, and their possible successors.
struct Track {
  int frames = 0;
  // Such that |a - b|^2 / kNumbers = |a|^2 / kNumbers + square[b] + sum of a[i] * factors[i][b].
  std::vector<float> factors, squares;  // [kNumbers][frames], [frames]
  std::vector<float>
      barrier[4];  // barrier[k][j]: 0 where frame j - k is of the same take, else far.
};

Track make_track(const Group& group) {
  Track track;
  track.frames = group.begin.back();
  track.factors.resize(size_t(kNumbers) * track.frames);
  track.squares.resize(track.frames);
  for (int f = 0; f < track.frames; ++f) {
    for (int i = 0; i < kNumbers; ++i) {
      const float number = group.numbers[size_t(f) * kNumbers + i];
      track.factors[size_t(i) * track.frames + f] = -2 * number / kNumbers;
      track.squares[f] += number * number / kNumbers;
    }
  }
  for (int k = 0; k < 4; ++k) {
    track.barrier[k].assign(track.frames, 0.0f);
    for (size_t t = 0; t + 1 < group.begin.size(); ++t) {
      const int end = std::min(group.begin[t] + k, group.begin[t + 1]);
      for (int j = group.begin[t]; j < end; ++j) track.barrier[k][j] = kFar;
    }
  }
  return track;
}

// Warps `rows` styled frames, whose distances to all neutral frames are
// distance[rows][track.frames]. Returns the neutral frame of each and the mean cost; the path is
// empty if every neutral take is too short.
struct Warp {
  std::vector<int> path;
  float cost = 0;
};
Warp warp(const float* distance, int rows, const Track& track, std::vector<float>& before,
          std::vector<float>& after, std::vector<int8_t>& steps) {
  const int m = track.frames;
  constexpr int pad = 4;  // So that j - k needs no check.
  before.assign(m + pad, kFar);
  after.assign(m + pad, kFar);
  steps.assign(size_t(rows) * m, 1);
  std::vector<int8_t> waits(m, 0);  // Number of consecutive waits so far.
  for (int j = 0; j < m; ++j) before[j + pad] = distance[j];
  for (int i = 1; i < rows; ++i) {
    const float* d = distance + size_t(i) * m;
    const float* b = before.data() + pad;
    float* a = after.data() + pad;
    int8_t* step = steps.data() + size_t(i) * m;
    for (int j = 0; j < m; ++j) {
      float best = waits[j] < kMaxWaits ? b[j] + kPenalty[0] * d[j] : kFar;
      int8_t by = 0;
      for (int k = 1; k < 4; ++k) {
        const float cost = b[j - k] + kPenalty[k] * d[j] + track.barrier[k][j];
        by = cost < best ? static_cast<int8_t>(k) : by;
        best = cost < best ? cost : best;
      }
      a[j] = best;
      step[j] = by;
      waits[j] = by == 0 ? static_cast<int8_t>(waits[j] + 1) : int8_t{0};
    }
    std::swap(before, after);
  }
  Warp result;
  const auto end = std::min_element(before.begin() + pad, before.end());
  if (*end >= kFar) return result;
  result.cost = *end / static_cast<float>(rows);
  result.path.resize(rows);
  int j = static_cast<int>(end - before.begin()) - pad;
  for (int i = rows - 1; i >= 0; --i) {
    result.path[i] = j;
    if (i > 0) j -= steps[size_t(i) * m + j];
  }
  return result;
}

// Moving average that keeps the ends' slope: beyond an end the path is continued
// point-symmetrically.
std::vector<float> smooth_path(const std::vector<int>& path, int offset) {
  const int n = static_cast<int>(path.size()), half = std::min(kSmoothFrames / 2, n - 1);
  const auto at = [&](int i) {
    if (i < 0) return 2 * path[0] - path[-i];
    if (i >= n) return 2 * path[n - 1] - path[2 * (n - 1) - i];
    return path[i];
  };
  std::vector<float> smooth(n);
  for (int i = 0; i < n; ++i) {
    int sum = 0;
    for (int k = -half; k <= half; ++k) sum += at(i + k) - offset;
    smooth[i] = static_cast<float>(sum) / static_cast<float>(2 * half + 1);
  }
  return smooth;
}

std::vector<float> slopes(const std::vector<float>& path) {
  const int n = static_cast<int>(path.size());
  std::vector<float> rates(n, 1.0f);
  for (int i = 0; i < n && n > 1; ++i) {
    const int a = std::max(i - 1, 0), b = std::min(i + 1, n - 1);
    rates[i] = (path[b] - path[a]) / static_cast<float>(b - a);
  }
  return rates;
}

// Distances of `frames` frames of a group, from `begin` on, to all neutral frames: the mean over
// the features of their squared difference. [frames][track.frames]
std::vector<float> distances(const Group& styled, int begin, int frames, const Track& track) {
  const size_t columns = track.frames;
  std::vector<float> distance(size_t(frames) * columns);
  const size_t rows = frames;
  const float* first = &styled.numbers[size_t(begin) * kNumbers];
  dense_rows({first, rows, kNumbers}, kNumbers, track.factors, track.squares,
             {distance.data(), rows, columns});
  for (size_t r = 0; r < rows; ++r) {
    const float own = square_length({first + r * kNumbers, kNumbers}) / kNumbers;
    for (size_t c = 0; c < columns; ++c) {
      float& d = distance[r * columns + c];
      d = std::max(0.0f, d + own);
    }
  }
  return distance;
}

// Pairs one styled take, number `which` of its group, in windows of the given lengths.
std::vector<Pairing> pair_windows(const Group& styled, int which, const Group& neutral,
                                  const Track& track, std::span<const float> distance,
                                  const PairingOptions& options) {
  const int frames = styled.begin[which + 1] - styled.begin[which];
  const int window = std::min(static_cast<int>(options.window_seconds * kTakeRate), frames);
  const int hop = static_cast<int>(options.hop_seconds * kTakeRate);
  std::vector<Pairing> pairings;
  std::vector<float> before, after;
  std::vector<int8_t> steps;
  for (int first = 0;; first += hop) {
    first = std::min(first, frames - window);
    const Warp warped =
        warp(&distance[size_t(first) * track.frames], window, track, before, after, steps);
    if (warped.path.empty()) return pairings;
    const int take = static_cast<int>(std::upper_bound(neutral.begin.begin(), neutral.begin.end(),
                                                       warped.path.front()) -
                                      neutral.begin.begin()) -
                     1;
    Pairing pairing;
    pairing.styled = styled.takes[which];
    pairing.neutral = neutral.takes[take];
    pairing.first = first;
    pairing.neutral_frames = smooth_path(warped.path, neutral.begin[take]);
    pairing.rates = slopes(pairing.neutral_frames);
    pairing.cost = warped.cost;
    pairings.push_back(std::move(pairing));
    if (first == frames - window) return pairings;
  }
}

std::vector<Pairing> pair_take(const Group& styled, int which, const Group& neutral,
                               const Track& track, const PairingOptions& options) {
  const int begin = styled.begin[which], frames = styled.begin[which + 1] - begin;
  const std::vector<float> distance = distances(styled, begin, frames, track);
  std::vector<Pairing> wanted = pair_windows(styled, which, neutral, track, distance, options);
  const double cost = mean_cost(wanted);
  int longest = 0;
  for (size_t t = 0; t < neutral.takes.size(); ++t) {
    longest = std::max(longest, neutral.begin[t + 1] - neutral.begin[t]);
  }
  const bool fits = longest >= kMinNeutral * kShortWindows.window_seconds * kTakeRate;
  if (cost < kGoodMatch || !fits) return wanted;
  std::vector<Pairing> in_short =
      pair_windows(styled, which, neutral, track, distance, kShortWindows);
  return mean_cost(in_short) < kOutOfStep * cost ? in_short : wanted;
}

}  // namespace

std::optional<double> step_agreement(const std::vector<Take>& takes,
                                     const std::vector<Pairing>& pairings) {
  const auto ahead = [](const Take& take, float frame) {
    const HumanPositions& body =
        take.body[std::clamp(static_cast<int>(std::lround(frame)), 0, take.frames() - 1)];
    return double(body[index(HumanJoint::left_foot)].z - body[index(HumanJoint::right_foot)].z);
  };
  double sum = 0, max = 0, neutral_sum = 0, styled_sum = 0, count = 0;
  for (const Pairing& pairing : pairings) {
    for (size_t i = 0; i < pairing.neutral_frames.size(); ++i) {
      const double neutral = ahead(takes[pairing.neutral], pairing.neutral_frames[i]);
      const double styled =
          ahead(takes[pairing.styled], static_cast<float>(pairing.first + static_cast<int>(i)));
      sum += neutral * styled;
      max += std::abs(neutral * styled);
      neutral_sum += std::abs(neutral);
      styled_sum += std::abs(styled);
      ++count;
    }
  }
  if (!(std::min(neutral_sum, styled_sum) > kFeetTogether * count)) return std::nullopt;
  return sum / max;
}

std::vector<Pairing> pair_takes(const std::vector<Take>& takes, const std::vector<int>& styled,
                                const std::vector<int>& neutral, const PairingOptions& options,
                                const std::function<void(double)>& progress) {
  std::map<std::tuple<int, std::string, std::string>, std::vector<int>>
      cells;                                                               // Set, content, style.
  std::map<std::pair<int, std::string>, std::vector<int>> own;             // Set, content.
  std::map<std::pair<std::string, std::string>, std::vector<int>> shared;  // Manifest, content.
  for (const int t : styled) {
    const ManifestRow& row = takes[t].row;
    cells[{row.set, row.content, row.style}].push_back(t);
  }
  for (const int t : neutral) {
    const ManifestRow& row = takes[t].row;
    own[{row.set, row.content}].push_back(t);
    if (!row.person.empty()) shared[{row.manifest, row.content}].push_back(t);
  }
  const auto references = [&](const ManifestRow& row) -> const std::vector<int>* {
    if (const auto found = own.find({row.set, row.content}); found != own.end()) {
      return &found->second;
    }
    const auto found = shared.find({row.manifest, row.content});
    return row.person.empty() || found == shared.end() ? nullptr : &found->second;
  };
  struct Job {
    std::shared_ptr<const Group> styled;
    int reference;
    int which;
  };
  std::vector<Group> neutral_groups;
  std::vector<Track> tracks;
  std::map<const std::vector<int>*, int> reference_index;
  std::vector<Job> jobs;
  for (auto& [cell, members] : cells) {
    const std::vector<int>* wanted = references(takes[members.front()].row);
    if (!wanted) continue;
    const auto [reference, is_new] =
        reference_index.try_emplace(wanted, static_cast<int>(tracks.size()));
    if (is_new) {
      neutral_groups.push_back(make_group(takes, *wanted));
      tracks.push_back(make_track(neutral_groups.back()));
    }
    const auto group = std::make_shared<const Group>(make_group(takes, members));
    for (size_t i = 0; i < group->takes.size(); ++i) {
      jobs.push_back({group, reference->second, static_cast<int>(i)});
    }
  }
  std::vector<std::vector<Pairing>> found(jobs.size());
  std::atomic<int> done = 0;
  parallel_for(static_cast<int>(jobs.size()), [&](int i) {
    const Job& job = jobs[i];
    found[i] = pair_take(*job.styled, job.which, neutral_groups[job.reference],
                         tracks[job.reference], options);
    const int count = ++done;
    if (progress) progress(double(count) / jobs.size());
  });
  std::vector<Pairing> pairings;
  for (std::vector<Pairing>& some : found) {
    std::move(some.begin(), some.end(), std::back_inserter(pairings));
  }
  return pairings;
}

namespace {

constexpr double kLongestCycle = 2;  // Seconds.
// Maximum distance between the last pose of a cycle and its first, in metres, or in the
// frame-to-frame steps there: a file may omit the frame that repeats the first.
constexpr double kSeam = 0.02, kSeamSteps = 1.6;
// Frames added to a cycle: two windows of a styled take at half its speed.
constexpr int kAddedFrames = 90;
// A pair with less than this cost is in phase. A continued cycle always fits a little better, so it
// must do so by this factor.
constexpr double kInPhase = 0.1, kBetter = 0.9;

template <class T>
void repeat(std::vector<T>& frames, size_t cycle, size_t count) {
  frames.resize(cycle);
  frames.reserve(count);
  for (size_t f = cycle; f < count; ++f) frames.push_back(T(frames[f - cycle]));
}

// `cycle`: from cycle_frames(). The take may end a frame before the cycle does, because of where
// its frames lie.
Take continued(Take take, int cycle) {
  cycle = std::min(cycle, take.frames());
  const RootPose begin = take.root.front();
  RootPose end = take.root.back();
  if (cycle < take.frames()) end = take.root[cycle];
  if (cycle == take.frames()) end = interpolate(take.root[cycle - 2], end, 2);
  const size_t one = cycle, count = 2 * one + kAddedFrames;
  repeat(take.body, one, count);
  repeat(take.rotations, one, count);
  repeat(take.contacts, one, count);
  repeat(take.root, one, count);
  const float turned = end.facing - begin.facing;
  for (size_t f = one; f < count; ++f) {
    const RootPose& before = take.root[f - one];
    take.root[f] = {end.position + rotate(rotation_y(turned), before.position - begin.position),
                    before.facing + turned};
  }
  write_numbers(PoseLayout::positions, take);
  return take;
}

}  // namespace

double mean_cost(const std::vector<Pairing>& pairings) {
  double sum = 0;
  for (const Pairing& pairing : pairings) sum += pairing.cost;
  return pairings.empty() ? kFar : sum / static_cast<double>(pairings.size());
}

int cycle_frames(const Clip& clip, const Rig& rig) {
  const LoopSeam seam = measure_seam(clip, rig);
  if (seam.frames() < 3) return 0;
  const double gap = seam.gap, first_step = seam.first_step, last_step = seam.last_step;
  if (!(gap < std::max(kSeam, kSeamSteps * std::max(first_step, last_step)))) return 0;
  const int steps = seam.frames() + (gap < first_step / 2 ? 0 : 1);
  const double seconds = steps * clip.frame_time;
  return seconds > kLongestCycle ? 0 : static_cast<int>(std::lround(seconds * kTakeRate));
}

std::vector<Pairing> pair_in_phase(std::vector<Take>& takes, int styled, int neutral, int cycle) {
  std::vector<Pairing> found = pair_takes(takes, {styled}, {neutral});
  if (cycle == 0 || mean_cost(found) < kInPhase) return found;
  Take one = continued(takes[neutral], cycle);
  std::swap(one, takes[neutral]);
  std::vector<Pairing> anywhere = pair_takes(takes, {styled}, {neutral});
  if (mean_cost(anywhere) < kBetter * mean_cost(found)) return anywhere;
  takes[neutral] = std::move(one);
  return found;
}

}  // namespace panache
