#pragma once
// The neutral motion of many people in compact form: for a clip in a style, the neutral motion that
// people do in its place, without a neutral clip of the performer.

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "learn/take.h"
#include "net/safetensors.h"

namespace panache {

// What a moment of a motion (1.2 s around a frame, and the 3 s around that) is recognised by,
// whatever the posture: how legs, arms and torso move about their mean, steps, speed.
inline constexpr int kMomentFeatures = 488;
// `tempo`: neutral seconds per second of the take, which is played as much slower. The take's
// numbers are in layout positions. out.size() = kMomentFeatures
void write_moment(const Take& take, float frame, float tempo, std::span<float> out);

// What is known of a neutral motion that was found for a styled one.
struct TwinFacts {
  int people = 0;  // How many it is the mean of.
  // The share of the difference in posture that counts as style; the rest is what people differ by,
  // or unknown.
  double certainty = 0;
  bool is_known = true;  // People do something like it in the bank.
  // How much of the difference counts as style: less than 1 where the nearest that people do is far
  // and moves much less, as people who stand do beside a punch.
  double trust = 1;
};

// A neutral motion in the place of a styled one.
struct NeutralTwin {
  Take take;         // On the canonical body; `tempo` times as long as the styled take.
  double tempo = 1;  // Neutral seconds per styled second.
  TwinFacts facts;
};

// Prototypes of moments: each the mean of several people, and how much these differ.
class NeutralBank {
 public:
  static constexpr int kDirections = 32;  // In which moments differ most.
  static constexpr int kPeople = 8;       // Of a prototype, at the most; from kMinPeople on.
  static constexpr int kMinPeople = 5;
  static constexpr int kPoseNumbers = 66;  // pose_feature_count(PoseLayout::positions)
  // A prototype: its place along the directions, its pose, and the deviation of each joint between
  // people, metres.
  static constexpr int kRow = kDirections + kPoseNumbers + kHumanJoints;

  // Reads and checks a file; the message of a failure names what is wrong with it.
  static Result<std::shared_ptr<const NeutralBank>> load(const std::string& path);
  static Result<std::shared_ptr<const NeutralBank>> parse(std::string_view bytes,
                                                          const std::string& name);

  NeutralTwin twin(const Take& styled) const;

  // out.size() = kDirections
  void project(std::span<const float> moment, std::span<float> out) const;

 private:
  struct Near {
    float distance;  // Squared.
    int prototype;
  };
  // The nearest prototypes, the nearest first.
  void find(const Take& take, float frame, float tempo, std::span<Near> out) const;

  size_t prototypes() const { return people_.size() / kPeople; }
  const float* row(int prototype) const { return &rows_[static_cast<size_t>(prototype) * kRow]; }

  std::vector<float> mean_;        // [kMomentFeatures]
  std::vector<float> directions_;  // [kMomentFeatures][kDirections]
  std::vector<float> rows_;        // [prototypes][kRow]
  std::vector<int> people_;        // [prototypes][kPeople], -1 where there are fewer
  float known_ = 0;                // How far neutral motion of others is from its prototype.
};

}  // namespace panache
