// The networks in oneDNN: inner products followed by ELU, with weights in the library's own layout;
// in float and int8.

#include <algorithm>
#include <cmath>
#include <cstring>
#include <unordered_map>
#include <vector>

#include <dnnl.hpp>

#include "bench/int8_layer.h"
#include "bench/peers.h"

namespace panache::bench {
namespace {

std::string version() {
  const dnnl_version_t* v = dnnl_version();
  return "oneDNN " + std::to_string(v->major) + "." + std::to_string(v->minor) + "." +
         std::to_string(v->patch);
}

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
  std::string library() const override { return version(); }

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
    const dnnl::inner_product_forward::primitive_desc description(
        {dnnl::prop_kind::forward_inference, from.get_desc(), as_they_like, bias_like,
         row(layer.outputs)},
        attributes, engine_);
    const dnnl::memory ours({shape, kFloat, Tag::io}, engine_,
                            const_cast<float*>(layer.weights.data()));
    const dnnl::memory weights(description.weights_desc(), engine_), bias(bias_like, engine_);
    dnnl::reorder(ours, weights).execute(stream_, {{DNNL_ARG_FROM, ours}, {DNNL_ARG_TO, weights}});
    stream_.wait();
    std::copy(layer.bias.begin(), layer.bias.end(), static_cast<float*>(bias.get_data_handle()));
    const dnnl::memory to(description.dst_desc(), engine_);
    steps_.push_back({dnnl::inner_product_forward(description),
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

// Inner products of int8 weights with int8 inputs. Each call quantizes its inputs to 127 steps of
// the largest with our own loop, as the library has none. Scales are passed at the call because
// they depend on the inputs; bias and ELU follow.
class OneDnnInt8Evaluation : public Evaluation {
 public:
  explicit OneDnnInt8Evaluation(std::span<const Network> networks)
      : engine_(dnnl::engine::kind::cpu, 0), stream_(engine_) {
    input_ = dnnl::memory(row(kSlidesInputs, kBytes), engine_);
    for (const Network& network : networks) {
      for (size_t l = 0; l < network.layers.size(); ++l) {
        add(network.layers[l], l == 0, l + 1 == network.layers.size());
      }
    }
    stream_.wait();
  }

  void run(std::span<const float> x, std::span<float> y) override {
    const float input_unit = round(x, input_);
    std::span<const float> last;
    for (Step& step : steps_) {
      const float unit = step.first ? input_unit : round(last, step.arguments[DNNL_ARG_SRC]);
      float* const scales = floats(step.arguments[DNNL_ARG_ATTR_OUTPUT_SCALES]);
      for (size_t o = 0; o < step.scale.size(); ++o) scales[o] = unit * step.scale[o];
      step.primitive.execute(stream_, step.arguments);
      stream_.wait();
      last = {floats(step.arguments[DNNL_ARG_DST]), step.scale.size()};
      if (!step.last) continue;
      std::copy(last.begin(), last.end(), y.begin());
      y = y.subspan(last.size());
    }
  }
  std::string library() const override { return version() + ", int8"; }

 private:
  struct Step {
    dnnl::inner_product_forward primitive;
    std::unordered_map<int, dnnl::memory> arguments;
    std::vector<float> scale;  // Of the weights. [outputs]
    bool first, last;          // Layer of its network.
  };
  using Descriptor = dnnl::memory::desc;
  using Tag = dnnl::memory::format_tag;
  static constexpr auto kFloat = dnnl::memory::data_type::f32;
  static constexpr auto kBytes = dnnl::memory::data_type::s8;

  static Descriptor row(int size, dnnl::memory::data_type type) {
    return {{1, size}, type, Tag::nc};
  }
  static float* floats(const dnnl::memory& memory) {
    return static_cast<float*>(memory.get_data_handle());
  }

  // Returns the scale.
  static float round(std::span<const float> x, const dnnl::memory& out) {
    float largest = 0;
    for (const float v : x) largest = std::max(largest, std::abs(v));
    if (largest == 0) largest = 1;
    const float steps = 127 / largest;
    int8_t* const bytes = static_cast<int8_t*>(out.get_data_handle());
    for (size_t i = 0; i < x.size(); ++i) {
      bytes[i] = static_cast<int8_t>(std::nearbyint(x[i] * steps));
    }
    return largest / 127;
  }

  void add(const Layer& layer, bool first, bool last) {
    const dnnl::memory::dims shape = {layer.outputs, layer.inputs};
    const dnnl::memory from = first ? input_ : dnnl::memory(row(layer.inputs, kBytes), engine_);
    const Descriptor bias_like = row(layer.outputs, kFloat);
    constexpr int kEachOutput = 1 << 1;
    dnnl::primitive_attr attributes;
    attributes.set_output_scales(kEachOutput, {DNNL_RUNTIME_F32_VAL});
    dnnl::post_ops after;
    after.append_binary(dnnl::algorithm::binary_add, bias_like);
    if (!last) after.append_eltwise(1.0f, dnnl::algorithm::eltwise_elu, 1.0f, 0.0f);
    attributes.set_post_ops(after);
    const dnnl::inner_product_forward::primitive_desc description(
        {dnnl::prop_kind::forward_inference, from.get_desc(), Descriptor(shape, kBytes, Tag::any),
         row(layer.outputs, kFloat)},
        attributes, engine_);
    Int8Layer int8 = quantized(layer);
    const dnnl::memory ours({shape, kBytes, Tag::io}, engine_, int8.weights.data());
    const dnnl::memory weights(description.weights_desc(), engine_), bias(bias_like, engine_);
    dnnl::reorder(ours, weights).execute(stream_, {{DNNL_ARG_FROM, ours}, {DNNL_ARG_TO, weights}});
    stream_.wait();
    std::copy(layer.bias.begin(), layer.bias.end(), floats(bias));
    const dnnl::memory scales({{layer.outputs}, kFloat, Tag::x}, engine_);
    steps_.push_back({dnnl::inner_product_forward(description),
                      {{DNNL_ARG_SRC, from},
                       {DNNL_ARG_WEIGHTS, weights},
                       {DNNL_ARG_DST, dnnl::memory(description.dst_desc(), engine_)},
                       {DNNL_ARG_ATTR_OUTPUT_SCALES, scales},
                       {DNNL_ARG_ATTR_MULTIPLE_POST_OP(0) | DNNL_ARG_SRC_1, bias}},
                      std::move(int8.scale),
                      first,
                      last});
  }

  dnnl::engine engine_;
  dnnl::stream stream_;
  dnnl::memory input_;
  std::vector<Step> steps_;
};

// Returns null and a message if the library lacks it.
template <class T>
Evaluation* make(const Network* networks, size_t count, std::string* problem) {
  try {
    return new T({networks, count});
  } catch (const dnnl::error& error) {
    *problem = error.what();
    return nullptr;
  }
}

}  // namespace

extern "C" Evaluation* panache_bench_peer(const Network* networks, size_t count,
                                          std::string* problem) {
  return make<OneDnnEvaluation>(networks, count, problem);
}

extern "C" Evaluation* panache_bench_peer_int8(const Network* networks, size_t count,
                                               std::string* problem) {
  return make<OneDnnInt8Evaluation>(networks, count, problem);
}

}  // namespace panache::bench
