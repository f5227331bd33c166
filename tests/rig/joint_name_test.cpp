#include "rig/joint_name.h"

#include <gtest/gtest.h>

namespace panache {
namespace {

using Words = std::vector<std::string>;

void expect_name(std::string_view name, Side side, const Words& words) {
  const JointName parsed = parse_joint_name(name);
  EXPECT_EQ(parsed.side, side) << name;
  EXPECT_EQ(parsed.words, words) << name;
}

TEST(JointName, the_left_hand_of_every_maker_is_a_left_hand) {
  for (const char* name : {"LeftHand",        "leftHand",
                           "Left_hand",       "hand_left",
                           "lHand",           "l_hand",
                           "L_Hand",          "LHand",
                           "Hand_L",          "hand.L",
                           "hand-l",          "HandL",
                           "handL",           "lhand",
                           "LHAND",           "LEFTHAND",
                           "lefthand",        "handleft",
                           "handl",           "mixamorig:LeftHand",
                           "ns:other:Hand_L", "|Group|LeftHand",
                           "Left Hand",       "  LeftHand  ",
                           "HAND_LEFT",       "Lhand"}) {
    expect_name(name, Side::left, {"hand"});
  }
}

TEST(JointName, japanese_sides_are_letters_of_their_own) {
  for (const std::string part : {"手首", "ひじ", "足首", "つま先"}) {
    const JointName left = parse_joint_name("左" + part), right = parse_joint_name("右" + part);
    EXPECT_EQ(left.side, Side::left) << part;
    EXPECT_EQ(right.side, Side::right) << part;
    EXPECT_EQ(left.words, right.words) << part;
    EXPECT_EQ(left.words, parse_joint_name(part).words) << part;
  }
}

TEST(JointName, prefixes_are_words_of_their_own) {
  expect_name("Bip01 L Hand", Side::left, {"bip", "01", "hand"});
  expect_name("DEF-hand.R", Side::right, {"def", "hand"});
  expect_name("Character1_RightHand", Side::right, {"character", "1", "hand"});
  expect_name("joint_Root", Side::none, {"joint", "root"});
  expect_name("J_Bip_R_Foot", Side::right, {"j", "bip", "foot"});
  expect_name("ValveBiped.Bip01_R_Toe0", Side::right, {"valve", "biped", "bip", "01", "toe", "0"});
}

TEST(JointName, a_letter_that_is_no_side_stays) {
  expect_name("LHipJoint", Side::left, {"hip", "joint"});
  expect_name("leg", Side::none, {"leg"});
  expect_name("LowerBack", Side::none, {"lower", "back"});
  expect_name("root", Side::none, {"root"});
  expect_name("rollbone", Side::none, {"rollbone"});
  expect_name("RThumb", Side::right, {"thumb"});
  expect_name("rShldr", Side::right, {"shldr"});
  expect_name("left_right", Side::none, {});
  expect_name("", Side::none, {});
  expect_name(":::", Side::none, {});
  expect_name("\xc3\xa9paule_L", Side::left, {"\xc3\xa9paule"});
}

TEST(JointName, a_number_at_the_end_can_be_left_out) {
  EXPECT_EQ(without_number({"forearm", "001"}), Words{"forearm"});
  EXPECT_EQ(without_number({"forearm"}), Words{"forearm"});
  EXPECT_EQ(without_number({"1"}), Words{"1"});
}

}  // namespace
}  // namespace panache
