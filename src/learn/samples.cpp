#include "learn/samples.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "pose/features.h"

namespace panache {
namespace {

struct Between {
  int a, b;
  float t;
};
Between between(float frame, int frames) {
  frame = std::clamp(frame, 0.0f, static_cast<float>(frames - 1));
  const int a = static_cast<int>(frame), b = std::min(a + 1, frames - 1);
  return {a, b, frame - static_cast<float>(a)};
}

// The hips' x and z are constant in the body frame, and others nearly so: divided by their true
// deviation, any disturbance would explode. So a deviation of 3 cm (0.1 m/s, 0.2 rad/s) is added.
// Rotations are normalised without it, except for those that hardly move: 0.02 of a matrix entry is
// about a degree.
float floored_deviation(PoseLayout layout, int number, double variance) {
  double floor = 0.02;
  if (layout == PoseLayout::positions) {
    const int root = root_offset(layout);
    floor = number < root ? 0.03 : number < root + kTurnRate ? 0.1 : 0.2;
  }
  return static_cast<float>(std::sqrt(variance + floor * floor));
}

}  // namespace

HumanPositions body_at(const Take& take, float frame) {
  const auto [a, b, t] = between(frame, take.frames());
  HumanPositions body;
  for (int j = 0; j < kHumanJoints; ++j) body[j] = lerp(take.body[a][j], take.body[b][j], t);
  return body;
}

std::array<float, kRootFeatures> root_at(const Take& take, float frame) {
  const auto [a, b, t] = between(frame, take.frames());
  const size_t numbers = take.pose_features.size() / take.body.size();
  std::array<float, kRootFeatures> root;
  for (size_t k = 0; k < root.size(); ++k) {
    const size_t n = numbers - root.size() + k;
    root[k] =
        take.pose_features[a * numbers + n] * (1 - t) + take.pose_features[b * numbers + n] * t;
  }
  return root;
}

void take_window(const Take& take, float frame, int numbers, std::span<float> out, float spacing) {
  for (int k = 0; k < kWindowPoses; ++k) {
    const auto [a, b, t] = between(frame - static_cast<float>(k) * spacing, take.frames());
    const float* before = &take.pose_features[size_t(a) * numbers];
    const float* after = &take.pose_features[size_t(b) * numbers];
    float* pose = &out[size_t(k) * numbers];
    for (int i = 0; i < numbers; ++i) pose[i] = before[i] * (1 - t) + after[i] * t;
  }
}

StyleDelta change_between(const Take& styled, int frame, const Take& neutral, float at,
                          float rate) {
  const auto [a, b, t] = between(at, neutral.frames());
  StyleDelta change;
  for (int j = 0; j < kHumanJoints; ++j) {
    const Quat from = nlerp(neutral.rotations[a][j], neutral.rotations[b][j], t);
    change.rotations[j] = log_rotation(styled.rotations[frame][j] * conjugate(from));
  }
  const float height = lerp(neutral.body[a][0], neutral.body[b][0], t).y;
  change.hips_height = styled.body[frame][0].y - height;
  const auto now = root_at(styled, static_cast<float>(frame)), slow = root_at(neutral, at);
  change.velocity_left = now[kVelocityLeft] / rate - slow[kVelocityLeft];
  change.velocity_forward = now[kVelocityForward] / rate - slow[kVelocityForward];
  change.turn_rate = now[kTurnRate] / rate - slow[kTurnRate];
  return change;
}

InputUnits input_units(const std::vector<Take>& takes, const std::vector<int>& which,
                       PoseLayout layout) {
  const int count = pose_feature_count(layout);
  std::vector<double> sum(count), squares(count);
  double poses = 0;
  std::vector<float> pose(count);
  for (const int t : which) {
    const Take& take = takes[t];
    for (int f = 0; f < take.frames(); ++f) {
      std::copy_n(&take.pose_features[size_t(f) * count], count, pose.begin());
      for (const bool mirrored : {false, true}) {
        if (mirrored) mirror_pose(layout, pose);
        for (int i = 0; i < count; ++i) {
          sum[i] += pose[i];
          squares[i] += double(pose[i]) * pose[i];
        }
        ++poses;
      }
    }
  }
  InputUnits units;
  for (int i = 0; i < count; ++i) {
    const double mean = poses > 0 ? sum[i] / poses : 0;
    units.mean.push_back(static_cast<float>(mean));
    const double variance = poses > 0 ? squares[i] / poses - mean * mean : 1;
    units.scale.push_back(floored_deviation(layout, i, std::max(variance, 0.0)));
  }
  return units;
}

SampleSet::SampleSet(const std::vector<Take>& takes, const std::vector<Pairing>& pairings,
                     const std::vector<std::string>& styles, const Recipe& recipe,
                     bool with_neutral)
    : takes_(takes), recipe_(recipe) {
  for (const Pairing& pairing : pairings) {
    const std::string& name =
        pairing.style.empty() ? takes[pairing.styled].row.style : pairing.style;
    const auto style = std::find(styles.begin(), styles.end(), name);
    if (style == styles.end()) continue;
    add_pairing(pairing, static_cast<int>(style - styles.begin()));
  }
  std::vector<int> neutral_takes;
  neutral_takes.reserve(pairings.size());
  for (const Pairing& pairing : pairings) neutral_takes.push_back(pairing.neutral);
  std::sort(neutral_takes.begin(), neutral_takes.end());
  neutral_takes.erase(std::unique(neutral_takes.begin(), neutral_takes.end()), neutral_takes.end());
  if (with_neutral) {
    for (const int t : neutral_takes) add_neutral(t);
  }
  units_ = input_units(takes, neutral_takes, recipe.layout);
}

void SampleSet::add_target(const Take& styled, int frame, const Take& neutral, float at,
                           float rate) {
  targets_.resize(targets_.size() + outputs());
  recipe_.write_target(change_between(styled, frame, neutral, at, rate), body_at(neutral, at),
                       root_at(neutral, at), std::span(targets_).last(outputs()));
}

void SampleSet::add_pairing(const Pairing& pairing, int style) {
  const Take& styled = takes_[pairing.styled];
  const Take& neutral = takes_[pairing.neutral];
  const int window = static_cast<int>(pairing.neutral_frames.size());
  for (int i = kTrimFrames; i < window - kTrimFrames; ++i) {
    Sample sample;
    sample.take = pairing.neutral;
    sample.frame = pairing.neutral_frames[i];
    sample.style = style;
    sample.styled = pairing.styled;
    sample.styled_frame = pairing.first + i;
    const float rate = believable_rate(pairing.rates[i]);
    sample.log_rate = std::log(rate);
    const FootContacts& planted = styled.contacts[pairing.first + i];
    for (int f = 0; f < kFeet; ++f) sample.contacts[f] = planted[f] ? 1.0f : 0.0f;
    sample.has_next = i + 1 < window - kTrimFrames;
    samples_.push_back(sample);
    add_target(styled, pairing.first + i, neutral, sample.frame, rate);
  }
}

void SampleSet::add_neutral(int take) {
  const Take& neutral = takes_[take];
  for (int f = 0; f < neutral.frames(); ++f) {
    Sample sample;
    sample.take = take;
    sample.frame = static_cast<float>(f);
    sample.style = -1;
    for (int k = 0; k < kFeet; ++k) sample.contacts[k] = neutral.contacts[f][k] ? 1.0f : 0.0f;
    sample.has_next = f + 1 < neutral.frames();
    samples_.push_back(sample);
    add_target(neutral, f, neutral, sample.frame, 1);
  }
}

void SampleSet::window(size_t i, std::span<float> out, float tempo) const {
  const Sample& sample = samples_[i];
  take_window(takes_[sample.take], sample.frame, numbers(), out,
              static_cast<float>(kWindowSpacing * kTakeRate) * tempo);
  if (tempo == 1) return;
  for (int k = 1; k <= kWindowPoses; ++k) {
    for (int r = 1; r <= kRootFeatures; ++r) out[size_t(k) * numbers() - r] *= tempo;
  }
}

}  // namespace panache
