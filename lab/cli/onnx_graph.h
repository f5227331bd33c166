#pragma once
// A graph of ONNX operators, written one after another. Values are known by their names.

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <onnx/onnx_pb.h>

namespace panache::cli {

class OnnxGraph {
 public:
  // Lists in attributes of operators, "axes".
  using Attributes = std::vector<std::pair<std::string, std::vector<int64_t>>>;

  // Fills `graph`, which outlives this.
  explicit OnnxGraph(onnx::GraphProto& graph) : graph_(graph) {}

  // Values of the whole model, float32 [batch, columns].
  std::string input(const std::string& name, size_t columns, const std::string& meaning);
  void output(const std::string& name, size_t columns, const std::string& meaning);

  // Numbers that never change; their name.
  std::string constant(const std::string& name, const std::vector<int64_t>& shape,
                       const std::vector<float>& values);
  std::string constant(const std::string& name, float value) { return constant(name, {}, {value}); }
  std::string integers(const std::string& name, const std::vector<int64_t>& values);

  // What an operator makes of its inputs; `name` is its own.
  std::string add(const std::string& type, const std::string& name,
                  const std::vector<std::string>& inputs, const Attributes& attributes = {});
  // Along the second dimension of the inputs.
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
