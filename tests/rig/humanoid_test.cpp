// Names of joints and the units of files.

#include <gtest/gtest.h>

#include "make_clip.h"
#include "rig/figures.h"
#include "rig/humanoid.h"
#include "rig/joint_name.h"
#include "rig/made_up.h"
#include "rig/rig.h"

namespace panache {
namespace {

TEST(Humanoid, every_name_is_found_again) {
  for (int j = 0; j < kHumanJoints; ++j) EXPECT_EQ(find_human_joint(human_joint_name(j)), j);
  EXPECT_EQ(human_joint_name(index(HumanJoint::left_lower_arm)), "leftLowerArm");
  EXPECT_EQ(human_joint_name(index(HumanJoint::right_toes)), "rightToes");
  EXPECT_FALSE(find_human_joint("LeftHand"));
  EXPECT_FALSE(find_human_joint(""));
  EXPECT_TRUE(human_joint_name(-1).empty());
  EXPECT_TRUE(human_joint_name(kHumanJoints).empty());
}

TEST(Humanoid, the_mirror_of_a_left_name_is_the_right_one) {
  for (int j = 0; j < kHumanJoints; ++j) {
    std::string name(human_joint_name(j));
    if (name.starts_with("left"))
      name.replace(0, 4, "right");
    else if (name.starts_with("right"))
      name.replace(0, 5, "left");
    EXPECT_EQ(human_joint_name(kHumanMirror[j]), name);
  }
}

TEST(Humanoid, proportions_are_those_of_a_person_and_the_same_on_both_sides) {
  const Proportions& body = kProportions;
  for (int j = 1; j < kHumanJoints; ++j) {
    EXPECT_EQ(body.length[j], body.length[kHumanMirror[j]]);
    EXPECT_GT(body.length[j], 0.04f);
    EXPECT_LT(body.length[j], 0.45f);
  }
  EXPECT_NEAR(body.leg, body.length[14] + body.length[15], 1e-6f);
  const Vec3 l = body.mid_shoulder_to_left_shoulder, r = body.mid_shoulder_to_right_shoulder;
  EXPECT_EQ(l, (Vec3{-r.x, r.y, r.z}));
  const HumanPositions rest = test::t_pose();
  EXPECT_NEAR(rest[index(HumanJoint::head)].y, 1.40f, 0.03f);
}

TEST(Humanoid, a_body_mirrored_twice_is_itself) {
  HumanPositions body = test::t_pose();
  body[index(HumanJoint::left_hand)] = {0.3f, 1.9f, 0.2f};
  const HumanPositions other = mirrored(body);
  EXPECT_EQ(other[index(HumanJoint::right_hand)], (Vec3{-0.3f, 1.9f, 0.2f}));
  EXPECT_EQ(other[index(HumanJoint::left_hand)], test::t_pose()[index(HumanJoint::left_hand)]);
  EXPECT_EQ(mirrored(other), body);
}

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

TEST(UsualUnit, legs_of_people_and_children_tell_it) {
  for (const double legs : {0.8, 0.96, 1.0, 1.2}) {
    EXPECT_EQ(usual_unit(1 / legs)->name, "metres");
    EXPECT_EQ(usual_unit(0.0254 / legs)->metres, 0.0254);
    EXPECT_EQ(usual_unit(0.01 / legs)->name, "centimetres");
    EXPECT_NEAR(usual_unit(0.0564 / legs)->metres, 0.056444, 1e-6);
  }
  EXPECT_FALSE(usual_unit(7));
  EXPECT_FALSE(usual_unit(0.1));
}

// A body 7 % shorter than the canonical one, in centimetres.
TEST(UsualUnit, a_short_person_stays_short) {
  Clip clip = test::walking_clip(10);
  for (Joint& joint : clip.skeleton.joints) joint.offset *= 93;
  for (Vec3& translation : clip.translations) translation *= 93;
  const Result<Rig> rig = Rig::create(clip);
  ASSERT_TRUE(rig.ok());
  EXPECT_EQ(rig->unit(), 0.01f);
  EXPECT_NEAR(rig->scale(), 1 / 93.0, 1e-5);
  RigOptions given;
  given.metres_per_unit = 0.0104f;
  EXPECT_EQ(Rig::create(clip, given)->unit(), 0.0104f);
}

}  // namespace
}  // namespace panache
