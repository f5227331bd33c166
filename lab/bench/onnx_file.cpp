#include "bench/onnx_file.h"

#include <bit>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "bench/int8_layer.h"

namespace panache::bench {
namespace {

// Writes a protocol buffer. Field numbers and types are those of onnx.proto.
class Message {
 public:
  void number(int field, uint64_t value) {
    varint(static_cast<uint64_t>(field) << 3);
    varint(value);
  }
  void text(int field, const std::string& bytes) {
    constexpr uint64_t kLengthDelimited = 2;
    varint(static_cast<uint64_t>(field) << 3 | kLengthDelimited);
    varint(bytes.size());
    bytes_ += bytes;
  }
  void message(int field, const Message& part) { text(field, part.bytes_); }
  const std::string& bytes() const { return bytes_; }

 private:
  void varint(uint64_t value) {
    for (; value >= 0x80; value >>= 7) bytes_ += static_cast<char>(value | 0x80);
    bytes_ += static_cast<char>(value);
  }
  std::string bytes_;
};

constexpr uint64_t kFloat = 1, kInt8 = 3;
// Supported by every recent ONNX Runtime: Gemm 9 and Elu 6.
constexpr uint64_t kFormatVersion = 7, kOperatorVersion = 11;

template <class T>
Message tensor(const std::string& name, std::initializer_list<int> shape,
               const std::vector<T>& values) {
  static_assert(std::endian::native == std::endian::little);
  Message out;
  for (const int size : shape) out.number(1, static_cast<uint64_t>(size));
  out.number(2, std::is_same_v<T, float> ? kFloat : kInt8);
  out.text(8, name);
  std::string raw(values.size() * sizeof(T), '\0');
  std::memcpy(raw.data(), values.data(), raw.size());
  out.text(9, raw);
  return out;
}

// A name with type float and shape [1][size].
Message value_info(const std::string& name, int size) {
  Message shape;
  for (const int n : {1, size}) {
    Message dimension;
    dimension.number(1, static_cast<uint64_t>(n));
    shape.message(1, dimension);
  }
  Message tensor_type, type, out;
  tensor_type.number(1, kFloat);
  tensor_type.message(2, shape);
  type.message(1, tensor_type);
  out.text(1, name);
  out.message(2, type);
  return out;
}

Message node(const std::string& type, std::initializer_list<std::string> inputs,
             std::initializer_list<std::string> outputs) {
  Message out;
  for (const std::string& input : inputs) out.text(1, input);
  for (const std::string& output : outputs) out.text(2, output);
  out.text(4, type);
  return out;
}

Message cast_to_float(const std::string& input, const std::string& output) {
  constexpr uint64_t kIntType = 2;
  Message to, out = node("Cast", {input}, {output});
  to.text(1, "to");
  to.number(3, kFloat);
  to.number(20, kIntType);
  out.message(5, to);
  return out;
}

// y = x W + b. `x` and `y` are tensor names, `id` identifies the layer's tensors.
void add_layer(Message& graph, const Layer& layer, const std::string& id, const std::string& x,
               const std::string& y) {
  graph.message(5, tensor("weight" + id, {layer.inputs, layer.outputs}, layer.weights));
  graph.message(5, tensor("bias" + id, {layer.outputs}, layer.bias));
  graph.message(1, node("Gemm", {x, "weight" + id, "bias" + id}, {y}));
}

// The tensor names of a quantized input.
struct Quantized {
  std::string bytes, scale, zero;
};
Quantized add_quantization(Message& graph, const std::string& x) {
  const Quantized out{x + "_bytes", x + "_scale", x + "_zero"};
  graph.message(1, node("DynamicQuantizeLinear", {x}, {out.bytes, out.scale, out.zero}));
  return out;
}

// The same with the operators of ONNX Runtime's own dynamic quantization, which it fuses.
void add_int8_layer(Message& graph, const Layer& layer, const std::string& id, const Quantized& x,
                    const std::string& y) {
  const Int8Layer int8 = quantized(layer);
  graph.message(5, tensor("weight" + id, {layer.inputs, layer.outputs}, int8.weights));
  graph.message(5, tensor("scale" + id, {layer.outputs}, int8.scale));
  graph.message(5, tensor("bias" + id, {layer.outputs}, layer.bias));
  graph.message(1, node("MatMulInteger", {x.bytes, "weight" + id, x.zero}, {"whole" + id}));
  graph.message(1, cast_to_float("whole" + id, "product" + id));
  graph.message(1, node("Mul", {x.scale, "scale" + id}, {"unit" + id}));
  graph.message(1, node("Mul", {"product" + id, "unit" + id}, {"scaled" + id}));
  graph.message(1, node("Add", {"scaled" + id, "bias" + id}, {y}));
}

}  // namespace

std::string format_onnx(std::span<const Network> networks, bool int8) {
  Message graph;
  graph.text(2, "networks");
  graph.message(11, value_info("x", networks.front().layers.front().inputs));
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
        graph.message(12, value_info(to, layers[l].outputs));
      } else {
        from = "hidden" + id;
        graph.message(1, node("Elu", {to}, {from}));
      }
    }
  }
  Message operators, model;
  operators.number(2, kOperatorVersion);
  model.number(1, kFormatVersion);
  model.message(8, operators);
  model.message(7, graph);
  return model.bytes();
}

}  // namespace panache::bench
