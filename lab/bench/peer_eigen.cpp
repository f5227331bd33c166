// The networks in Eigen, compiled for the build machine.

#include <Eigen/Core>

#include "bench/peers.h"

namespace panache::bench {
namespace {

class EigenEvaluation : public Evaluation {
 public:
  explicit EigenEvaluation(std::span<const Network> networks) {
    for (const Network& network : networks) {
      auto& layers = networks_.emplace_back();
      for (const Layer& layer : network.layers) {
        layers.push_back(
            {Eigen::Map<const Eigen::MatrixXf>(layer.weights.data(), layer.outputs, layer.inputs),
             Eigen::Map<const Eigen::VectorXf>(layer.bias.data(), layer.outputs),
             Eigen::VectorXf(layer.outputs)});
      }
    }
  }

  void run(std::span<const float> x, std::span<float> y) override {
    const Eigen::Map<const Eigen::VectorXf> input(x.data(), static_cast<Eigen::Index>(x.size()));
    float* to = y.data();
    for (std::vector<Ready>& layers : networks_) {
      for (size_t l = 0; l < layers.size(); ++l) {
        Ready& layer = layers[l];
        layer.out = layer.bias;
        if (l == 0) {
          layer.out.noalias() += layer.weights * input;
        } else {
          layer.out.noalias() += layer.weights * layers[l - 1].out;
        }
        if (l + 1 < layers.size()) {
          // The positive and the negative part of ELU: one of them is always zero.
          layer.out = layer.out.array().max(0.0f) + (layer.out.array().min(0.0f).exp() - 1.0f);
        }
      }
      const Eigen::VectorXf& out = layers.back().out;
      Eigen::Map<Eigen::VectorXf>(to, out.size()) = out;
      to += out.size();
    }
  }
  std::string library() const override {
    return "Eigen " + std::to_string(EIGEN_WORLD_VERSION) + "." +
           std::to_string(EIGEN_MAJOR_VERSION) + "." + std::to_string(EIGEN_MINOR_VERSION);
  }

 private:
  struct Ready {
    Eigen::MatrixXf weights;  // [outputs][inputs], column-major.
    Eigen::VectorXf bias, out;
  };
  std::vector<std::vector<Ready>> networks_;
};

}  // namespace

extern "C" Evaluation* panache_bench_peer(const Network* networks, size_t count, std::string*) {
  return new EigenEvaluation({networks, count});
}

}  // namespace panache::bench
