#pragma once
// Builds a graph of ONNX operators. Values are identified by name.

#include <cstdint>
#include <string>
#include <vector>

#include <onnx/onnx_pb.h>

namespace panache {

class OnnxGraph {
 public:
  // Fills `graph`, which outlives this. `rows` of inputs and outputs; 0 is any number of them.
  explicit OnnxGraph(onnx::GraphProto& graph, int64_t rows = 0) : graph_(graph), rows_(rows) {}

  // Inputs and outputs of the model, float32 [rows, columns].
  std::string input(const std::string& name, size_t columns, const std::string& meaning = "");
  void output(const std::string& name, size_t columns, const std::string& meaning = "");

  // Adds constants; returns their name.
  std::string constant(const std::string& name, const std::vector<int64_t>& shape,
                       const std::vector<float>& values);
  std::string constant(const std::string& name, float value) { return constant(name, {}, {value}); }
  std::string int8(const std::string& name, const std::vector<int64_t>& shape,
                   const std::vector<int8_t>& values);
  std::string integers(const std::string& name, const std::vector<int64_t>& values);

  // Adds an operator and returns the name of its output, or of the first: `more` names the others.
  std::string add(const std::string& type, const std::string& name,
                  const std::vector<std::string>& inputs,
                  const std::vector<std::string>& more = {});
  // The same with an integer as attribute.
  std::string add(const std::string& type, const std::string& name,
                  const std::vector<std::string>& inputs, const std::string& key, int64_t value);
  // Along the second dimension.
  std::string concat(const std::string& name, const std::vector<std::string>& inputs);
  // The sum of at least one value.
  std::string sum(const std::string& name, const std::vector<std::string>& terms);
  // [batch, columns] to [batch, 1].
  std::string row_sum(const std::string& name, const std::string& value);

 private:
  void describe(onnx::ValueInfoProto& value, const std::string& name, size_t columns,
                const std::string& meaning) const;
  std::string tensor(const std::string& name, onnx::TensorProto::DataType type,
                     const std::vector<int64_t>& shape, const void* values, size_t bytes);

  onnx::GraphProto& graph_;
  int64_t rows_;
};

}  // namespace panache
