#include "base/csv.h"

#include <gtest/gtest.h>

#include "base/file.h"
#include "temporary_folder.h"

namespace panache {
namespace {

using Cells = std::vector<std::string>;

class Csv : public testing::Test {
 protected:
  Result<CsvTable> read(const std::string& text, const Cells& columns = {}) {
    EXPECT_TRUE(write_file(path_, text, true).ok());
    return read_csv(path_, columns);
  }
  std::string rejection(const std::string& text, const Cells& columns = {}) {
    const auto table = read(text, columns);
    return table ? "(accepted)" : table.error().message;
  }

  test::TemporaryFolder folder_;
  const std::string path_ = folder_.path() + "styles.csv";
};

TEST_F(Csv, columns_come_in_the_order_that_is_asked_for) {
  const auto table = read("style,words,path\nold,bent,a.bvh\nproud,,b.bvh\n", {"path", "style"});
  ASSERT_TRUE(table.ok()) << table.error().message;
  EXPECT_EQ(table->columns, (Cells{"path", "style"}));
  ASSERT_EQ(table->rows.size(), 2u);
  EXPECT_EQ(table->rows[0].values, (Cells{"a.bvh", "old"}));
  EXPECT_EQ(table->rows[1].values, (Cells{"b.bvh", "proud"}));
  EXPECT_EQ(read("style,words\nold,bent\n")->columns, (Cells{"style", "words"}));
}

TEST_F(Csv, other_separators_are_named) {
  EXPECT_TRUE(rejection("seconds;old\n0;0,5\n")
                  .find(":1: cells are separated by semicolons; expected commas") !=
              std::string::npos);
  EXPECT_TRUE(rejection("seconds\told\n").find("separated by tabs") != std::string::npos);
  EXPECT_EQ(read("path\na;b.bvh\n")->rows[0].values, Cells{"a;b.bvh"});
}

TEST_F(Csv, quoted_cells_hold_commas_line_ends_and_quotes) {
  const auto table = read("style,words\nold,\"bent, slow\"\nproud,\"says \"\"me\"\"\nloudly\"\n");
  ASSERT_TRUE(table.ok()) << table.error().message;
  ASSERT_EQ(table->rows.size(), 2u);
  EXPECT_EQ(table->rows[0].values[1], "bent, slow");
  EXPECT_EQ(table->rows[1].values[1], "says \"me\"\nloudly");
}

TEST_F(Csv, files_of_spreadsheets_are_read) {
  // A byte order mark, Windows' line ends, an empty line, none at the end.
  const auto table = read("\xef\xbb\xbfstyle,words\r\nold,bent\r\n\r\nproud,tall");
  ASSERT_TRUE(table.ok()) << table.error().message;
  EXPECT_EQ(table->columns, (Cells{"style", "words"}));
  ASSERT_EQ(table->rows.size(), 2u);
  EXPECT_EQ(table->rows[0].values, (Cells{"old", "bent"}));
  EXPECT_EQ(table->rows[0].line, 2);
  EXPECT_EQ(table->rows[1].values, (Cells{"proud", "tall"}));
  EXPECT_EQ(table->rows[1].line, 4);
}

TEST_F(Csv, a_row_below_a_cell_of_several_lines_has_the_line_of_the_file) {
  const auto table = read("style,words\nold,\"bent\nand slow\"\nproud,tall\n");
  ASSERT_TRUE(table.ok()) << table.error().message;
  ASSERT_EQ(table->rows.size(), 2u);
  EXPECT_EQ(table->rows[0].line, 2);
  EXPECT_EQ(table->rows[1].line, 4);
  EXPECT_EQ(rejection("style,words\nold,\"bent\nand slow\"\nproud\n"),
            path_ + ":4: has 1 cells; expected 2 as in the first line");
}

TEST_F(Csv, what_is_missing_is_said_with_its_place) {
  EXPECT_EQ(rejection("style,words\nold,bent\n", {"style", "path"}),
            path_ + ":1: column 'path' is missing; the first line must name the columns");
  EXPECT_EQ(rejection("style,words\nold,bent\nproud\n"),
            path_ + ":3: has 1 cells; expected 2 as in the first line");
  EXPECT_EQ(rejection("style,words\nold,bent,\n"),
            path_ + ":2: has 3 cells; expected 2 as in the first line");
}

}  // namespace
}  // namespace panache
