#pragma once
// The neutral motion of many people in compact form: it gives the neutral counterpart of a styled
// clip without a neutral clip of the performer.

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "learn/take.h"
#include "net/safetensors.h"

namespace panache {

// The features that identify a moment of a motion (1.2 s around a frame, and the 3 s around that)
// independent of posture: how legs, arms and torso move about their mean, steps, speed.
inline constexpr int kMomentFeatures = 488;
// `tempo`: neutral seconds per second of the take, which is slowed down by this factor. The take's
// features are in layout positions. out.size() = kMomentFeatures
void write_moment(const Take& take, float frame, float tempo, std::span<float> out);

// Facts about the neutral motion that was found for a styled one.
struct TwinFacts {
  int people = 0;  // How many people it averages.
  // The fraction of the difference in posture that counts as style; the rest is variation between
  // people, or unknown.
  double certainty = 0;
  bool is_known = true;  // Whether people in the bank do something like it.
  // The fraction of the difference that counts as style: below 1 if the nearest motion in the bank
  // is far away and moves much less, such as people who stand, for a punch.
  double trust = 1;
};

// A neutral motion found for a styled one.
struct NeutralTwin {
  Take take;         // On the canonical body; `tempo` times as long as the styled take.
  double tempo = 1;  // Neutral seconds per styled second.
  TwinFacts facts;
};

// Prototypes of moments: each is the mean of several people, with their deviation.
class NeutralBank {
 public:
  static constexpr int kDirections = 32;  // The directions in which moments vary most.
  static constexpr int kPeople = 8;       // At most, in a prototype; at least kMinPeople.
  static constexpr int kMinPeople = 5;
  static constexpr int kPoseNumbers = 66;  // pose_feature_count(PoseLayout::positions)
  // A prototype: its coordinates along the directions, its pose, and the deviation of each joint
  // between people, metres.
  static constexpr int kRow = kDirections + kPoseNumbers + kHumanJoints;

  // Reads and checks a file; error messages say what is wrong with it.
  static Result<std::shared_ptr<const NeutralBank>> load(const std::string& path);
  static Result<std::shared_ptr<const NeutralBank>> parse(std::string_view bytes,
                                                          const std::string& name);

  // `is_person`: the take is neutral too, and all that differs is the person's.
  NeutralTwin twin(const Take& styled, bool is_person = false) const;

  // out.size() = kDirections
  void project(std::span<const float> moment, std::span<float> out) const;

 private:
  struct Near {
    float distance;  // Squared.
    int prototype;
  };
  // The nearest prototypes, nearest first.
  void find(const Take& take, float frame, float tempo, std::span<Near> out) const;

  size_t prototypes() const { return people_.size() / kPeople; }
  const float* row(int prototype) const { return &rows_[static_cast<size_t>(prototype) * kRow]; }

  std::vector<float> mean_;        // [kMomentFeatures]
  std::vector<float> directions_;  // [kMomentFeatures][kDirections]
  std::vector<float> rows_;        // [prototypes][kRow]
  std::vector<int> people_;        // [prototypes][kPeople], -1 where there are fewer
  float known_ = 0;                // Distance of other people's neutral motion from its prototype.
};

}  // namespace panache
