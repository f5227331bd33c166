#include "bench/onnx_file.h"

#include <bit>
#include <cstdint>
#include <cstring>

namespace panache::bench {
namespace {

// A protocol buffer in the making. Numbers of fields and types are those of onnx.proto.
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

constexpr uint64_t kFloat = 1;
// Old enough for any ONNX Runtime of the last years: Gemm 9 and Elu 6.
constexpr uint64_t kFormatVersion = 7, kOperatorVersion = 11;

Message tensor(const std::string& name, std::initializer_list<int> shape,
               std::span<const float> values) {
  static_assert(std::endian::native == std::endian::little);
  Message out;
  for (const int size : shape) out.number(1, static_cast<uint64_t>(size));
  out.number(2, kFloat);
  out.text(8, name);
  std::string raw(values.size_bytes(), '\0');
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
             const std::string& output) {
  Message out;
  for (const std::string& input : inputs) out.text(1, input);
  out.text(2, output);
  out.text(4, type);
  return out;
}

}  // namespace

std::string format_onnx(std::span<const Network> networks) {
  Message graph;
  graph.text(2, "networks");
  graph.message(11, value_info("x", networks.front().layers.front().inputs));
  for (size_t n = 0; n < networks.size(); ++n) {
    const std::vector<Layer>& layers = networks[n].layers;
    std::string from = "x";
    for (size_t l = 0; l < layers.size(); ++l) {
      const bool last = l + 1 == layers.size();
      const std::string id = std::to_string(n) + "_" + std::to_string(l);
      const std::string to = last ? "y" + std::to_string(n) : "sum" + id;
      graph.message(
          5, tensor("weight" + id, {layers[l].inputs, layers[l].outputs}, layers[l].weights));
      graph.message(5, tensor("bias" + id, {layers[l].outputs}, layers[l].bias));
      graph.message(1, node("Gemm", {from, "weight" + id, "bias" + id}, to));
      if (last) {
        graph.message(12, value_info(to, layers[l].outputs));
      } else {
        from = "hidden" + id;
        graph.message(1, node("Elu", {to}, from));
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
