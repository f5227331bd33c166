// panache-lab export: models as ONNX. What the files compute is tests/onnx.

#include "lab_program.h"
#include "net/layer.h"

namespace panache::test {
namespace {

class ExportVerb : public LabTest {
 protected:
  void expect_rejected(std::vector<std::string> arguments, int exit, const std::string& message) {
    arguments.insert(arguments.begin(), "export");
    const Ran ran = run(arguments);
    EXPECT_EQ(ran.err, "panache-lab: " + message + "\n");
    EXPECT_EQ(ran.exit, exit);
    EXPECT_FALSE(exists("out.onnx"));
  }
};

TEST_F(ExportVerb, writes_a_file_once_and_the_same_each_time) {
  const Ran ran = run({"export", "model.safetensors", "-o", "model.onnx"});
  ASSERT_EQ(ran.exit, 0) << ran.err;
  const std::string first = read("model.onnx");
  EXPECT_TRUE(ran.out.starts_with("exported model.safetensors into model.onnx (")) << ran.out;
  EXPECT_TRUE(ran.out.ends_with(" KB, opset 17)\n")) << ran.out;
  EXPECT_NE(first.find("angry\nold\nproud\nsad\n"), std::string::npos);
  expect_rejected({"model.safetensors", "-o", "model.onnx"}, 1,
                  "model.onnx: exists already; --force overwrites it");
  EXPECT_EQ(run({"export", "model.safetensors", "-o", "model.onnx", "--force"}).exit, 0);
  EXPECT_EQ(read("model.onnx"), first);
}

TEST_F(ExportVerb, says_what_it_cannot_export) {
  expect_rejected({"model.safetensors", "-o", "model.pb"}, 2,
                  "model.pb: expected a name that ends in .onnx");
  expect_rejected({"none.safetensors", "-o", "out.onnx"}, 1,
                  "none.safetensors: cannot be read: No such file or directory");
  write("int8.safetensors",
        format_safetensors(quantize(*parse_safetensors(read("model.safetensors"), ""))));
  expect_rejected({"int8.safetensors", "-o", "out.onnx"}, 1,
                  "int8.safetensors: has int8 weights, whose arithmetic ONNX does not have; "
                  "expected the model of floats that it was quantized from");
  ASSERT_EQ(
      run_panache({"styles", "model.safetensors", "--extract", "old", "-o", "old.safetensors"})
          .exit,
      0);
  expect_rejected({"old.safetensors", "-o", "out.onnx"}, 1,
                  "old.safetensors: is a style file, not a model; panache styles MODEL --add FILE "
                  "puts it into one");
  write("empty.safetensors", format_safetensors(make_model({})));
  expect_rejected({"empty.safetensors", "-o", "out.onnx"}, 1,
                  "empty.safetensors: has no styles; expected a model with at least one");
}

}  // namespace
}  // namespace panache::test
