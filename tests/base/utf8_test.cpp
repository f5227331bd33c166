#include "base/text.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace panache
