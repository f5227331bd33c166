#include "onnx_model.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

#include "bench/onnx_graph.h"
#include "net/layer.h"
#include "pose/features.h"
#include "style/model/model.h"
#include "style/stages/strengths.h"

namespace panache::cli {
namespace {

constexpr const char* kSmith2019 = "smith2019";

// The graph of one model. Values that are tensors of the model keep their names.
class OnnxWriter {
 public:
  OnnxWriter(onnx::GraphProto& graph, const TensorFile& file, const Model& model)
      : graph_(graph), file_(file), model_(model), styles_(model.styles().size()) {
    while (file.tensors.contains("learnt." + std::to_string(learnt_) + ".head.weight")) ++learnt_;
  }

  void write() {
    one_ = graph_.constant("one", 1);
    graph_.integers("columns", {1});
    windows_ = graph_.input("windows", window_size(),
                            "6 poses 0.05 s apart, newest first: the pose features of the model's "
                            "layout, which metadata 'input' names");
    strengths_ = graph_.input("strengths", styles_, "Of each style, in the model's order; -4 to 4");
    const std::string input = write_input();
    if (model_.recipe().style_heads) {
      posture_ = driven("posture", kPostureEven);
      movement_ = driven("movement", kMovementEven);
    }
    pose_ = layers("pose", input);
    const bool reads_all = file_.tensors.contains("pose.reduce.0.weight");
    std::string hidden = pose_.back();
    if (file_.tensors.contains("gate.limit")) hidden = shrink(hidden);
    std::vector<std::string> pose =
        reads_all ? reduced_heads() : heads("pose", hidden, model_.recipe().outputs);
    std::vector<std::string> timing, contact;
    if (has("timing")) timing = heads("timing", layers("timing", input).back(), 1);
    if (has("contact")) contact = heads("contact", layers("contact", input).back(), 2);
    for (size_t k = 0; k < learnt_; ++k) add_learnt(k, pose, timing, contact);
    write_outputs(pose, timing, contact);
  }

 private:
  size_t window_size() const {
    return size_t(kWindowPoses) * static_cast<size_t>(pose_feature_count(model_.layout()));
  }
  size_t built_in() const { return styles_ - learnt_; }
  bool has(const std::string& network) const {
    return file_.tensors.contains(network + ".trunk.0.weight");
  }
  const Tensor& tensor(const std::string& name) const { return file_.tensors.at(name); }
  // A tensor of the model under its own name.
  std::string constant(const std::string& name) {
    return graph_.constant(name, tensor(name).shape, tensor(name).values);
  }
  // y = x W + b, of layer `name`.
  std::string dense(const std::string& name, const std::string& x) {
    return graph_.add("Gemm", name, {x, constant(name + ".weight"), constant(name + ".bias")});
  }

  // Inputs of the trunks: the standardised window, and the recipe's style inputs if it has any.
  std::string write_input() {
    std::vector<float> mean, factor;
    for (int k = 0; k < kWindowPoses; ++k) {
      for (const float m : tensor("input.mean").values) mean.push_back(m);
      for (const float s : tensor("input.scale").values) factor.push_back(1 / s);
    }
    const auto size = static_cast<int64_t>(mean.size());
    std::string input =
        graph_.add("Sub", "input.centred", {windows_, graph_.constant("input.mean", {size}, mean)});
    input = graph_.add("Mul", "input.standardised",
                       {input, graph_.constant("input.factor", {size}, factor)});
    if (const float clip = tensor("input.clip").values[0]; clip > 0) {
      input = graph_.add(
          "Clip", "input.clipped",
          {input, graph_.constant("input.lowest", -clip), graph_.constant("input.highest", clip)});
    }
    if (model_.recipe().style_heads) return input;
    // Neutral, which gets 1 minus the sum of the styles, then the styles.
    std::string neutral =
        graph_.add("Sub", "input.remainder", {one_, graph_.row_sum("input.strength", strengths_)});
    neutral = graph_.add("Relu", "input.neutral", {neutral});
    return graph_.concat("input.all", {input, neutral, strengths_});
  }

