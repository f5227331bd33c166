#include "onnx_graph.h"

namespace panache::cli {
namespace {

void describe(onnx::ValueInfoProto& value, const std::string& name, size_t columns,
              const std::string& meaning) {
  value.set_name(name);
  value.set_doc_string(meaning);
  onnx::TypeProto_Tensor& type = *value.mutable_type()->mutable_tensor_type();
  type.set_elem_type(onnx::TensorProto::FLOAT);
  type.mutable_shape()->add_dim()->set_dim_param("batch");
  type.mutable_shape()->add_dim()->set_dim_value(static_cast<int64_t>(columns));
}

}  // namespace

std::string OnnxGraph::input(const std::string& name, size_t columns, const std::string& meaning) {
  describe(*graph_.add_input(), name, columns, meaning);
  return name;
}

void OnnxGraph::output(const std::string& name, size_t columns, const std::string& meaning) {
  describe(*graph_.add_output(), name, columns, meaning);
}

std::string OnnxGraph::constant(const std::string& name, const std::vector<int64_t>& shape,
                                const std::vector<float>& values) {
  onnx::TensorProto& tensor = *graph_.add_initializer();
  tensor.set_name(name);
  tensor.set_data_type(onnx::TensorProto::FLOAT);
  for (const int64_t size : shape) tensor.add_dims(size);
  // Files are little-endian, like this machine.
  tensor.set_raw_data(values.data(), values.size() * sizeof(float));
  return name;
}

std::string OnnxGraph::integers(const std::string& name, const std::vector<int64_t>& values) {
  onnx::TensorProto& tensor = *graph_.add_initializer();
  tensor.set_name(name);
  tensor.set_data_type(onnx::TensorProto::INT64);
  tensor.add_dims(static_cast<int64_t>(values.size()));
  for (const int64_t value : values) tensor.add_int64_data(value);
  return name;
}

onnx::NodeProto& OnnxGraph::node(const std::string& type, const std::string& name,
                                 const std::vector<std::string>& inputs) {
  onnx::NodeProto& node = *graph_.add_node();
  node.set_op_type(type);
  node.set_name(name);
  for (const std::string& input : inputs) node.add_input(input);
  node.add_output(name);
  return node;
}

std::string OnnxGraph::add(const std::string& type, const std::string& name,
                           const std::vector<std::string>& inputs, const Attributes& attributes) {
  onnx::NodeProto& made = node(type, name, inputs);
  for (const auto& [key, values] : attributes) {
    onnx::AttributeProto& attribute = *made.add_attribute();
    attribute.set_name(key);
    attribute.set_type(onnx::AttributeProto::INTS);
    for (const int64_t value : values) attribute.add_ints(value);
  }
  return name;
}

std::string OnnxGraph::concat(const std::string& name, const std::vector<std::string>& inputs) {
  onnx::AttributeProto& axis = *node("Concat", name, inputs).add_attribute();
  axis.set_name("axis");
  axis.set_type(onnx::AttributeProto::INT);
  axis.set_i(1);
  return name;
}

std::string OnnxGraph::sum(const std::string& name, const std::vector<std::string>& terms) {
  return add("Sum", name, terms);
}

std::string OnnxGraph::row_sum(const std::string& name, const std::string& value) {
  return add("ReduceSum", name, {value, "columns"});
}

}  // namespace panache::cli
