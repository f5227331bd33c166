// The networks in libtorch: a frozen TorchScript module on one thread, with matrix-vector products
// on weights laid out as in our files. Of linear and addmv, either layout, with and without
// optimize_for_inference, this was the fastest by 10 percent; the slowest took four times as long.

#include <algorithm>
#include <sstream>

#include <torch/script.h>
#include <ATen/Parallel.h>
#include <torch/version.h>

#include "bench/peers.h"

namespace panache::bench {
namespace {

constexpr int kUnseenRuns = 20;  // Untimed: profiled by the interpreter before it optimises.

class LibtorchEvaluation : public Evaluation {
 public:
  explicit LibtorchEvaluation(std::span<const Network> networks) {
    at::set_num_threads(1);
    const c10::InferenceMode inference;
    torch::jit::Module module("networks");
    std::ostringstream code, results;
    code << "def forward(self, x):\n";
    for (size_t n = 0; n < networks.size(); ++n) {
      std::string from = "x";
      for (size_t l = 0; l < networks[n].layers.size(); ++l) {
        Layer layer = networks[n].layers[l];
        const std::string id = std::to_string(n) + "_" + std::to_string(l);
        const auto weights = torch::from_blob(layer.weights.data(), {layer.inputs, layer.outputs});
        module.register_buffer("w" + id, weights.clone().t());
        module.register_buffer("b" + id,
                               torch::from_blob(layer.bias.data(), layer.outputs).clone());
        const bool last = l + 1 == networks[n].layers.size();
        const std::string product = "torch.addmv(self.b" + id + ", self.w" + id + ", " + from + ")";
        code << "    h" << id << " = " << (last ? product : "torch.elu(" + product + ")") << "\n";
        from = "h" + id;
      }
      results << (n ? ", " : "") << from;
    }
    code << "    return " << results.str() << "\n";
    module.define(code.str());
    module.eval();
    module_ = torch::jit::freeze(module);
    std::vector<float> x(kSlidesInputs), y(kSlidesOutputs);
    for (int i = 0; i < kUnseenRuns; ++i) run(x, y);
  }

  void run(std::span<const float> x, std::span<float> y) override {
    const c10::InferenceMode inference;
    const auto input =
        torch::from_blob(const_cast<float*>(x.data()), {static_cast<int64_t>(x.size())});
    const auto results = module_.forward({input}).toTuple();
    for (const c10::IValue& result : results->elements()) {
      const at::Tensor& out = result.toTensor();
      std::copy_n(out.data_ptr<float>(), out.numel(), y.begin());
      y = y.subspan(static_cast<size_t>(out.numel()));
    }
  }
  std::string library() const override { return "libtorch " TORCH_VERSION; }

 private:
  torch::jit::Module module_;
};

}  // namespace

extern "C" Evaluation* panache_bench_peer(const Network* networks, size_t count,
                                          std::string* problem) {
  try {
    return new LibtorchEvaluation({networks, count});
  } catch (const std::exception& error) {
    *problem = error.what();
    return nullptr;
  }
}

}  // namespace panache::bench
