// The options --person, --seed, --variety and --energy of stylize.

#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "make_persons.h"

namespace panache::test {
namespace {

class PersonOption : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    TensorFile model = *parse_safetensors(read("model.safetensors"), "model");
    add_persons(model);
    write("model.safetensors", format_safetensors(model));
    write_walk("walk.bvh");
  }
  std::string styled(std::vector<std::string> more) {
    std::vector<std::string> arguments = {"stylize", "walk.bvh", "--force", "-o", "out.bvh"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Ran ran = run(arguments);
    EXPECT_EQ(ran.exit, 0) << ran.err;
    return read("out.bvh");
  }
  std::string rejected(std::vector<std::string> more) {
    std::vector<std::string> arguments = {"stylize", "walk.bvh", "--force", "-o", "out.bvh"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Ran ran = run(arguments);
    EXPECT_NE(ran.exit, 0);
    return ran.err;
  }
};

TEST_F(PersonOption, is_a_number_or_a_word_each_another_person) {
  const std::string seven = styled({"--person", "7"});
  EXPECT_TRUE(seven != read("walk.bvh"));
  EXPECT_TRUE(styled({"--person", "7"}) == seven);
  EXPECT_TRUE(styled({"--person", "8"}) != seven);
  EXPECT_TRUE(styled({"--person", "mara"}) != styled({"--person", "marb"}));
  EXPECT_TRUE(styled({"--person", "7", "--style", "old=1"}) != styled({"--style", "old=1"}));
}

TEST_F(PersonOption, of_variety_0_is_the_input_bit_for_bit) {
  EXPECT_TRUE(styled({"--person", "7", "--variety", "0"}) == read("walk.bvh"));
  EXPECT_TRUE(styled({"--person", "7", "--variety", "2"}) != styled({"--person", "7"}));
  EXPECT_TRUE(styled({"--person", "7", "--variety", "1"}) == styled({"--person", "7"}));
}

TEST_F(PersonOption, random_is_another_one_for_each_file_and_the_same_for_equal_seeds) {
  write_walk("a.bvh");
  write_walk("b.bvh");
  const auto people = [&](const std::string& seed) {
    const Ran ran = run({"stylize", "a.bvh", "b.bvh", "--person", "random", "--seed", seed, "-o",
                         "out", "--force", "--json"});
    EXPECT_EQ(ran.exit, 0) << ran.err;
    std::vector<uint32_t> seeds;
    for (const auto& file : nlohmann::json::parse(ran.out)) {
      seeds.push_back(file["clips"][0]["person"]["seed"]);
    }
    return seeds;
  };
  const auto some = people("1");
  ASSERT_EQ(some.size(), 2u);
  EXPECT_NE(some[0], some[1]);
  EXPECT_TRUE(read("out/a.bvh") != read("out/b.bvh"));
  EXPECT_EQ(people("1"), some);
  EXPECT_NE(people("2"), some);
  // The seed that is reported gives the same person.
  EXPECT_TRUE(people("1") == some &&
              read("out/a.bvh") == styled({"--person", std::to_string(some[0])}));
}

TEST_F(PersonOption, that_makes_no_sense_is_rejected_with_the_cure) {
  EXPECT_NE(rejected({"--style", "old=1", "--seed", "3"}).find("add --person random"),
            std::string::npos);
  EXPECT_NE(rejected({"--style", "old=1", "--variety", "1"}).find("add --person"),
            std::string::npos);
  EXPECT_NE(rejected({"--person", "7", "--seed", "3"}).find("expected --person random"),
            std::string::npos);
  EXPECT_NE(rejected({"--person", "7", "--variety", "3"}).find("--variety"), std::string::npos);
  write("model.safetensors", format_safetensors(make_model({"old"})));
  EXPECT_NE(rejected({"--person", "7"}).find("the model has no persons"), std::string::npos);
}

TEST_F(PersonOption, names_the_result) {
  ASSERT_EQ(run({"stylize", "walk.bvh", "--person", "7"}).exit, 0);
  EXPECT_TRUE(exists("walk-person-7.bvh"));
  ASSERT_EQ(run({"stylize", "walk.bvh", "--energy", "0.5"}).exit, 0);
  EXPECT_TRUE(exists("walk-calm.bvh"));
}

TEST_F(PersonOption, energy_of_1_is_the_input_bit_for_bit_and_others_are_not) {
  EXPECT_TRUE(styled({"--energy", "0.4"}) != read("walk.bvh"));
  EXPECT_TRUE(styled({"--energy", "0.4"}) != styled({"--energy", "1.6"}));
  EXPECT_TRUE(styled({"--style", "old=1", "--energy", "1"}) == styled({"--style", "old=1"}));
}

}  // namespace
}  // namespace panache::test
