#pragma once
// One of the three networks during training: parameters, forward pass and optimiser.

#include <cstdint>
#include <string>
#include <vector>

#include <torch/types.h>

#include "base/random.h"
#include "net/safetensors.h"
#include "recipes/training_settings.h"

namespace panache {

// The architecture of one network.
struct NetworkShape {
  std::string name;  // "pose", "timing", "contact": the prefix of its tensors in the model file.
  int inputs = 0;
  int hidden = 0;  // Units per hidden layer.
  int layers = 3;
  int outputs = 0;
  int heads = 1;
  bool base = false;  // Head 0 is added to every other.
  bool half = false;  // Heads are stored as fp16.
};

// The tensor of a model file; `half`: as fp16.
Tensor to_tensor(const torch::Tensor& values, bool half = false);

class NetworkTrainer {
 public:
  NetworkTrainer(const NetworkShape& shape, const OptimizerSettings& settings, int64_t steps,
                 uint64_t seed);

  // The output for rows grouped by head: the first group_sizes[0] rows of `x` go through head 0
  // (or, with a base, head 1 plus the base), and so on. x[rows][inputs] -> [rows][outputs]. Dropout
  // is active if `random` is given.
  torch::Tensor forward(const torch::Tensor& x, const std::vector<int64_t>& group_sizes,
                        Random* random) const;

  // Activations of all hidden layers, first layer first. [rows][layers * hidden]
  torch::Tensor activations(const torch::Tensor& x) const;
  // Activations of the last hidden layer. [rows][hidden]
  torch::Tensor hidden(const torch::Tensor& x, Random* random) const;

  // One step of Adam (Kingma and Ba 2015) down the gradient of `loss`.
  void learn(const torch::Tensor& loss);

  // Freezes the parameters: from now on, gradients reach only the inputs.
  void freeze();

  int64_t step() const { return step_; }
  const NetworkShape& shape() const { return shape_; }

  // The state needed to resume training; restore() fails if shapes differ.
  std::vector<torch::Tensor> save() const;
  bool restore(const std::vector<torch::Tensor>& saved);

  // Rounds fp16 tensors, so that the parameters here match those of the file.
  void round_halves();

  // Adds the tensors that a model reads: NAME.trunk.K.weight, NAME.head.K.weight, ... and biases.
  void write(TensorFile& file) const;

 private:
  float learning_rate() const;

  NetworkShape shape_;
  OptimizerSettings settings_;
  int64_t steps_, step_ = 0;
  torch::Tensor numbers_, gradient_, mean_, square_, decay_;  // [all parameters of the network]
  std::vector<torch::Tensor> weights_, biases_;  // Views of numbers_; trunk [in][out], [out].
  torch::Tensor heads_, head_biases_;            // [heads][hidden][outputs], [heads][outputs]
};

}  // namespace panache
