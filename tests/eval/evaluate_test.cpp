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

TEST(NamedSplit, there_are_three_and_no_more) {
  EXPECT_EQ(named_split("A")->contents.size(), 3u);
  EXPECT_EQ(named_split("B")->contents.size(), 5u);
  EXPECT_EQ(named_split("C")->contents.size(), 4u);
  EXPECT_EQ(named_split("C")->name, "C");
  const auto none = named_split("a");
  ASSERT_FALSE(none.ok());
  EXPECT_EQ(none.error().message, "no split 'a'; expected A, B or C");
}

}  // namespace
}  // namespace panache
