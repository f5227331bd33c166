// panache-lab quantize: int8 models.

#include "lab_program.h"
#include "net/layer.h"

namespace panache::test {
namespace {

class QuantizeVerb : public LabTest {
 protected:
  void expect_rejected(std::vector<std::string> arguments, int exit, const std::string& message) {
    arguments.insert(arguments.begin(), "quantize");
    const Ran ran = run(arguments);
    EXPECT_EQ(ran.err, "panache-lab: " + message + "\n");
    EXPECT_EQ(ran.exit, exit);
  }
};

TEST_F(QuantizeVerb, writes_a_smaller_model_of_the_same_styles_and_says_both_sizes) {
  const std::string whole = read("model.safetensors");
  const Ran ran = run({"quantize", "model.safetensors", "-o", "int8.safetensors"});
  ASSERT_EQ(ran.exit, 0) << ran.err;
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
  ASSERT_EQ(run({"quantize", "model.safetensors", "-o", "int8.safetensors"}).exit, 0);
  const Ran ran =
      run_panache({"stylize", "walk.bvh", "--style", "old=1", "-o", "old.bvh"}, "int8.safetensors");
  EXPECT_EQ(ran.exit, 0) << ran.err;
  EXPECT_TRUE(exists("old.bvh"));
}

TEST_F(QuantizeVerb, takes_the_file_of_a_style) {
  ASSERT_EQ(
      run_panache({"styles", "model.safetensors", "--extract", "old", "-o", "old.safetensors"})
          .exit,
      0);
  const Ran ran = run({"quantize", "old.safetensors", "-o", "int8.safetensors"});
  ASSERT_EQ(ran.exit, 0) << ran.err;
  EXPECT_TRUE(ran.out.starts_with("quantized old.safetensors (")) << ran.out;
  EXPECT_LT(read("int8.safetensors").size(), read("old.safetensors").size());
  expect_rejected({"int8.safetensors", "-o", "quarter.safetensors"}, 1,
                  "int8.safetensors: is a style with int8 weights already");
  EXPECT_EQ(
      run_panache({"styles", "model.safetensors", "--add", "int8.safetensors", "--force"}).exit, 0);
  TensorFile bad = *parse_safetensors(read("old.safetensors"), "old");
  bad.tensors["pose.head.bias"].values[0] = INFINITY;
  write("bad.safetensors", format_safetensors(bad));
  expect_rejected({"bad.safetensors", "-o", "quarter.safetensors"}, 1,
                  "bad.safetensors: tensor 'pose.head.bias' holds a number that is not finite");
}

// As it comes about when a style is put into a int8 model.
TEST_F(QuantizeVerb, quantizes_the_rest_of_a_model_that_is_half_quantized) {
  ASSERT_EQ(
      run_panache({"styles", "model.safetensors", "--extract", "old", "-o", "old.safetensors"})
          .exit,
      0);
  ASSERT_EQ(run({"quantize", "model.safetensors", "-o", "int8.safetensors"}).exit, 0);
  const std::string int8 = read("int8.safetensors");
  ASSERT_EQ(run_panache({"styles", "int8.safetensors", "--add", "old.safetensors", "--force"}).exit,
            0);
  EXPECT_GT(read("int8.safetensors").size(), int8.size());
  ASSERT_EQ(run({"quantize", "int8.safetensors", "-o", "whole.safetensors"}).exit, 0);
  EXPECT_TRUE(read("whole.safetensors") == int8);
}

TEST_F(QuantizeVerb, a_file_that_exists_is_kept_unless_forced) {
  write("int8.safetensors", "mine");
  expect_rejected({"model.safetensors", "-o", "int8.safetensors"}, 1,
                  "int8.safetensors: exists already; --force overwrites it");
  EXPECT_EQ(read("int8.safetensors"), "mine");
  EXPECT_EQ(run({"quantize", "model.safetensors", "-o", "int8.safetensors", "--force"}).exit, 0);
  EXPECT_EQ(run({"quantize", "model.safetensors", "-o", "new.safetensors"}).exit, 0);
  EXPECT_TRUE(read("int8.safetensors") == read("new.safetensors"));
}

TEST_F(QuantizeVerb, explains_what_it_cannot_quantize) {
  expect_rejected({"none.safetensors", "-o", "int8.safetensors"}, 1,
                  "none.safetensors: cannot be read: No such file or directory");
  expect_rejected({"model.safetensors", "-o", "half.bin"}, 2,
                  "half.bin: expected a name that ends in .safetensors");
  write("torn.safetensors", read("model.safetensors").substr(0, 5));
  expect_rejected({"torn.safetensors", "-o", "int8.safetensors"}, 1,
                  "torn.safetensors: has 5 bytes; expected a safetensors file, which starts with "
                  "the 8-byte length of its header");
  ASSERT_EQ(run({"quantize", "model.safetensors", "-o", "int8.safetensors"}).exit, 0);
  expect_rejected({"int8.safetensors", "-o", "quarter.safetensors"}, 1,
                  "int8.safetensors: is a model with int8 weights already");
  EXPECT_FALSE(exists("quarter.safetensors"));
}

TEST_F(QuantizeVerb, never_writes_over_its_own_input) {
  const std::string whole = read("model.safetensors");
  const Ran ran = run({"quantize", "model.safetensors", "-o", "model.safetensors"});
  EXPECT_EQ(ran.exit, 1);
  EXPECT_EQ(read("model.safetensors"), whole);
}

}  // namespace
}  // namespace panache::test
