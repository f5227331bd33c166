#include "eval/motion_metrics.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "clip/clip.h"
#include "eval/metrics.h"
#include "learn/samples.h"
#include "takes/load_takes.h"

namespace panache {
namespace {

constexpr double kSkatingRate = 20;              // Frames a second.
constexpr float kLowToe = 0.05f, kSlide = 0.5f;  // m, m/s
constexpr float kWeightHeight = 0.025f;          // m
constexpr float kTravelSpeed = 0.5f;             // m/s
constexpr float kPassMargin = 0.25f;             // In deviations of the feet's distance.

// Height and horizontal speed of a joint from frame f - 1 to f.
struct Slide {
  float height, before, speed;
};
Slide slide_of(const HumanPositions& last, const HumanPositions& now, HumanJoint joint,
               double fps) {
  const Vec3 a = last[index(joint)], b = now[index(joint)];
  return {b.y, a.y, std::hypot(b.x - a.x, b.z - a.z) * static_cast<float>(fps)};
}

std::vector<HumanPositions> world_motion(const Take& take, double fps) {
  std::vector<HumanPositions> world;
  const double step = kTakeRate / fps;
  const int frames =
      take.frames() == 0 ? 0 : 1 + static_cast<int>((take.frames() - 1 + 1e-9) / step);
  world.reserve(static_cast<size_t>(frames));
  for (int f = 0; f < frames; ++f) {
    const double at = f * step;
    const int a = static_cast<int>(at), b = std::min(a + 1, take.frames() - 1);
    const float t = static_cast<float>(at - a);
    HumanPositions frame = world_positions(take, a);
    if (t > 0) {
      const HumanPositions next = world_positions(take, b);
      for (int j = 0; j < kHumanJoints; ++j) frame[j] = lerp(frame[j], next[j], t);
    }
    world.push_back(frame);
  }
  return world;
}

std::vector<double> ranks(const std::vector<double>& values) {
  std::vector<size_t> order(values.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](size_t a, size_t b) { return values[a] < values[b]; });
  std::vector<double> rank(values.size());
  for (size_t i = 0; i < order.size();) {
    size_t end = i + 1;
    while (end < order.size() && values[order[end]] == values[order[i]]) ++end;
    const double shared = (static_cast<double>(i) + static_cast<double>(end - 1)) / 2;
    for (; i < end; ++i) rank[order[i]] = shared;
  }
  return rank;
}

}  // namespace

double mean_jerk(const Take& take) {
  const std::vector<HumanPositions> world = world_motion(take, kTakeRate);
  double sum = 0;
  int count = 0;
  for (size_t f = 3; f < world.size(); ++f) {
    for (int j = 0; j < kHumanJoints; ++j) {
      const Vec3 third = world[f][j] - world[f - 3][j] + (world[f - 2][j] - world[f - 1][j]) * 3.0f;
      sum += length(third);
      ++count;
    }
  }
  return count > 0 ? sum / count * kTakeRate * kTakeRate * kTakeRate : 0;
}

double skating_ratio(const Take& take) {
  const std::vector<HumanPositions> world = world_motion(take, kSkatingRate);
  const int frames = static_cast<int>(world.size());
  if (frames < 2) return 0;
  std::vector<bool> slides(frames, false);
  for (const HumanJoint toe : kToes) {
    std::vector<Slide> motion(frames, Slide{1, 1, 0});
    for (int f = 1; f < frames; ++f) {
      motion[f] = slide_of(world[f - 1], world[f], toe, kSkatingRate);
    }
    for (int f = 1; f < frames; ++f) {
      const int a = std::max(f - 2, 1), b = std::min(f + 2, frames - 1);
      float mean = 0;
      for (int i = a; i <= b; ++i) mean += motion[i].speed / static_cast<float>(b - a + 1);
      if (motion[f].height < kLowToe && motion[f].before < kLowToe && motion[f].speed > kSlide &&
          mean > kSlide) {
        slides[f] = true;
      }
    }
  }
  return static_cast<double>(std::count(slides.begin(), slides.end(), true)) / (frames - 1);
}

double weighted_skating(const Take& take) {
  const std::vector<HumanPositions> world = world_motion(take, kSkatingRate);
  double sum = 0;
  int count = 0;
  for (size_t f = 1; f < world.size(); ++f) {
    for (int foot = 0; foot < kFeet; ++foot) {
      for (const HumanJoint joint : {kAnkles[foot], kToes[foot]}) {
        const Slide slide = slide_of(world[f - 1], world[f], joint, kSkatingRate);
        sum += slide.speed * std::clamp(2 - std::exp2(slide.height / kWeightHeight), 0.0f, 1.0f);
        ++count;
      }
    }
  }
  return count > 0 ? sum / count : 0;
}

