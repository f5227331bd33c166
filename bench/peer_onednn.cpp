// The networks in oneDNN: inner products with ELU behind, weights in the library's own order.

#include <algorithm>
#include <cstring>
#include <unordered_map>

#include <dnnl.hpp>

#include "bench/peers.h"

namespace panache::bench {
namespace {

class OneDnnEvaluation : public Evaluation {
 public:
  explicit OneDnnEvaluation(std::span<const Network> networks)
      : engine_(dnnl::engine::kind::cpu, 0), stream_(engine_) {
    input_ = dnnl::memory(row(kSlidesInputs), engine_);
    for (const Network& network : networks) {
      dnnl::memory from = input_;
      for (size_t l = 0; l < network.layers.size(); ++l) {
        from = add(network.layers[l], from, l + 1 < network.layers.size());
      }
      outputs_.push_back(from);
    }
    stream_.wait();
  }

  void run(std::span<const float> x, std::span<float> y) override {
    std::memcpy(input_.get_data_handle(), x.data(), x.size_bytes());
    for (const Step& step : steps_) step.primitive.execute(stream_, step.arguments);
    stream_.wait();
    for (const dnnl::memory& output : outputs_) {
      const size_t size = output.get_desc().get_size();
      std::memcpy(y.data(), output.get_data_handle(), size);
      y = y.subspan(size / sizeof(float));
    }
  }
  std::string library() const override {
    const dnnl_version_t* v = dnnl_version();
    return "oneDNN " + std::to_string(v->major) + "." + std::to_string(v->minor) + "." +
           std::to_string(v->patch);
  }

 private:
  struct Step {
    dnnl::inner_product_forward primitive;
    std::unordered_map<int, dnnl::memory> arguments;
  };
  using Descriptor = dnnl::memory::desc;
  using Tag = dnnl::memory::format_tag;
  static constexpr auto kFloat = dnnl::memory::data_type::f32;

  static Descriptor row(int size) { return {{1, size}, kFloat, Tag::nc}; }

  // Appends the layer; returns where its outputs will be.
  dnnl::memory add(const Layer& layer, const dnnl::memory& from, bool with_elu) {
    const dnnl::memory::dims shape = {layer.outputs, layer.inputs};
    const Descriptor as_they_like(shape, kFloat, Tag::any);
    const Descriptor bias_like({layer.outputs}, kFloat, Tag::x);
    dnnl::primitive_attr attributes;
    if (with_elu) {
      dnnl::post_ops after;
      after.append_eltwise(1.0f, dnnl::algorithm::eltwise_elu, 1.0f, 0.0f);
      attributes.set_post_ops(after);
    }
    const dnnl::inner_product_forward::primitive_desc how(
        {dnnl::prop_kind::forward_inference, from.get_desc(), as_they_like, bias_like,
         row(layer.outputs)},
        attributes, engine_);
    const dnnl::memory ours({shape, kFloat, Tag::io}, engine_,
                            const_cast<float*>(layer.weights.data()));
    const dnnl::memory weights(how.weights_desc(), engine_), bias(bias_like, engine_);
    dnnl::reorder(ours, weights).execute(stream_, {{DNNL_ARG_FROM, ours}, {DNNL_ARG_TO, weights}});
    stream_.wait();
    std::copy(layer.bias.begin(), layer.bias.end(), static_cast<float*>(bias.get_data_handle()));
    const dnnl::memory to(how.dst_desc(), engine_);
    steps_.push_back({dnnl::inner_product_forward(how),
                      {{DNNL_ARG_SRC, from},
                       {DNNL_ARG_WEIGHTS, weights},
                       {DNNL_ARG_BIAS, bias},
                       {DNNL_ARG_DST, to}}});
    return to;
  }

  dnnl::engine engine_;
  dnnl::stream stream_;
  dnnl::memory input_;
  std::vector<Step> steps_;
  std::vector<dnnl::memory> outputs_;
};

}  // namespace

extern "C" Evaluation* panache_bench_peer(const Network* networks, size_t count,
                                          std::string* problem) {
  try {
    return new OneDnnEvaluation({networks, count});
  } catch (const dnnl::error& error) {
    *problem = error.what();
    return nullptr;
  }
}

}  // namespace panache::bench
