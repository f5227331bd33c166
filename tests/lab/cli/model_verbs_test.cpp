// What the verbs of panache-lab share, and those that make files of models.

#include "lab_program.h"
#include "net/layer.h"

namespace panache::test {
namespace {

// What the verbs of panache-lab share.

using LabProgram = LabTest;

TEST_F(LabProgram, every_verb_has_help_with_an_example) {
  const std::string help = run("--help").out;
  for (const std::string verb :
       {"train", "eval", "bench", "strip", "quantize", "export", "fit-walker"}) {
    const Ran ran = run({verb, "--help"});
    EXPECT_EQ(ran.exit, 0) << verb;
    EXPECT_TRUE(holds(ran.out, "\n  panache-lab " + verb));
    EXPECT_TRUE(holds(help, "\n  " + verb)) << verb;
  }
}

TEST_F(LabProgram, it_says_its_name) {
  EXPECT_TRUE(run("--version").out.starts_with("panache-lab 0."));
  const Ran ran = run("stylize walk.bvh");
  EXPECT_EQ(ran.exit, 2);
  EXPECT_TRUE(begins(ran.err, "panache-lab: there is no command 'stylize'; expected train, "));
  EXPECT_EQ(run("quantize model.safetensors more -o out.safetensors").err,
            "panache-lab: unexpected argument 'more'; see panache-lab quantize --help\n");
}

TEST_F(LabProgram, fit_walker_says_what_it_lacks) {
  EXPECT_EQ(run("fit-walker none.csv -o walker.safetensors").err,
            "panache-lab: none.csv: cannot be read: No such file or directory\n");
  write("walker.safetensors", "mine");
  EXPECT_EQ(run("fit-walker none.csv -o walker.safetensors").err,
            "panache-lab: walker.safetensors: exists already; --force overwrites it\n");
}

// panache-lab quantize: int8 models.

class QuantizeVerb : public LabTest {
 protected:
};

TEST_F(QuantizeVerb, writes_a_smaller_model_of_the_same_styles_and_says_both_sizes) {
  const std::string whole = read("model.safetensors");
  const Ran ran = must("quantize model.safetensors -o int8.safetensors");
  const std::string int8 = read("int8.safetensors");
  EXPECT_LT(int8.size(), whole.size());
  const auto size = [](const std::string& bytes) {
    char text[32];
    std::snprintf(text, sizeof text, "%.1f KB", static_cast<double>(bytes.size()) / 1000);
    return std::string(text);
  };
  EXPECT_EQ(ran.out, "quantized model.safetensors (" + size(whole) + ") into int8.safetensors (" +
                         size(int8) + ")\n");
  const auto before = Model::parse(whole, "whole"), after = Model::parse(int8, "int8");
  ASSERT_TRUE(after.ok()) << after.error().message;
  EXPECT_EQ((*after)->metadata(), (*before)->metadata());
  EXPECT_EQ((*after)->parameter_count(), (*before)->parameter_count());
  EXPECT_TRUE(is_quantized(*parse_safetensors(int8, "int8")));
}

TEST_F(QuantizeVerb, its_model_styles_a_walk) {
  write_walk("walk.bvh");
  must("quantize model.safetensors -o int8.safetensors");
  const Ran ran = run_panache("stylize walk.bvh --style old=1 -o old.bvh", "int8.safetensors");
  EXPECT_EQ(ran.exit, 0) << ran.err;
  EXPECT_TRUE(exists("old.bvh"));
}

TEST_F(QuantizeVerb, takes_the_file_of_a_style) {
  ASSERT_EQ(run_panache("styles model.safetensors --extract old -o old.safetensors").exit, 0);
  const Ran ran = must("quantize old.safetensors -o int8.safetensors");
  EXPECT_TRUE(begins(ran.out, "quantized old.safetensors ("));
  EXPECT_LT(read("int8.safetensors").size(), read("old.safetensors").size());
  expect_rejected("quantize int8.safetensors -o quarter.safetensors", 1,
                  "int8.safetensors: is a style with int8 weights already");
  EXPECT_EQ(run_panache("styles model.safetensors --add int8.safetensors --force").exit, 0);
  TensorFile bad = *parse_safetensors(read("old.safetensors"), "old");
  bad.tensors["pose.head.bias"].values[0] = INFINITY;
  write("bad.safetensors", format_safetensors(bad));
  expect_rejected("quantize bad.safetensors -o quarter.safetensors", 1,
                  "bad.safetensors: tensor 'pose.head.bias' holds a number that is not finite");
}

// As it comes about when a style is put into a int8 model.
TEST_F(QuantizeVerb, quantizes_the_rest_of_a_model_that_is_half_quantized) {
  ASSERT_EQ(run_panache("styles model.safetensors --extract old -o old.safetensors").exit, 0);
  must("quantize model.safetensors -o int8.safetensors");
  const std::string int8 = read("int8.safetensors");
  ASSERT_EQ(run_panache("styles int8.safetensors --add old.safetensors --force").exit, 0);
  EXPECT_GT(read("int8.safetensors").size(), int8.size());
  must("quantize int8.safetensors -o whole.safetensors");
  EXPECT_TRUE(read("whole.safetensors") == int8);
}

TEST_F(QuantizeVerb, a_file_that_exists_is_kept_unless_forced) {
  write("int8.safetensors", "mine");
  expect_rejected("quantize model.safetensors -o int8.safetensors", 1,
                  "int8.safetensors: exists already; --force overwrites it");
  EXPECT_EQ(read("int8.safetensors"), "mine");
  must("quantize model.safetensors -o int8.safetensors --force");
  must("quantize model.safetensors -o new.safetensors");
  EXPECT_TRUE(read("int8.safetensors") == read("new.safetensors"));
}

TEST_F(QuantizeVerb, explains_what_it_cannot_quantize) {
  expect_rejected("quantize none.safetensors -o int8.safetensors", 1,
                  "none.safetensors: cannot be read: No such file or directory");
  expect_rejected("quantize model.safetensors -o half.bin", 2,
                  "half.bin: expected a name that ends in .safetensors");
  write("torn.safetensors", read("model.safetensors").substr(0, 5));
  expect_rejected("quantize torn.safetensors -o int8.safetensors", 1,
                  "torn.safetensors: has 5 bytes; expected a safetensors file, which starts with "
                  "the 8-byte length of its header");
  must("quantize model.safetensors -o int8.safetensors");
  expect_rejected("quantize int8.safetensors -o quarter.safetensors", 1,
                  "int8.safetensors: is a model with int8 weights already");
  EXPECT_FALSE(exists("quarter.safetensors"));
}

TEST_F(QuantizeVerb, never_writes_over_its_own_input) {
  const std::string whole = read("model.safetensors");
  const Ran ran = run("quantize model.safetensors -o model.safetensors");
  EXPECT_EQ(ran.exit, 1);
  EXPECT_EQ(read("model.safetensors"), whole);
}

// panache-lab export: models as ONNX. What the files compute is tests/onnx.

class ExportVerb : public LabTest {
 protected:
};

TEST_F(ExportVerb, writes_a_file_once_and_the_same_each_time) {
  const Ran ran = must("export model.safetensors -o model.onnx");
  const std::string first = read("model.onnx");
  EXPECT_TRUE(begins(ran.out, "exported model.safetensors into model.onnx ("));
  EXPECT_TRUE(ran.out.ends_with(" KB, opset 17)\n")) << ran.out;
  EXPECT_TRUE(holds(first, "angry\nold\nproud\nsad\n"));
  expect_rejected("export model.safetensors -o model.onnx", 1,
                  "model.onnx: exists already; --force overwrites it");
  must("export model.safetensors -o model.onnx --force");
  EXPECT_EQ(read("model.onnx"), first);
}

TEST_F(ExportVerb, says_what_it_cannot_export) {
  expect_rejected("export model.safetensors -o model.pb", 2,
                  "model.pb: expected a name that ends in .onnx");
  expect_rejected("export none.safetensors -o out.onnx", 1,
                  "none.safetensors: cannot be read: No such file or directory");
  write("int8.safetensors",
        format_safetensors(quantize(*parse_safetensors(read("model.safetensors"), ""))));
  expect_rejected("export int8.safetensors -o out.onnx", 1,
                  "int8.safetensors: has int8 weights, whose arithmetic ONNX does not have; "
                  "expected the model of floats that it was quantized from");
  ASSERT_EQ(run_panache("styles model.safetensors --extract old -o old.safetensors").exit, 0);
  expect_rejected("export old.safetensors -o out.onnx", 1,
                  "old.safetensors: is a style file, not a model; panache styles MODEL --add FILE "
                  "puts it into one");
  write("empty.safetensors", format_safetensors(make_model({})));
  expect_rejected("export empty.safetensors -o out.onnx", 1,
                  "empty.safetensors: has no styles; expected a model with at least one");
}

}  // namespace
}  // namespace panache::test
