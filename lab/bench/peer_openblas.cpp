// The networks in OpenBLAS, which offers only products: ELU is our own.

#include <algorithm>

#include <cblas.h>

#include "bench/peers.h"
#include "net/dense.h"

namespace panache::bench {
namespace {

class OpenBlasEvaluation : public Evaluation {
 public:
  explicit OpenBlasEvaluation(std::span<const Network> networks)
      : networks_(networks.begin(), networks.end()) {
    openblas_set_num_threads(1);
    for (const Network& network : networks) {
      auto& outputs = outputs_.emplace_back();
      for (const Layer& layer : network.layers) outputs.emplace_back(layer.bias.size());
    }
  }

  void run(std::span<const float> x, std::span<float> y) override {
    for (size_t n = 0; n < networks_.size(); ++n) {
      const std::vector<Layer>& layers = networks_[n].layers;
      std::span<const float> from = x;
      for (size_t l = 0; l < layers.size(); ++l) {
        const Layer& layer = layers[l];
        std::vector<float>& out = outputs_[n][l];
        std::copy(layer.bias.begin(), layer.bias.end(), out.begin());
        cblas_sgemv(CblasColMajor, CblasNoTrans, layer.outputs, layer.inputs, 1,
                    layer.weights.data(), layer.outputs, from.data(), 1, 1, out.data(), 1);
        if (l + 1 < layers.size()) elu(out);
        from = out;
      }
      std::copy(from.begin(), from.end(), y.begin());
      y = y.subspan(from.size());
    }
  }
  std::string library() const override {
    const std::string config = openblas_get_config();  // "OpenBLAS 0.3.21 NO_LAPACKE ..."
    const size_t second = config.find(' ', config.find(' ') + 1);
    return config.substr(0, second) + ", " + openblas_get_corename();
  }

 private:
  std::vector<Network> networks_;
  std::vector<std::vector<std::vector<float>>> outputs_;  // [networks][layers]
};

}  // namespace

extern "C" Evaluation* panache_bench_peer(const Network* networks, size_t count, std::string*) {
  return new OpenBlasEvaluation({networks, count});
}

}  // namespace panache::bench
