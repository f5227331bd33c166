#include "takes/manifest.h"

#include <gtest/gtest.h>

#include "base/file.h"
#include "temporary_folder.h"

namespace panache {
namespace {

class ManifestTest : public testing::Test {
 protected:
  std::string put(const std::string& text) {
    EXPECT_TRUE(write_file(path_, text, true).ok());
    return path_;
  }

  const test::TemporaryFolder temporary_;
  const std::string path_ = temporary_.path() + "manifest.csv";
};

constexpr const char* kHeader = "path,style,content,take,neutral,split\n";

TEST_F(ManifestTest, rows_are_read_in_any_order_of_columns) {
  const auto rows =
      read_manifest(put("split,neutral,path,style,content,take\r\ntest,0,a/b.bvh,old,walk,001\r\n"
                        "train,1,/c.bvh,normal,walk,002\r\n"),
                    3);
  ASSERT_TRUE(rows.ok()) << rows.error().message;
  EXPECT_EQ((*rows)[0].path, temporary_.path() + "a/b.bvh");
  EXPECT_TRUE((*rows)[0].test);
  EXPECT_EQ((*rows)[0].style, "old");
  EXPECT_EQ((*rows)[0].content, "walk");
  EXPECT_EQ((*rows)[0].take, "001");
  EXPECT_EQ((*rows)[1].path, "/c.bvh");
  EXPECT_EQ((*rows)[1].style, "neutral");
  EXPECT_EQ((*rows)[1].set, 3);
}

TEST_F(ManifestTest, each_performer_is_a_set_of_its_own) {
  const auto rows = read_manifest(put("path,style,content,take,neutral,split,person\n"
                                      "a.bvh,old,walk,001,0,train,mia\n"
                                      "b.bvh,old,walk,001,0,train,jo\n"
                                      "c.bvh,normal,walk,001,1,train,mia\n"),
                                  4);
  ASSERT_TRUE(rows.ok()) << rows.error().message;
  EXPECT_EQ((*rows)[0].person, "mia");
  EXPECT_EQ((*rows)[0].set, 4);
  EXPECT_EQ((*rows)[1].set, 5);
  EXPECT_EQ((*rows)[2].set, 4);
  EXPECT_EQ(next_set(*rows), 6);
  EXPECT_EQ(next_set({}), 0);
}

TEST_F(ManifestTest, a_style_of_one_performer_can_have_a_name_of_its_own) {
  auto names = read_style_names(
      put("name,from,description\nsexy,sexy,\nsexy2,jo/sexy,\nold,mia/elderly jo/aged,\n"));
  ASSERT_TRUE(names.ok()) << names.error().message;
  auto rows = *read_manifest(put("path,style,content,take,neutral,split,person\n"
                                 "a.bvh,sexy,walk,001,0,train,mia\n"
                                 "b.bvh,sexy,walk,001,0,train,jo\n"
                                 "c.bvh,elderly,walk,001,0,train,mia\n"
                                 "d.bvh,elderly,walk,001,0,train,jo\n"
                                 "e.bvh,aged,walk,001,0,train,jo\n"),
                             0);
  EXPECT_EQ(
      list_unnamed_styles(*names, rows),
      std::vector{path_ + ": performer 'jo': style 'elderly' is left out: it is not among the "
                          "styles to learn (1 take)"});
  ASSERT_TRUE(apply_style_names(*names, rows).ok());
  ASSERT_EQ(rows.size(), 4);  // Without jo's 'elderly', which is not listed.
  EXPECT_EQ(rows[0].style, "sexy");
  EXPECT_EQ(rows[1].style, "sexy2");
  EXPECT_EQ(rows[2].style, "old");
  EXPECT_EQ(rows[3].style, "old");
}

TEST_F(ManifestTest, a_wrong_table_is_explained_with_its_line) {
  for (const auto& [table, message] :
       {std::pair<std::string, std::string>{
            "path,style\n",
            ":1: column 'content' is missing; the first line must name the columns"},
        {std::string(kHeader) + "a.bvh,old,walk,001,no,train\n",
         ":2: column neutral is 'no'; expected 0 or 1"},
        {std::string(kHeader) + "a.bvh,old,walk,001,0,dev\n",
         ":2: column split is 'dev'; expected train or test"},
        {kHeader, ": lists no takes"}}) {
    EXPECT_EQ(read_manifest(put(table), 0).error().message, path_ + message);
  }
}

TEST_F(ManifestTest, styles_are_listed_in_groups_where_the_table_names_them) {
  const auto grouped =
      read_style_names(put("group,name,from,description\nmoods,sad,sad,\n\"ways, of "
                           "\"\"walking\"\"\",limp,limp,\n,mine,mine,\n"));
  ASSERT_TRUE(grouped.ok()) << grouped.error().message;
  EXPECT_EQ((*grouped)[0].group, "moods");
  EXPECT_EQ((*grouped)[1].group, "ways, of \"walking\"");
  EXPECT_EQ((*grouped)[2].group, "");
  const auto plain = read_style_names(put("name,from,description\nold,old,bent\n"));
  ASSERT_TRUE(plain.ok()) << plain.error().message;
  EXPECT_EQ((*plain)[0].group, "");
}

TEST_F(ManifestTest, a_table_may_list_other_words_for_a_style) {
  const auto styles =
      read_style_names(put("name,from,description,words\nold,old,bent,elderly aged\nsad,sad,,\n"));
  ASSERT_TRUE(styles.ok()) << styles.error().message;
  EXPECT_EQ((*styles)[0].words, "elderly aged");
  EXPECT_EQ((*styles)[1].words, "");
  EXPECT_EQ(
      read_style_names(put("name,from,description,words\nold,old,,\"a\nb\"\n")).error().message,
      path_ +
          ":2: column words is not one line of UTF-8 text; expected no line breaks and no tabs in "
          "it");
}

// A model keeps a line for each style, so a second one would be that of the next style.
TEST_F(ManifestTest, descriptions_and_groups_of_several_lines_are_rejected) {
  const std::string header = "name,from,description,group\n";
  EXPECT_EQ(read_style_names(put(header + "old,old,\"bent,\nslow\",ages\n")).error().message,
            path_ +
                ":2: column description is not one line of UTF-8 text; expected no line breaks "
                "and no tabs in it");
  for (const std::string group : {"\"ages\nold\"", "ages\told", "\xe4ges"}) {
    EXPECT_EQ(
        read_style_names(put(header + "sad,sad,,moods\nold,old,," + group + "\n")).error().message,
        path_ +
            ":3: column group is not one line of UTF-8 text; expected no line breaks and no "
            "tabs in it")
        << group;
  }
}

TEST_F(ManifestTest, styles_are_renamed_merged_and_left_out) {
  auto names = read_style_names(
      put("name,from,description\nold,elderly aged,\"bent, slow\"\nproud,proud,tall\n"));
  ASSERT_TRUE(names.ok());
  EXPECT_EQ((*names)[0].description, "bent, slow");
  std::vector<ManifestRow> rows(5);
  rows[0].style = "elderly";
  rows[1].style = "aged";
  rows[2].style = "sad";
  rows[3].style = "proud";
  rows[4].style = "neutral";
  rows[4].neutral = true;
  std::vector<ManifestRow> original = rows;
  ASSERT_TRUE(apply_style_names(*names, rows).ok());
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[0].style, "old");
  EXPECT_EQ(rows[1].style, "old");
  names->push_back({"angry", {"angry"}, ""});
  EXPECT_EQ(apply_style_names(*names, original).error().message,
            "style 'angry' has no take in any manifest");
}

TEST_F(ManifestTest, names_that_nobody_can_ask_for_are_rejected_with_their_line) {
  const auto applied = [&](const std::string& style) {
    auto rows = read_manifest(
        put(std::string(kHeader) + "n.bvh,normal,walk,1,1,train\na.bvh,old,walk,1,0,train\n" +
            "b.bvh,\"" + style + "\",walk,1,0,train\n"),
        0);
    std::vector<StyleName> names;
    const Result<void> good = apply_style_names(names, *rows);
    return good.ok() ? "" : good.error().message;
  };
  EXPECT_EQ(applied("very old"), "");
  EXPECT_EQ(applied("a=b"), path_ +
                                ":4: style name 'a=b': holds a '=', which separates names from "
                                "strengths; give it another name");
  EXPECT_EQ(applied("Neutral"), path_ +
                                    ":4: style name 'Neutral': is the name of motion without a "
                                    "style; give it another name");
  for (const std::string bad : {"old, bent", "neutral", "-old", "seconds", "", " old"}) {
    EXPECT_TRUE(applied(bad).starts_with(path_ + ":4: style name '")) << bad;
  }
}

TEST_F(ManifestTest, a_list_of_styles_names_each_once) {
  const auto rejection = [&](const std::string& rows) {
    const auto names = read_style_names(put("name,from,description\n" + rows));
    return names.ok() ? "" : names.error().message;
  };
  EXPECT_EQ(rejection("old,aged,\nproud,tall,\n"), "");
  EXPECT_EQ(rejection("old,aged,\na=b,tall,\n"),
            path_ + ":3: style name 'a=b': holds a '=', which separates names from strengths");
  EXPECT_EQ(rejection("old,aged,\nold,elderly,\n"),
            path_ +
                ":3: style 'old' is listed already; expected one line with all its names in "
                "column from");
  EXPECT_EQ(rejection("old,aged,\nproud,tall aged,\n"),
            path_ + ":3: 'aged' is in column from already; expected it for one style");
}

TEST_F(ManifestTest, what_is_missing_or_not_used_is_listed_with_its_place) {
  EXPECT_TRUE(write_file(temporary_.path() + "there.bvh", "x", true).ok());
  const auto rows = read_manifest(
      put(std::string(kHeader) + "there.bvh,old,walk,1,0,train\nx/a.bvh,sad,walk,1,0,train\n" +
          "b.bvh,sad,run,1,0,test\nb.bvh,normal,run,1,1,train\n"),
      0);
  const std::string folder = temporary_.path();
  EXPECT_EQ(list_missing_files(*rows),
            (std::vector<std::string>{path_ + ":3: " + folder + "x/a.bvh: there is no such file",
                                      path_ + ":4: " + folder + "b.bvh: there is no such file",
                                      path_ + ":5: " + folder + "b.bvh: there is no such file"}));
  EXPECT_TRUE(list_unnamed_styles({}, *rows).empty());
  EXPECT_EQ(list_unnamed_styles({{"aged", {"old"}, ""}}, *rows),
            (std::vector<std::string>{
                path_ + ": style 'sad' is left out: it is not among the styles to learn (2 "
                        "takes)"}));
}

TEST(RenameStyles, takes_of_other_styles_are_dropped_without_complaint) {
  std::vector<ManifestRow> rows(4);
  rows[0].style = "elderly";
  rows[1].style = "sad";
  rows[2].style = rows[2].content = "neutral";
  rows[2].neutral = true;
  rows[3].style = "old";  // Called so already, which is not what the list renames.
  const std::vector<ManifestRow> kept =
      rename_styles({{"old", {"elderly"}, ""}, {"proud", {"proud"}, ""}}, rows);
  ASSERT_EQ(kept.size(), 2u);
  EXPECT_EQ(kept[0].style, "old");
  EXPECT_TRUE(kept[1].neutral);
}

}  // namespace
}  // namespace panache
