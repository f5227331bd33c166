// What is done to text: bytes that are no characters, names that were meant.

#include <gtest/gtest.h>

#include "base/text.h"

namespace panache {
namespace {

TEST(Utf8, well_formed_text_stays_as_it_is) {
  for (const std::string text :
       {"", "hips",
        "H\xc3\xbc"
        "fte",
        "\xe8\x85\xb0", "\xf0\x9f\x95\xba", "\xef\xbf\xbf", "\xed\x9f\xbf", "\xf4\x8f\xbf\xbf"}) {
    EXPECT_EQ(to_utf8(text), text);
  }
}

TEST(Utf8, each_byte_of_no_character_is_replaced) {
  const auto replaced = [](int count) {
    std::string out;
    for (int i = 0; i < count; ++i) out += kReplacementCharacter;
    return out;
  };
  EXPECT_EQ(to_utf8("H\xfc"
                    "fte"),
            "H" + replaced(1) + "fte");  // Latin-1
  EXPECT_EQ(to_utf8("\xc3"), replaced(1));
  EXPECT_EQ(to_utf8("\xe8\x85"), replaced(2));
  EXPECT_EQ(to_utf8("\x80\xbf"), replaced(2));
  EXPECT_EQ(to_utf8("\xc0\xaf"), replaced(2));          // Over-long,
  EXPECT_EQ(to_utf8("\xe0\x80\xaf"), replaced(3));      // likewise.
  EXPECT_EQ(to_utf8("\xf0\x80\x80\xaf"), replaced(4));  // Likewise.
  EXPECT_EQ(to_utf8("\xed\xa0\x80"), replaced(3));      // A surrogate.
  EXPECT_EQ(to_utf8("\xf4\x90\x80\x80"), replaced(4));  // Beyond U+10FFFF.
  EXPECT_EQ(to_utf8("\xff\xc3\xbc"), replaced(1) + "\xc3\xbc");
}

using Names = std::vector<std::string>;
const Names kStyles = {"active", "angry", "elderly", "old", "proud", "sad", "tired", "timid"};

TEST(NearestNames, slips_of_the_hand_are_found) {
  for (const auto& [typed, meant] : {std::pair{"olld", "old"},
                                     {"odl", "old"},
                                     {"lod", "old"},
                                     {"sda", "sad"},
                                     {"prod", "proud"},
                                     {"PROUD", "proud"},
                                     {"tird", "tired"},
                                     {"ang", "angry"},
                                     {"angrily", "angry"},
                                     {"elderley", "elderly"}}) {
    const Names found = nearest_names(typed, kStyles);
    ASSERT_FALSE(found.empty()) << typed;
    EXPECT_EQ(found[0], meant);
  }
}

TEST(NearestNames, other_words_are_not_taken_for_one) {
  for (const char* typed : {"drunk", "zombie", "x", "", "walk", "happy"}) {
    EXPECT_EQ(nearest_names(typed, kStyles), Names{}) << typed;
  }
}

TEST(NearestNames, the_likeliest_come_first_and_no_more_than_asked_for) {
  const Names names = {"walks", "walker", "walk"};
  EXPECT_EQ(nearest_names("walk", names), (Names{"walk", "walks", "walker"}));
  EXPECT_EQ(nearest_names("walk", names, 1), Names{"walk"});
  EXPECT_EQ(is_or_are({"a"}), "is a");
  EXPECT_EQ(is_or_are({"a", "b", "c"}), "are a, b and c");
}

TEST(NearestNames, a_name_of_any_length_is_compared_in_no_time) {
  EXPECT_EQ(nearest_names(std::string(10'000'000, 'x'), kStyles), Names{});
}

}  // namespace
}  // namespace panache
