#include "bench/onnx_graph.h"

namespace panache {

void OnnxGraph::describe(onnx::ValueInfoProto& value, const std::string& name, size_t columns,
                         const std::string& meaning) const {
  value.set_name(name);
  if (!meaning.empty()) value.set_doc_string(meaning);
  onnx::TypeProto_Tensor& type = *value.mutable_type()->mutable_tensor_type();
  type.set_elem_type(onnx::TensorProto::FLOAT);
  onnx::TensorShapeProto::Dimension& rows = *type.mutable_shape()->add_dim();
  if (rows_ > 0) {
    rows.set_dim_value(rows_);
  } else {
    rows.set_dim_param("batch");
  }
  type.mutable_shape()->add_dim()->set_dim_value(static_cast<int64_t>(columns));
}

std::string OnnxGraph::input(const std::string& name, size_t columns, const std::string& meaning) {
  describe(*graph_.add_input(), name, columns, meaning);
  return name;
}

void OnnxGraph::output(const std::string& name, size_t columns, const std::string& meaning) {
  describe(*graph_.add_output(), name, columns, meaning);
}

std::string OnnxGraph::tensor(const std::string& name, onnx::TensorProto::DataType type,
                              const std::vector<int64_t>& shape, const void* values, size_t bytes) {
  onnx::TensorProto& tensor = *graph_.add_initializer();
  tensor.set_name(name);
  tensor.set_data_type(type);
  for (const int64_t size : shape) tensor.add_dims(size);
  // Files are little-endian, like this machine.
  tensor.set_raw_data(values, bytes);
  return name;
}

std::string OnnxGraph::constant(const std::string& name, const std::vector<int64_t>& shape,
                                const std::vector<float>& values) {
  return tensor(name, onnx::TensorProto::FLOAT, shape, values.data(),
                values.size() * sizeof(float));
}

std::string OnnxGraph::int8(const std::string& name, const std::vector<int64_t>& shape,
                            const std::vector<int8_t>& values) {
  return tensor(name, onnx::TensorProto::INT8, shape, values.data(), values.size());
}

std::string OnnxGraph::integers(const std::string& name, const std::vector<int64_t>& values) {
  onnx::TensorProto& tensor = *graph_.add_initializer();
  tensor.set_name(name);
  tensor.set_data_type(onnx::TensorProto::INT64);
  tensor.add_dims(static_cast<int64_t>(values.size()));
  for (const int64_t value : values) tensor.add_int64_data(value);
  return name;
}

std::string OnnxGraph::add(const std::string& type, const std::string& name,
                           const std::vector<std::string>& inputs,
                           const std::vector<std::string>& more) {
  onnx::NodeProto& node = *graph_.add_node();
  node.set_op_type(type);
  node.set_name(name);
  for (const std::string& input : inputs) node.add_input(input);
  node.add_output(name);
  for (const std::string& output : more) node.add_output(output);
  return name;
}

std::string OnnxGraph::add(const std::string& type, const std::string& name,
                           const std::vector<std::string>& inputs, const std::string& key,
                           int64_t value) {
  add(type, name, inputs);
  onnx::AttributeProto& attribute = *graph_.mutable_node()->rbegin()->add_attribute();
  attribute.set_name(key);
  attribute.set_type(onnx::AttributeProto::INT);
  attribute.set_i(value);
  return name;
}

std::string OnnxGraph::concat(const std::string& name, const std::vector<std::string>& inputs) {
  return add("Concat", name, inputs, "axis", 1);
}

std::string OnnxGraph::sum(const std::string& name, const std::vector<std::string>& terms) {
  return add("Sum", name, terms);
}

std::string OnnxGraph::row_sum(const std::string& name, const std::string& value) {
  return add("ReduceSum", name, {value, "columns"});
}

}  // namespace panache
