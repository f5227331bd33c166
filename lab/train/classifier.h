#pragma once
// Tells a second of motion's style, or its content: the judge of what a system puts out, and, in
// training, the guide to what a style looks like on motion that nobody ever captured in it.

#include <span>
#include <string>
#include <vector>

#include <torch/types.h>

#include "learn/samples.h"
#include "learn/take.h"
#include "train/network.h"

namespace panache {

// A window is one second: 15 poses 1/15 s apart, each the 63 positions in the body frame and the
// 3 root features; three windows begin each second.
inline constexpr int kClassifiedPoses = 15, kClassifiedSpacing = 2,
                     kClassifiedHop = 10;  // Frames of a take.
inline constexpr int kClassifiedInputs =
    kClassifiedPoses * pose_feature_count(PoseLayout::positions);

// What a classifier says of the windows of a take.
struct Classification {
  torch::Tensor probabilities;  // [windows][classes]
  torch::Tensor features;       // [windows][features], of its last hidden layer.
};

struct ClassifierSettings {
  int hidden = 96;   // Units of each of its two layers.
  int networks = 2;  // Their probabilities are averaged.
  int steps = 0;     // 0: a dozen rounds through the windows.
  // Half of the windows mirrored, all of them as other bodies and captures would show them: for
  // motion of people that it does not learn from.
  bool disturbed = false;
};

class Classifier {
 public:
  // Learns to tell the class labels[i] of takes[i] (numbers in layout positions) apart; takes
  // whose label is not among `classes` are left out. Follows from the seed.
  Classifier(const std::vector<Take>& takes, const std::vector<std::string>& labels,
             std::vector<std::string> classes, uint64_t seed,
             const ClassifierSettings& settings = {});

  // A take shorter than a window is held at its last frame.
  Classification classify(const Take& take) const;

  // Cross-entropy of wanted[i] for window i, mean over windows and networks, with gradients for the
  // windows alone. Each network drops units and sees noise, as when it learnt: it is harder to fool
  // like that. windows[windows][poses * numbers], not normalised.
  torch::Tensor loss(const torch::Tensor& windows, const torch::Tensor& wanted, float smoothing,
                     Random& random) const;

  const std::vector<std::string>& classes() const { return classes_; }
  // Index of a class; -1 where there is no such class.
  int find(const std::string& label) const;

 private:
  void measure(const std::vector<Take>& takes, const std::vector<int>& labels);
  void learn(const std::vector<Take>& takes, const std::vector<int>& labels, uint64_t seed);
  void normalise(std::span<float> window) const;

  ClassifierSettings settings_;
  std::vector<std::string> classes_;
  InputUnits units_;
  std::vector<NetworkTrainer> networks_;
};

}  // namespace panache