  // Effective strengths: linear up to `even`, damped beyond.
  std::string driven(const std::string& what, float even) {
    const std::string name = "strengths." + what;
    const std::string core = graph_.add("Clip", name + ".core",
                                        {strengths_, graph_.constant(name + ".least", -even),
                                         graph_.constant(name + ".even", even)});
    std::string more = graph_.add("Sub", name + ".more", {strengths_, core});
    more =
        graph_.add("Mul", name + ".beyond", {more, graph_.constant(name + ".share", kBeyondEven)});
    return graph_.add("Add", name, {core, more});
  }
  // [batch, count]
  std::string columns(const std::string& name, const std::string& value, size_t first,
                      size_t count) {
    const auto begin = static_cast<int64_t>(first), end = static_cast<int64_t>(first + count);
    return graph_.add("Slice", name,
                      {value, graph_.integers(name + ".from", {begin}),
                       graph_.integers(name + ".to", {end}), "columns"});
  }

  // The activations of all hidden layers of a network.
  std::vector<std::string> layers(const std::string& network, std::string x) {
    std::vector<std::string> out;
    for (size_t l = 0;; ++l) {
      const std::string name = network + ".trunk." + std::to_string(l);
      if (!file_.tensors.contains(name + ".weight")) return out;
      x = graph_.add("Elu", name + ".active", {dense(name, x)});
      out.push_back(x);
    }
  }

  // Draws activations to their mean, depending on the distance of the window from training data.
  // data.
  std::string shrink(const std::string& hidden) {
    const std::string mean = constant("gate.mean");
    const std::string centred = graph_.add("Sub", "gate.centred", {hidden, mean});
    const std::string square = square_length("gate", dense("gate.whitening", centred));
    const float limit = tensor("gate.limit").values[0];
    std::string near = graph_.add("Div", "gate.ratio",
                                  {graph_.constant("gate.square_limit", limit * limit), square});
    near = graph_.add("Min", "gate.near", {near, one_});
    gate_ = graph_.add("Mul", "gate.open", {near, near});
    return drawn("gate", mean, centred, gate_);
  }
  std::string square_length(const std::string& name, const std::string& x) {
    return graph_.row_sum(name + ".square", graph_.add("Mul", name + ".each_square", {x, x}));
  }
  // mean + open * centred
  std::string drawn(const std::string& name, const std::string& mean, const std::string& centred,
                    const std::string& open) {
    const std::string part = graph_.add("Mul", name + ".part", {centred, open});
    return graph_.add("Add", name + ".drawn", {mean, part});
  }

  // The outputs of a network's heads as terms of a sum: the one that is always active, and those of
  // the styles, weighted by their strengths.
  std::vector<std::string> heads(const std::string& network, const std::string& hidden,
                                 int outputs) {
    const auto head = [&](size_t h) { return network + ".head." + std::to_string(h); };
    size_t count = 0;
    while (file_.tensors.contains(head(count) + ".weight")) ++count;
    const size_t always = count > built_in() || !model_.recipe().style_heads ? 1 : 0;
    std::vector<std::string> terms;
    if (always > 0 && count > 0) terms.push_back(dense(head(0), hidden));
    if (count <= always) return terms;
    // All heads side by side in one matrix. [hidden][styles * outputs]
    const size_t styles = count - always, width = static_cast<size_t>(outputs);
    const size_t inputs = static_cast<size_t>(tensor(head(0) + ".weight").shape[0]);
    std::vector<float> weights(inputs * styles * width), bias;
    for (size_t s = 0; s < styles; ++s) {
      const std::vector<float>& from = tensor(head(always + s) + ".weight").values;
      for (size_t i = 0; i < inputs; ++i) {
        std::copy_n(&from[i * width], width, &weights[(i * styles + s) * width]);
      }
      const std::vector<float>& more = tensor(head(always + s) + ".bias").values;
      bias.insert(bias.end(), more.begin(), more.end());
    }
    const std::string name = network + ".heads";
    const auto all = static_cast<int64_t>(styles * width);
    std::string answers = graph_.add(
        "Gemm", name,
        {hidden, graph_.constant(name + ".weight", {static_cast<int64_t>(inputs), all}, weights),
         graph_.constant(name + ".bias", {all}, bias)});
    answers =
        graph_.add("Reshape", name + ".by_style",
                   {answers, graph_.integers(name + ".shape", {-1, static_cast<int64_t>(styles),
                                                               static_cast<int64_t>(width)})});
    std::string by =
        columns(name + ".strengths", network == "pose" ? posture_ : movement_, 0, styles);
    by = graph_.add("Unsqueeze", name + ".strengths_by_style",
                    {by, graph_.integers(name + ".axis", {2})});
    answers = graph_.add("Mul", name + ".driven", {answers, by});
    // Sums over the styles, [batch, outputs].
    answers = graph_.add("ReduceSum", name + ".sum", {answers, "columns"});
    terms.push_back(graph_.add("Squeeze", name + ".answer", {answers, "columns"}));
    return terms;
  }

