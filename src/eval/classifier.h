#pragma once
// Tells a second of motion's style, or its content: the judge of what a system puts out.

#include <string>
#include <vector>

#include <torch/torch.h>

#include "learn/take.h"
#include "train/network.h"

namespace panache {

// A window is one second: 15 poses 1/15 s apart, each the 63 positions in the body frame and the
// 3 root features; three windows begin each second.
inline constexpr int kClassifiedPoses = 15, kClassifiedSpacing = 2,
                     kClassifiedHop = 10;  // Frames of a take.

// What a classifier says of the windows of a take.
struct Classification {
  torch::Tensor probabilities;  // [windows][classes]
  torch::Tensor features;       // [windows][features], of its last hidden layer.
};

class Classifier {
 public:
  // Learns to tell the class labels[i] of takes[i] (numbers in layout positions) apart; takes
  // whose label is not among `classes` are left out. Follows from the seed.
  Classifier(const std::vector<Take>& takes, const std::vector<std::string>& labels,
             std::vector<std::string> classes, uint64_t seed);

  // A take shorter than a window is held at its last frame.
  Classification classify(const Take& take) const;

  const std::vector<std::string>& classes() const { return classes_; }
  // Index of a class, -1 where it is none.
  int find(const std::string& label) const;

 private:
  void learn(const std::vector<Take>& takes, const std::vector<int>& labels, uint64_t seed);
  void write_window(const Take& take, int first, float* out) const;

  std::vector<std::string> classes_;
  std::vector<float> mean_, scale_;       // [pose numbers]
  std::vector<NetworkTrainer> networks_;  // An ensemble: their probabilities are averaged.
};

}  // namespace panache
