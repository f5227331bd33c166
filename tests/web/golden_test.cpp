#include "golden.h"

#include <gtest/gtest.h>

#include "net/kernel_checks.h"

namespace panache::web {
namespace {

// These change with the models and with what a step computes, and with nothing else: not with the
// instruction set, the compiler, its flags, or the browser (the page compares its own with these).
constexpr uint64_t kPanache = 6996213203778543655u;
constexpr uint64_t kPanacheInt8 = 10608138548184893902u;

TEST(Golden, three_hundred_frames_have_the_same_bits_on_every_instruction_set) {
  for (const auto& [name, expected] :
       {std::pair{"panache", kPanache}, std::pair{"panache-int8", kPanacheInt8}}) {
    const auto model =
        Model::load(std::string(PANACHE_SOURCE_DIR "/models/") + name + ".safetensors");
    ASSERT_TRUE(model.ok()) << model.error().message;
    test::on_every_target([&] {
      EXPECT_EQ(golden_hash(*model), expected)
          << name
          << ": a step computes other numbers than before. If it should, set the constant in "
          << "this file to the first of the two hashes, and say why in the commit.";
    });
  }
}

}  // namespace
}  // namespace panache::web
