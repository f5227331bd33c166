#include "eval/evaluate.h"

#include <gtest/gtest.h>

#include "make_styles.h"
#include "temporary_folder.h"

namespace panache {
namespace {

// What an evaluation rejects before any classifier is trained; what it reports is tested through
// the program, which evaluates as a user would.
class EvaluateTest : public testing::Test {
 protected:
  EvaluateTest() {
    test::write_styles(temporary_.path(), {"neutral", "old"}, 1);
    const std::vector<ManifestRow> rows = *read_manifest(temporary_.path() + "takes.csv", 0);
    options_.training = rows;
    options_.styles = {{"old", {"old"}, ""}};
    for (const ManifestRow& row : rows) {
      if (row.test) options_.test.push_back(row);
    }
  }
  // Changes the test takes, in the manifest of the training takes as well.
  template <typename Change>
  void change_tests(const Change& change) {
    for (ManifestRow& row : options_.test) change(row);
    for (ManifestRow& row : options_.training) {
      if (row.test) change(row);
    }
  }
  std::string rejection() const {
    const Result<Report> report = evaluate(options_);
    return report.ok() ? "accepted" : report.error().message;
  }

  const test::TemporaryFolder temporary_;
  EvaluateOptions options_;
};

TEST_F(EvaluateTest, test_takes_of_contents_that_nothing_was_trained_on_do_not_judge) {
  change_tests([](ManifestRow& row) {
    if (row.neutral) row.content = "jump";
  });
  EXPECT_EQ(rejection(),
            "no neutral test take of a content that is trained on; expected rows with neutral 1");
}

TEST_F(EvaluateTest, test_takes_of_styles_that_nothing_was_trained_on_do_not_judge) {
  change_tests([](ManifestRow& row) {
    if (!row.neutral) row.style = "sad";
  });
  EXPECT_EQ(rejection(),
            "no styled test take of a style and content that are trained on; expected rows with "
            "neutral 0");
}

TEST_F(EvaluateTest, a_test_take_that_cannot_be_read_is_named) {
  options_.test.back().path = temporary_.path() + "none.bvh";
  EXPECT_EQ(rejection(), temporary_.path() + "none.bvh: cannot be read: No such file or directory");
}

// Known before a classifier is trained.
TEST_F(EvaluateTest, an_unseen_content_without_a_styled_test_take_is_named) {
  options_.unseen = {*read_split("wave,kick")};
  EXPECT_EQ(rejection(),
            "unseen content 'kick' has no styled test take; expected contents of the styled test "
            "takes: walk, wave");
}

TEST(ReadSplit, three_have_names) {
  EXPECT_EQ(read_split("A")->contents.size(), 3u);
  EXPECT_EQ(read_split("B")->contents.size(), 5u);
  EXPECT_EQ(read_split("C")->contents.size(), 4u);
  EXPECT_EQ(read_split("C")->name, "C");
}

TEST(ReadSplit, others_are_lists_of_contents) {
  EXPECT_EQ(read_split("wait")->contents, (std::vector<std::string>{"wait"}));
  EXPECT_EQ(read_split("pick-up,wait")->contents, (std::vector<std::string>{"pick-up", "wait"}));
  EXPECT_EQ(read_split("pick-up,wait")->name, "pick-up+wait");
  for (const char* wrong : {"", ",", "wait,", ",wait", "walk,,wait", "wait,wait"}) {
    EXPECT_FALSE(read_split(wrong).ok()) << wrong;
  }
}

}  // namespace
}  // namespace panache
