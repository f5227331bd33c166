#include "bench/onnx_file.h"

#include "bench/int8_layer.h"
#include "bench/onnx_graph.h"

namespace panache::bench {
namespace {

// Supported by every recent ONNX Runtime: Gemm 9 and Elu 6.
constexpr int64_t kFormatVersion = 7, kOperatorVersion = 11;

// y = x W + b. `x` and `y` are tensor names, `id` identifies the layer's tensors.
void add_layer(OnnxGraph& graph, const Layer& layer, const std::string& id, const std::string& x,
               const std::string& y) {
  graph.add("Gemm", y,
            {x, graph.constant("weight" + id, {layer.inputs, layer.outputs}, layer.weights),
             graph.constant("bias" + id, {layer.outputs}, layer.bias)});
}

// The tensor names of a quantized input.
struct Quantized {
  std::string bytes, scale, zero;
};
Quantized add_quantization(OnnxGraph& graph, const std::string& x) {
  const Quantized out{x + "_bytes", x + "_scale", x + "_zero"};
  graph.add("DynamicQuantizeLinear", out.bytes, {x}, {out.scale, out.zero});
  return out;
}

// The same with the operators of ONNX Runtime's own dynamic quantization, which it fuses.
void add_int8_layer(OnnxGraph& graph, const Layer& layer, const std::string& id, const Quantized& x,
                    const std::string& y) {
  const Int8Layer int8 = quantized(layer);
  graph.int8("weight" + id, {layer.inputs, layer.outputs}, int8.weights);
  graph.constant("scale" + id, {layer.outputs}, int8.scale);
  graph.constant("bias" + id, {layer.outputs}, layer.bias);
  graph.add("MatMulInteger", "whole" + id, {x.bytes, "weight" + id, x.zero});
  graph.add("Cast", "product" + id, {"whole" + id}, "to", onnx::TensorProto::FLOAT);
  graph.add("Mul", "unit" + id, {x.scale, "scale" + id});
  graph.add("Mul", "scaled" + id, {"product" + id, "unit" + id});
  graph.add("Add", y, {"scaled" + id, "bias" + id});
}

}  // namespace

std::string format_onnx(std::span<const Network> networks, bool int8) {
  onnx::ModelProto model;
  model.set_ir_version(kFormatVersion);
  model.add_opset_import()->set_version(kOperatorVersion);
  model.mutable_graph()->set_name("networks");
  OnnxGraph graph(*model.mutable_graph(), 1);
  graph.input("x", static_cast<size_t>(networks.front().layers.front().inputs));
  Quantized input;  // Shared by all networks.
  if (int8) input = add_quantization(graph, "x");
  for (size_t n = 0; n < networks.size(); ++n) {
    const std::vector<Layer>& layers = networks[n].layers;
    std::string from = "x";
    for (size_t l = 0; l < layers.size(); ++l) {
      const bool last = l + 1 == layers.size();
      const std::string id = std::to_string(n) + "_" + std::to_string(l);
      const std::string to = last ? "y" + std::to_string(n) : "sum" + id;
      if (int8) {
        add_int8_layer(graph, layers[l], id, l == 0 ? input : add_quantization(graph, from), to);
      } else {
        add_layer(graph, layers[l], id, from, to);
      }
      if (last) {
        graph.output(to, static_cast<size_t>(layers[l].outputs));
      } else {
        from = graph.add("Elu", "hidden" + id, {to});
      }
    }
  }
  return model.SerializeAsString();
}

}  // namespace panache::bench
