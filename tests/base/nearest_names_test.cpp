#include "base/names.h"

#include <gtest/gtest.h>

namespace panache {
namespace {

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
