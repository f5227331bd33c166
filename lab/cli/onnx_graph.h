#pragma once
// Builds a graph of ONNX operators. Values are identified by name.

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <onnx/onnx_pb.h>

namespace panache::cli {

class OnnxGraph {
 public:
  // List attributes of operators, "axes".
  using Attributes = std::vector<std::pair<std::string, std::vector<int64_t>>>;

  // Fills `graph`, which outlives this.
  explicit OnnxGraph(onnx::GraphProto& graph) : graph_(graph) {}

  // Inputs and outputs of the model, float32 [batch, columns].
  std::string input(const std::string& name, size_t columns, const std::string& meaning);
  void output(const std::string& name, size_t columns, const std::string& meaning);

  // Adds constants; returns their name.
  std::string constant(const std::string& name, const std::vector<int64_t>& shape,
                       const std::vector<float>& values);
  std::string constant(const std::string& name, float value) { return constant(name, {}, {value}); }
  std::string integers(const std::string& name, const std::vector<int64_t>& values);

  // Adds an operator and returns the name of its output.
  std::string add(const std::string& type, const std::string& name,
                  const std::vector<std::string>& inputs, const Attributes& attributes = {});
  // Along the second dimension.
  std::string concat(const std::string& name, const std::vector<std::string>& inputs);
  // The sum of at least one value.
  std::string sum(const std::string& name, const std::vector<std::string>& terms);
  // [batch, columns] to [batch, 1].
  std::string row_sum(const std::string& name, const std::string& value);

 private:
  onnx::NodeProto& node(const std::string& type, const std::string& name,
                        const std::vector<std::string>& inputs);

  onnx::GraphProto& graph_;
};

}  // namespace panache::cli