  // The activations of all hidden layers of the pose network.
  const std::string& activations() {
    if (activations_.empty()) activations_ = graph_.concat("activations", pose_);
    return activations_;
  }

  // Pose heads that read combinations of all activations, as terms of a sum.
  std::vector<std::string> reduced_heads() {
    std::vector<std::string> terms;
    for (size_t s = 0; s < built_in(); ++s) {
      const std::string number = std::to_string(s), name = "pose.head." + number;
      std::string reduced = dense("pose.reduce." + number, activations());
      if (!gate_.empty()) {
        reduced = graph_.add("Mul", "pose.reduce." + number + ".open", {reduced, gate_});
      }
      terms.push_back(
          graph_.add("Mul", name + ".driven",
                     {dense(name, reduced), columns(name + ".strength", posture_, s, 1)}));
    }
    return terms;
  }

  // A learnt style: closed form on the activations of all hidden layers, with its own gate.
  void add_learnt(size_t k, std::vector<std::string>& pose, std::vector<std::string>& timing,
                  std::vector<std::string>& contact) {
    const std::string name = "learnt." + std::to_string(k);
    if (k == 0) {
      std::vector<float> factor;
      for (const float scale : tensor("learn.scale").values) factor.push_back(1 / scale);
      graph_.constant("learn.factor", tensor("learn.scale").shape, factor);
    }
    const std::string mean = constant(name + ".mean");
    const std::string centred = graph_.add("Sub", name + ".centred", {activations(), mean});
    const std::string apart = graph_.add("Mul", name + ".apart", {centred, "learn.factor"});
    const std::string rest =
        graph_.add("Mul", name + ".rest",
                   {square_length(name + ".apart", apart), constant(name + ".gate.rest")});
    const std::string along = dense(name + ".gate", activations());
    std::string far = graph_.add("Mul", name + ".squares", {along, along});
    far = graph_.add("Mul", name + ".worths", {far, constant(name + ".gate.worth")});
    far = graph_.sum(name + ".far", {rest, graph_.row_sum(name + ".along", far)});
    const std::string open = graph_.add("Div", name + ".open",
                                        {one_, graph_.add("Max", name + ".bounded", {far, one_})});
    learnt_gates_.push_back(open);
    const std::string answer = dense(name + ".head", drawn(name, mean, centred, open));
    const auto part = [&](const std::string& what, const std::string& strengths, size_t first,
                          size_t count) {
      const std::string of = name + "." + what;
      return graph_.add("Mul", of,
                        {columns(of + ".answer", answer, first, count),
                         columns(of + ".strength", strengths, built_in() + k, 1)});
    };
    constexpr size_t kChange = StyleDelta::kSize;
    pose.push_back(part("change", posture_, 0, kChange));
    timing.push_back(part("timing", movement_, kChange, 1));
    contact.push_back(part("contact", movement_, kChange + 1, 2));
  }