double cadence(const Take& take) {
  const int frames = take.frames();
  if (frames < 2) return kNotMeasured;
  double path = 0;
  for (int f = 1; f < frames; ++f) {
    path += length(take.root[f].position - take.root[f - 1].position);
  }
  if (path * kTakeRate / (frames - 1) < kTravelSpeed) return kNotMeasured;

  std::vector<float> apart(frames);  // Distance of the left foot in front of the right one.
  for (int f = 0; f < frames; ++f) {
    apart[f] = take.body[f][index(kAnkles[0])].z - take.body[f][index(kAnkles[1])].z;
  }
  const float mean = std::accumulate(apart.begin(), apart.end(), 0.0f) / static_cast<float>(frames);
  float variance = 0;
  for (float& a : apart) {
    a -= mean;
    variance += a * a / static_cast<float>(frames);
  }
  // A pass counts once the feet are clearly apart on the other side; its time is when they met.
  const float margin = kPassMargin * std::sqrt(variance);
  std::vector<double> passes;
  int side = 0;
  double met = 0;
  for (int f = 0; f < frames; ++f) {
    if (f > 0 && (apart[f - 1] < 0) != (apart[f] < 0)) {
      met = f - apart[f] / static_cast<double>(apart[f] - apart[f - 1]);
    }
    const int now = apart[f] > margin ? 1 : apart[f] < -margin ? -1 : side;
    if (side != 0 && now != side) passes.push_back(met);
    side = now;
  }
  if (passes.size() < 2) return kNotMeasured;
  return static_cast<double>(passes.size() - 1) * kTakeRate / (passes.back() - passes.front());
}

double distance_cm(const HumanPositions& a, const HumanPositions& b) {
  double sum = 0;
  for (size_t j = 0; j < a.size(); ++j) sum += static_cast<double>(length(a[j] - b[j]));
  return 100 * sum / static_cast<double>(a.size());
}

double mean_distance(const Take& take, const Take& from, const std::vector<float>& source_frames) {
  double sum = 0;
  const int frames = std::min(take.frames(), static_cast<int>(source_frames.size()));
  for (int f = 0; f < frames; ++f) {
    const HumanPositions body = body_at(from, source_frames[f]);
    for (int j = 0; j < kHumanJoints; ++j) sum += length(take.body[f][j] - body[j]);
  }
  return frames > 0 ? sum / frames / kHumanJoints : 0;
}

double summed_distance(const Take& a, const Take& b) {
  const int frames = std::min(a.frames(), b.frames());
  double sum = 0;
  for (int f = 0; f < frames; ++f) {
    for (int j = 0; j < kHumanJoints; ++j) sum += length(a.body[f][j] - b.body[f][j]);
  }
  return frames > 0 ? sum / frames : 0;
}

double distance_to_real(const std::vector<Take>& takes, const std::vector<Take>& real,
                        const std::vector<Take>& more_real) {
  double sum = 0, count = 0;
  for (const Take& take : takes) {
    for (const std::vector<Take>* part : {&real, &more_real}) {
      for (const Take& other : *part) {
        if (other.row.style != take.row.style || other.row.content != take.row.content ||
            other.row.path == take.row.path) {
          continue;
        }
        sum += summed_distance(take, other);
        ++count;
      }
    }
  }
  return count > 0 ? sum / count : kNotMeasured;
}

double bone_length_error(const Clip& clip, const Clip& from,
                         const std::vector<double>& source_frames, int hips) {
  const size_t joints = clip.joints();
  std::vector<Quat> turns(joints), source_turns(joints);
  std::vector<Vec3> positions(joints), source_positions(joints);
  std::vector<bool> is_bone(joints);
  for (size_t j = 0; j < joints; ++j) is_bone[j] = clip.skeleton.joints[j].parent >= 0;
  for (int j = hips; j >= 0; j = clip.skeleton.joints[j].parent) is_bone[j] = false;
  double worst = 0;
  for (int f = 0; f < clip.frames; ++f) {
    world_pose(clip.skeleton, clip.pose(f), {turns, positions});
    sample(from, source_frames[f], {source_turns, source_positions});
    world_pose(clip.skeleton, ConstPose{source_turns, source_positions},
               {source_turns, source_positions});
    for (size_t j = 0; j < joints; ++j) {
      if (!is_bone[j]) continue;
      const int parent = clip.skeleton.joints[j].parent;
      const double now = length(positions[j] - positions[parent]);
      const double before = length(source_positions[j] - source_positions[parent]);
      worst = std::max(worst, std::abs(now - before));
    }
  }
  return worst;
}

double rank_correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const std::vector<double> x = ranks(a), y = ranks(b);
  const double count = static_cast<double>(x.size());
  const double mean = (count - 1) / 2;
  double xy = 0, xx = 0, yy = 0;
  for (size_t i = 0; i < x.size(); ++i) {
    xy += (x[i] - mean) * (y[i] - mean);
    xx += (x[i] - mean) * (x[i] - mean);
    yy += (y[i] - mean) * (y[i] - mean);
  }
  return xx > 0 && yy > 0 ? xy / std::sqrt(xx * yy) : kNotMeasured;
}

}  // namespace panache
