#pragma once
// Recognises the style or the content of one second of motion. Evaluates the output of systems, and
// guides training on motion that was never captured in a style.

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

// The predictions for the windows of a take.
struct Classification {
  torch::Tensor probabilities;  // [windows][classes]
  torch::Tensor features;       // [windows][features], activations of the last hidden layer.
};

struct ClassifierSettings {
  int hidden = 96;   // Units of each of the two layers.
  int networks = 2;  // Their probabilities are averaged.
  int steps = 0;     // 0: about twelve epochs.
  // Varies all windows as other bodies and captures would: for classifying people who are not in
  // the training data.
  bool disturbed = false;
};

class Classifier {
 public:
  // Learns to predict labels[i] from takes[i] (features in layout positions); skips takes whose
  // label is not among `classes`. Deterministic for a seed.
  Classifier(const std::vector<Take>& takes, const std::vector<std::string>& labels,
             std::vector<std::string> classes, uint64_t seed,
             const ClassifierSettings& settings = {});

  // A take shorter than a window is padded with its last frame.
  Classification classify(const Take& take) const;

  // Cross-entropy of wanted[i] for window i, averaged over windows and networks, with gradients for
  // the windows only. Dropout and noise stay on as in training, which makes the networks harder to
  // fool. windows[windows][poses * features], not normalised.
  torch::Tensor loss(const torch::Tensor& windows, const torch::Tensor& wanted, float smoothing,
                     Random& random) const;

  const std::vector<std::string>& classes() const { return classes_; }
  // Index of a class, or -1.
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