  void write_outputs(const std::vector<std::string>& pose, const std::vector<std::string>& timing,
                     const std::vector<std::string>& contact) {
    const bool heads = model_.recipe().style_heads;
    const std::string name = heads ? "changes" : "poses";
    const bool has_mean = file_.tensors.contains("output.mean");
    const std::string scaled =
        graph_.add("Mul", has_mean ? name + ".scaled" : name,
                   {graph_.sum(name + ".sum", pose), constant("output.scale")});
    if (has_mean) graph_.add("Add", name, {scaled, constant("output.mean")});
    graph_.output(name, static_cast<size_t>(model_.recipe().outputs),
                  heads ? "Rotation vectors of the 21 joints, heading frame, rad; height of the "
                          "hips, m; velocity to the left and ahead, m/s; turn rate, rad/s"
                        : "The pose in the style, as a pose of the windows");
    graph_.sum("log_rates", timing);
    graph_.output("log_rates", 1, "Logarithm of input seconds per output second");
    graph_.add("Sigmoid", "contacts", {graph_.sum("contacts.sum", contact)});
    graph_.output("contacts", 2, "Probability that the left and the right foot are planted");
    if (heads) write_gate();
  }

  // The mean gate of the styles, weighted by the absolute values of their strengths.
  void write_gate() {
    const std::string size = graph_.add("Abs", "gate.sizes", {strengths_});
    const std::string total = graph_.row_sum("gate.total", size);
    const std::string zero = graph_.constant("zero", 0);
    if (gate_.empty()) {  // Always open: ones, one per window.
      const std::string zeros = graph_.add("Mul", "gate.zeros", {total, zero});
      gate_ = graph_.add("Add", "gate.open", {zeros, one_});
    }
    std::vector<std::string> gates(built_in(), gate_);
    gates.insert(gates.end(), learnt_gates_.begin(), learnt_gates_.end());
    const std::string open =
        graph_.add("Mul", "gate.weighted", {size, graph_.concat("gate.all", gates)});
    std::string mean =
        graph_.add("Div", "gate.quotient", {graph_.row_sum("gate.sum", open), total});
    mean = graph_.add("Min", "gate.mean_open", {mean, one_});
    const std::string any = graph_.add("Greater", "gate.any", {total, zero});
    graph_.add("Where", "gate", {any, mean, gate_});
    graph_.output("gate", 1, "1: motion like what the model knows; 0: unlike");
  }

  OnnxGraph graph_;
  const TensorFile& file_;
  const Model& model_;
  size_t styles_, learnt_ = 0;
  std::string one_, windows_, strengths_;
  std::string posture_, movement_;  // Effective strengths.
  std::vector<std::string> pose_;   // Activations of the pose network's hidden layers.
  std::string activations_;         // All of them together, once they are read.
  std::string gate_;                // Of the built-in styles; empty if the model has none.
  std::vector<std::string> learnt_gates_;
};

}  // namespace

Result<std::string> to_onnx(const TensorFile& file, const std::string& name) {
  Result<std::shared_ptr<const Model>> model = Model::create(file, name);
  if (!model) return model.error();
  if (is_quantized(file)) {
    return Error{name +
                 ": has int8 weights, whose arithmetic ONNX does not have; expected the model of "
                 "floats that it was quantized from"};
  }
  if ((*model)->styles().empty()) {
    return Error{name + ": has no styles; expected a model with at least one"};
  }
  const Recipe& recipe = (*model)->recipe();
  if (!recipe.style_heads && recipe.name != std::string(kSmith2019)) {
    return Error{name + ": is of recipe " + recipe.name +
                 "; expected one with heads for styles, or " + kSmith2019};
  }
  onnx::ModelProto out;
  out.set_ir_version(8);  // Released together with opset 17.
  out.set_producer_name("panache");
  out.add_opset_import()->set_version(kOnnxOpset);
  for (const auto& [key, value] : file.metadata) {
    onnx::StringStringEntryProto& entry = *out.add_metadata_props();
    entry.set_key(key);
    entry.set_value(value);
  }
  out.mutable_graph()->set_name("panache");
  OnnxWriter(*out.mutable_graph(), file, **model).write();
  return out.SerializeAsString();
}

}  // namespace panache::cli
