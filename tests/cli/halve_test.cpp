// panache halve: models of half size.

#include "cli/program.h"
#include "net/half_size.h"

namespace panache::test {
namespace {

class HalveVerb : public ProgramTest {
 protected:
  void expect_refused(std::vector<std::string> arguments, int exit, const std::string& sentence) {
    arguments.insert(arguments.begin(), "halve");
    const Ran ran = run(arguments);
    EXPECT_EQ(ran.err, "panache: " + sentence + "\n");
    EXPECT_EQ(ran.exit, exit);
  }
};

TEST_F(HalveVerb, writes_a_smaller_model_of_the_same_styles_and_says_both_sizes) {
  const std::string whole = read("model.safetensors");
  const Ran ran = run({"halve", "model.safetensors", "-o", "half.safetensors"});
  ASSERT_EQ(ran.exit, 0) << ran.err;
  const std::string half = read("half.safetensors");
  EXPECT_LT(half.size(), whole.size());
  const auto size = [](const std::string& bytes) {
    char text[32];
    std::snprintf(text, sizeof text, "%.1f KB", static_cast<double>(bytes.size()) / 1000);
    return std::string(text);
  };
  EXPECT_EQ(ran.out, "halved model.safetensors (" + size(whole) + ") into half.safetensors (" +
                         size(half) + ")\n");
  const auto before = Model::parse(whole, "whole"), after = Model::parse(half, "half");
  ASSERT_TRUE(after.ok()) << after.error().message;
  EXPECT_EQ((*after)->metadata(), (*before)->metadata());
  EXPECT_EQ((*after)->parameter_count(), (*before)->parameter_count());
  EXPECT_TRUE(is_half_size(*parse_safetensors(half, "half")));
}

TEST_F(HalveVerb, its_model_styles_a_walk) {
  write_walk("walk.bvh");
  ASSERT_EQ(run({"halve", "model.safetensors", "-o", "half.safetensors"}).exit, 0);
  const Ran ran =
      run({"stylize", "walk.bvh", "--style", "old=1", "-o", "old.bvh"}, "half.safetensors");
  EXPECT_EQ(ran.exit, 0) << ran.err;
  EXPECT_TRUE(exists("old.bvh"));
}

TEST_F(HalveVerb, takes_the_file_of_a_style) {
  ASSERT_EQ(run({"styles", "model.safetensors", "--extract", "old", "-o", "old.safetensors"}).exit,
            0);
  const Ran ran = run({"halve", "old.safetensors", "-o", "half.safetensors"});
  ASSERT_EQ(ran.exit, 0) << ran.err;
  EXPECT_TRUE(ran.out.starts_with("halved old.safetensors (")) << ran.out;
  EXPECT_LT(read("half.safetensors").size(), read("old.safetensors").size());
  expect_refused({"half.safetensors", "-o", "quarter.safetensors"}, 1,
                 "half.safetensors: is a style of half size already");
  EXPECT_EQ(run({"styles", "model.safetensors", "--add", "half.safetensors", "--force"}).exit, 0);
  TensorFile bad = *parse_safetensors(read("old.safetensors"), "old");
  bad.tensors["pose.head.bias"].values[0] = INFINITY;
  write("bad.safetensors", format_safetensors(bad));
  expect_refused({"bad.safetensors", "-o", "quarter.safetensors"}, 1,
                 "bad.safetensors: tensor 'pose.head.bias' holds a number that is not finite");
}

// As it comes about when a style is put into a model of half size.
TEST_F(HalveVerb, halves_the_rest_of_a_model_that_is_half_halved) {
  ASSERT_EQ(run({"styles", "model.safetensors", "--extract", "old", "-o", "old.safetensors"}).exit,
            0);
  ASSERT_EQ(run({"halve", "model.safetensors", "-o", "half.safetensors"}).exit, 0);
  const std::string half = read("half.safetensors");
  ASSERT_EQ(run({"styles", "half.safetensors", "--add", "old.safetensors", "--force"}).exit, 0);
  EXPECT_GT(read("half.safetensors").size(), half.size());
  ASSERT_EQ(run({"halve", "half.safetensors", "-o", "whole.safetensors"}).exit, 0);
  EXPECT_TRUE(read("whole.safetensors") == half);
}

TEST_F(HalveVerb, a_file_that_exists_is_kept_unless_forced) {
  write("half.safetensors", "mine");
  expect_refused({"model.safetensors", "-o", "half.safetensors"}, 1,
                 "half.safetensors: exists already; --force overwrites it");
  EXPECT_EQ(read("half.safetensors"), "mine");
  EXPECT_EQ(run({"halve", "model.safetensors", "-o", "half.safetensors", "--force"}).exit, 0);
  EXPECT_NE(read("half.safetensors"), "mine");
}

TEST_F(HalveVerb, explains_what_it_cannot_halve) {
  expect_refused({"none.safetensors", "-o", "half.safetensors"}, 1,
                 "none.safetensors: cannot be read: No such file or directory");
  expect_refused({"model.safetensors", "-o", "half.bin"}, 2,
                 "half.bin: expected a name that ends in .safetensors");
  write("torn.safetensors", read("model.safetensors").substr(0, 5));
  expect_refused({"torn.safetensors", "-o", "half.safetensors"}, 1,
                 "torn.safetensors: has 5 bytes; expected a safetensors file, which starts with "
                 "the 8-byte length of its header");
  ASSERT_EQ(run({"halve", "model.safetensors", "-o", "half.safetensors"}).exit, 0);
  expect_refused({"half.safetensors", "-o", "quarter.safetensors"}, 1,
                 "half.safetensors: is a model of half size already");
  EXPECT_FALSE(exists("quarter.safetensors"));
}

TEST_F(HalveVerb, never_writes_over_its_own_input) {
  const std::string whole = read("model.safetensors");
  const Ran ran = run({"halve", "model.safetensors", "-o", "model.safetensors"});
  EXPECT_EQ(ran.exit, 1);
  EXPECT_EQ(read("model.safetensors"), whole);
}

}  // namespace
}  // namespace panache::test
