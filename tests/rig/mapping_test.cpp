#include "rig/mapping.h"

#include <gtest/gtest.h>

#include "rig/made_up.h"

namespace panache {
namespace {

using namespace test;
using enum HumanJoint;

Result<Mapping> map_made_up(const MadeUp& rig) {
  return map_humanoid(rig.skeleton, std::vector<JointPositions>{rig.positions});
}

// Joints are found as the lines call them.
void expect_mapping(const std::vector<Line>& lines, const std::string& left,
                    const std::string& right) {
  const MadeUp rig = make_up(lines, left, right);
  const Result<Mapping> got = map_made_up(rig);
  ASSERT_TRUE(got.ok()) << got.error().message;
  const HumanNames want = names_of(lines, left, right);
  for (int j = 0; j < kHumanJoints; ++j) {
    const int found = got->joint_of[j];
    EXPECT_EQ(found < 0 ? "" : rig.skeleton.joints[found].name, want[j]) << human_joint_name(j);
  }
}

// The body, whose joints are those of the canonical one, maps to itself.
void expect_maps_to_itself(const Skeleton& body, const HumanPositions& pose) {
  const Result<Mapping> got =
      map_humanoid(body, std::vector<JointPositions>{{pose.begin(), pose.end()}});
  ASSERT_TRUE(got.ok()) << got.error().message;
  for (int j = 0; j < kHumanJoints; ++j) EXPECT_EQ(got->joint_of[j], j) << human_joint_name(j);
  EXPECT_TRUE(got->notes.empty());
}

TEST(Mapping, our_own_skeleton_maps_to_itself) {
  expect_maps_to_itself(canonical_skeleton(), t_pose());
}

// As of a Rigify rig whose bones are left in a pose that leans, with one shoulder forward.
TEST(Mapping, a_head_without_its_name_is_found_in_a_pose_that_leans) {
  Skeleton body = canonical_skeleton();
  body.joints[index(neck)].name = "spine.004";
  body.joints[index(head)].name = "spine.005";
  HumanPositions pose = t_pose();
  for (const HumanJoint joint : {neck, head}) pose[index(joint)].x += 0.03f;
  expect_maps_to_itself(body, pose);
}

// Unreal's names, with a group wherever a guess by place would take it, and other tools' names for
// the ends of limbs above their own.
const std::vector<Line> kUnrealGrouped = tree(R"(
pelvis, hips = > spine_01, spine 0.5 > spine_02, spine = > spine_03, chest 0.9 = > group 1, chest
  > neck_01, neck 0.9 = > group 2, head 0.5 > skull, head 0.9 > head, head =;
group 1 > clavicle_*, leftShoulder = > upperarm_*, leftUpperArm = > lowerarm_*, leftLowerArm =
  > wrist_*, leftHand 0.9 > hand_*, leftHand = > thumb_01_*, leftHand 1.1;
pelvis > thigh_*, leftUpperLeg = > calf_*, leftLowerLeg = > ankle_*, leftFoot 0.9
  > foot_*, leftFoot = > forefoot_*, leftToes 0.9 > ball_*, leftToes =)");

TEST(Mapping, a_foot_below_an_ankle_without_toes_is_its_front) {
  std::vector<Line> lines = kUnrealGrouped;
  std::erase_if(lines, [](const Line& l) { return l.target == left_toes; });
  for (Line& line : lines) {
    if (line.name == "ankle_*") line.human = index(left_foot);
    if (line.name == "foot_*") line.human = index(left_toes);
  }
  expect_mapping(lines, "l", "r");
}

TEST(Mapping, a_group_below_upper_chest_is_not_the_chest) {
  std::vector<Line> lines = kUnrealGrouped;
  for (Line& line : lines) {
    for (std::string* name : {&line.name, &line.parent}) {
      if (*name == "spine_02") *name = "chest";
      if (*name == "spine_03") *name = "upperChest";
    }
  }
  expect_mapping(lines, "l", "r");
}

// What a mesh or the hierarchy contradicts is not taken for its name, and a note says so.
TEST(Mapping, a_contradicted_name_gets_a_note) {
  const auto notes = [](const MadeUp& rig) {
    const Result<Mapping> got = map_made_up(rig);
    EXPECT_TRUE(got.ok()) << got.error().message;
    return got ? got->notes : std::vector<std::string>();
  };
  MadeUp rig = make_up(kUnrealGrouped, "l", "r");
  EXPECT_TRUE(notes(rig).empty() || notes(rig).front().find("is named as") == std::string::npos);
  for (Joint& joint : rig.skeleton.joints) joint.skin = 0, joint.skin_weight = 10;
  for (const char* name : {"hand_l", "head"}) rig.skeleton.joints[rig.joint.at(name)].skin = -1;
  const auto has = [](const std::vector<std::string>& all, const std::string& note) {
    return std::count(all.begin(), all.end(), note) == 1;
  };
  EXPECT_TRUE(has(notes(rig),
                  "'hand_l' is named as leftHand and moves no mesh of its own: "
                  "'wrist_l' is taken"));
  EXPECT_TRUE(
      has(notes(rig), "'head' is named as head and moves no mesh of its own: 'skull' is taken"));
  // Beside the leg instead of in it.
  std::vector<Line> lines = kUnrealGrouped;
  for (Line& line : lines) {
    if (line.name == "ball_*") line.parent = "pelvis";
  }
  EXPECT_TRUE(has(notes(make_up(lines, "l", "r")),
                  "'ball_r' is named as rightToes and is not where that hangs: 'forefoot_r' is "
                  "taken"));
}

const std::vector<Line> kMixamo = tree(R"(
m:Hips, hips = > m:Spine, spine 0.5 > m:Spine1, spine = > m:Spine2, chest = > m:Neck, neck =
  > m:Head, head = > m:HeadTop_End, head 3;
m:Spine2 > m:*Shoulder, leftShoulder = > m:*Arm, leftUpperArm = > m:*ForeArm, leftLowerArm =
  > m:*Hand, leftHand = > m:*HandThumb1, leftHand 1.1;
m:*Hand > m:*HandIndex1, leftHand 1.2;
m:Hips > m:*UpLeg, leftUpperLeg = > m:*Leg, leftLowerLeg = > m:*Foot, leftFoot =
  > m:*ToeBase, leftToes = > m:*Toe_End, leftToes 1.5)");

TEST(Mapping, skeletons_map_as_a_person_would_map_them) {
  const struct {
    const char* what;
    std::vector<Line> lines;
    const char *left, *right;
  } cases[] = {
      {"Mixamo", kMixamo, "Left", "Right"},
      {"ends of limbs and numbered pieces obey a standard's own name", kUnrealGrouped, "l", "r"},
      // VRM's names with a group wherever a guess by place would take it.
      {"a standard's own name goes before a guess", tree(R"(
hips, hips = > group 1, hips 0.99 > spine, spine = > group 2, spine 1.2 > chest, chest 0.8 =
  > group 3, chest > neck, neck 0.9 = > group 4, neck > head, head =;
group 3 > *Shoulder, leftShoulder 0.9 = > group 5*, leftShoulder > *UpperArm, leftUpperArm 0.9 =
  > group 6*, leftUpperArm > *LowerArm, leftLowerArm 0.9 = > group 7*, leftLowerArm
  > *Hand, leftHand =;
group 1 > *UpperLeg, leftUpperLeg = > *LowerLeg, leftLowerLeg 0.9 = > group 8*, leftLowerLeg
  > *Foot, leftFoot = > *Toes, leftToes =)"),
       "left", "right"},
      {"CMU with joints of no length", tree(R"(
Hips, hips = > *HipJoint, hips > *UpLeg, leftUpperLeg = > *Leg, leftLowerLeg = > *Foot, leftFoot =
  > *ToeBase, leftToes =;
Hips > LowerBack, hips > Spine, spine = > Spine1, chest = > Neck, chest > Neck1, neck =
  > Head, head =;
Spine1 > *Shoulder, leftShoulder 0 = > *Arm, leftUpperArm = > *ForeArm, leftLowerArm =
  > *Hand, leftHand = > *FingerBase, leftHand > *HandIndex1, leftHand 1.3;
*Hand > *Thumb, leftHand)"),
       "Left", "Right"},
      {"a body without clavicles, spine, neck or toes", tree(R"(
Base, hips = > Body, chest = > Head, head =;
Body > Arm1*, leftUpperArm = > Arm2*, leftLowerArm = > Wrist*, leftHand =;
Base > Leg1*, leftUpperLeg = > Leg2*, leftLowerLeg = > Ankle*, leftFoot =)"),
       "_l", "_r"},
      {"numbers count the joints of an arm", tree(R"(
Hips, hips = > Spine, spine = > Chest, chest = > Neck, neck = > Head, head =;
Chest > Collar_*, leftShoulder = > Arm_*_1, leftUpperArm = > Arm_*_2, leftLowerArm =
  > Hand_*, leftHand =;
Hips > Leg_*_1, leftUpperLeg = > Leg_*_2, leftLowerLeg = > Foot_*, leftFoot = > Toe_*, leftToes =)"),
       "L", "R"},
      {"what carries the arms is no head whatever its name", tree(R"(
Hips, hips = > Spine, spine = > Skull, chest = > Dome, head =;
Skull > Arm1*, leftUpperArm = > Arm2*, leftLowerArm = > Wrist*, leftHand =;
Hips > Leg1*, leftUpperLeg = > Leg2*, leftLowerLeg = > Ankle*, leftFoot =)"),
       "_l", "_r"}};
  for (const auto& [what, lines, left, right] : cases) {
    SCOPED_TRACE(what);
    expect_mapping(lines, left, right);
  }
}

TEST(Mapping, case_does_not_matter) {
  std::vector<Line> lines = kMixamo;
  const auto upper = [](std::string& text) {
    for (char& c : text) c = static_cast<char>(std::toupper(c));
  };
  for (Line& line : lines) upper(line.name), upper(line.parent);
  // Capitals leave the finger names without a seam: they must still not be taken for the hand.
  expect_mapping(lines, "LEFT", "RIGHT");
}

TEST(Mapping, twist_joints_inside_the_limbs_are_passed_over) {
  std::vector<Line> lines = kMixamo;
  lines.insert(lines.begin() + 9, {"m:*ArmTwist", "m:*Arm", left_lower_arm, 0.5f});
  lines[10].parent = "m:*ArmTwist";
  lines.insert(lines.begin() + 11, {"m:*ForeArmRoll", "m:*ForeArm", left_hand, 0.5f});
  lines[12].parent = "m:*ForeArmRoll";
  expect_mapping(lines, "Left", "Right");
}

TEST(Mapping, a_head_by_another_name_is_the_end_of_the_chain_above_the_chest) {
  std::vector<Line> lines = kMixamo;
  lines[5].name = "m:Kopf";
  lines[6] = {"m:Kopf_End", "m:Kopf", head, 3};
  expect_mapping(lines, "Left", "Right");
}

TEST(Mapping, no_two_human_joints_share_a_joint) {
  // Arms and legs meet in one joint: it is the hips, and the chest is missing.
  const MadeUp rig = make_up(tree(R"(
Body, hips > Head, head;
Body > *Arm, leftUpperArm > *Elbow, leftLowerArm > *Hand, leftHand;
Body > *Thigh, leftUpperLeg > *Knee, leftLowerLeg > *Foot, leftFoot)"),
                             "Left", "Right");
  const Result<Mapping> got = map_made_up(rig);
  ASSERT_TRUE(got.ok()) << got.error().message;
  EXPECT_EQ(got->joint_of[index(hips)], 0);
  EXPECT_EQ(got->joint_of[index(chest)], -1);
  std::vector<int> seen(rig.skeleton.joints.size());
  for (int joint : got->joint_of) {
    if (joint < 0) continue;
    EXPECT_EQ(seen[joint]++, 0);
  }
}

TEST(Mapping, every_joint_has_a_reason) {
  const MadeUp rig = make_up(kMixamo, "Left", "Right");
  const Result<Mapping> got = map_made_up(rig);
  ASSERT_TRUE(got.ok()) << got.error().message;
  for (const std::string& reason : got->reasons) EXPECT_FALSE(reason.empty());
  EXPECT_EQ(got->reasons[index(left_hand)], "by its name");
  EXPECT_EQ(got->reasons[index(left_lower_arm)], "next joint above leftHand");
  ASSERT_EQ(got->notes.size(), 1u);
  EXPECT_EQ(got->notes[0], "2 joints between hips and chest");
}

// A body with straight knees and elbows whose names say nothing.
std::vector<Line> nameless() {
  return tree(R"(
a, hips > b, spine > c, chest > d, head;
c > e*, leftUpperArm > f*, leftLowerArm > g*, leftHand;
a > h*, leftUpperLeg > i*, leftLowerLeg > j*, leftFoot)");
}

bool has_note(const Mapping& mapping, std::string_view start) {
  return std::any_of(mapping.notes.begin(), mapping.notes.end(),
                     [&](const std::string& note) { return note.starts_with(start); });
}

TEST(Mapping, a_note_says_so_where_left_and_right_are_guessed) {
  std::vector<Line> lines = nameless();
  const Result<Mapping> guessed = map_made_up(make_up(lines, "1", "2"));
  ASSERT_TRUE(guessed.ok()) << guessed.error().message;
  EXPECT_TRUE(has_note(*guessed, "the names of the joints are not conclusive: mapped by shape"));
  EXPECT_TRUE(
      has_note(*guessed, "left and right are guessed: nothing shows which way the body faces"));

  lines.push_back({"k*", "j*", left_toes});
  const MadeUp with_toes = make_up(lines, "1", "2");
  const Result<Mapping> seen = map_made_up(with_toes);
  ASSERT_TRUE(seen.ok()) << seen.error().message;
  EXPECT_TRUE(has_note(*seen, "the names of the joints are not conclusive: mapped by shape"));
  EXPECT_FALSE(has_note(*seen, "left and right are guessed"));
  EXPECT_EQ(seen->joint_of[index(left_hand)], with_toes.joint.at("g1"));
  EXPECT_EQ(seen->joint_of[index(right_foot)], with_toes.joint.at("j2"));
  EXPECT_LT(guessed->confidence[index(left_foot)], seen->confidence[index(left_foot)] / 2);
}

TEST(Mapping, a_skirt_of_hundreds_of_equal_joints_hides_no_limb) {
  std::vector<Line> lines = nameless();
  lines.push_back({"k*", "j*", left_toes});
  MadeUp rig = make_up(lines, "1", "2");
  for (int i = 0; i < 300; ++i) {
    Joint joint = rig.skeleton.joints[rig.joint.at("b")];
    joint.name = "l";
    joint.offset = {0.2f * std::cos(0.02f * static_cast<float>(i)), -0.3f,
                    0.2f * std::sin(0.02f * static_cast<float>(i))};
    rig.positions.push_back(rig.positions[rig.joint.at("a")] + joint.offset);
    rig.skeleton.joints.push_back(joint);
  }
  const Result<Mapping> got = map_made_up(rig);
  ASSERT_TRUE(got.ok()) << got.error().message;
  EXPECT_EQ(got->joint_of[index(left_hand)], rig.joint.at("g1"));
  EXPECT_EQ(got->joint_of[index(right_foot)], rig.joint.at("j2"));
}

TEST(Mapping, where_there_are_no_toes_elbows_tell_left_from_right) {
  std::vector<Line> end_on_foot = nameless();
  end_on_foot.push_back({"k*", "j*", left_toes, 0});
  for (const std::vector<Line>& lines : {nameless(), end_on_foot}) {
    for (const float back : {0.05f, -0.05f}) {
      MadeUp rig = make_up(lines, "1", "2");
      for (const char* elbow : {"f1", "f2"}) rig.positions[rig.joint.at(elbow)].z -= back;
      const Result<Mapping> got = map_made_up(rig);
      ASSERT_TRUE(got.ok()) << got.error().message;
      EXPECT_FALSE(has_note(*got, "left and right are guessed")) << lines.size();
      EXPECT_EQ(got->joint_of[index(left_hand)], rig.joint.at(back > 0 ? "g1" : "g2"));
      EXPECT_EQ(got->joint_of[index(left_foot)], rig.joint.at(back > 0 ? "j1" : "j2"));
    }
  }
}

TEST(Mapping, arms_and_legs_without_names_may_all_hang_on_one_joint) {
  std::vector<Line> lines = nameless();
  std::erase_if(lines, [](const Line& l) { return l.name == "b" || l.name == "c"; });
  for (Line& line : lines) {
    if (line.parent == "c") line.parent = "a";
  }
  lines.push_back({"k*", "j*", left_toes});
  const MadeUp rig = make_up(lines, "1", "2");
  const Result<Mapping> got = map_made_up(rig);
  ASSERT_TRUE(got.ok()) << got.error().message;
  EXPECT_EQ(got->joint_of[index(hips)], rig.joint.at("a"));
  EXPECT_EQ(got->joint_of[index(left_hand)], rig.joint.at("g1"));
  EXPECT_EQ(got->joint_of[index(right_hand)], rig.joint.at("g2"));
  EXPECT_EQ(got->joint_of[index(right_foot)], rig.joint.at("j2"));
}

TEST(Mapping, of_several_joints_between_hips_and_chest_the_spine_is_less_certain) {
  std::vector<Line> lines = kMixamo;
  const float of_two = map_made_up(make_up(lines, "Left", "Right"))->confidence[index(spine)];
  lines.erase(lines.begin() + 1);
  lines[1].parent = "m:Hips";
  const float of_one = map_made_up(make_up(lines, "Left", "Right"))->confidence[index(spine)];
  EXPECT_LT(of_two, of_one);
}

std::string rejection(const std::vector<Line>& lines) {
  const MadeUp rig = make_up(lines, "Left", "Right");
  const Result<Mapping> got = map_made_up(rig);
  return got.ok() ? "mapped" : got.error().message;
}

TEST(Mapping, a_robot_arm_is_rejected_by_name) {
  EXPECT_EQ(rejection(tree("Base, hips > Arm1, chest > Arm2, head")),
            "no humanoid found: leftHand, rightHand, leftFoot, rightFoot, head are missing among "
            "'Base', 'Arm1', 'Arm2' (3 joints); expected a person's joints: hips, two legs down "
            "to the feet and two arms down to the forearms");
}

TEST(Mapping, advice_is_of_names_once_there_are_as_many_joints_as_a_person_needs) {
  std::vector<Line> lines = {{"q0", "", hips}};
  const auto advice = [&](size_t joints) {
    while (lines.size() < joints) {
      lines.push_back({"q" + std::to_string(lines.size()), lines.back().name, spine});
    }
    const std::string message = rejection(lines);
    return message.substr(std::min(message.find(" joints); "), message.size()));
  };
  EXPECT_TRUE(advice(10).starts_with(" joints); expected a person's joints: hips, two legs"));
  // Hips, and of each limb the joints down to the foot or forearm.
  EXPECT_TRUE(advice(11).starts_with(" joints); expected names such as LeftHand or hand_L"));
}

// As in packs of small figures: no names and no map make legs of these.
TEST(Mapping, a_figure_without_legs_is_rejected_with_what_it_lacks) {
  EXPECT_EQ(rejection(tree(R"(
Body, hips > Head, head;
Body > arm*, leftUpperArm > handSlot*, leftHand)")),
            "no humanoid found: leftFoot, rightFoot are missing among 'Body', 'Head', 'armLeft', "
            "'armRight', 'handSlotLeft', 'handSlotRight' (6 joints); expected a person's "
            "joints: hips, two legs down to the feet and two arms down to the forearms");
}

TEST(Mapping, a_hand_without_an_arm_is_rejected) {
  std::vector<Line> lines = kMixamo;
  std::erase_if(lines, [](const Line& l) { return l.name == "m:*ForeArm" || l.name == "m:*Arm"; });
  for (Line& line : lines) {
    if (line.name == "m:*Hand") line.parent = "m:*Shoulder";
  }
  EXPECT_EQ(rejection(lines),
            "no humanoid found: leftLowerArm, leftUpperArm, rightLowerArm, rightUpperArm are "
            "missing among 'm:Hips', 'm:Spine', "
            "'m:Spine1', 'm:Spine2', 'm:Neck', 'm:Head', 'm:HeadTop_End', 'm:LeftShoulder', "
            "'m:RightShoulder', 'm:LeftHand', 'm:RightHand', 'm:LeftHandThumb1', ... (25 joints); "
            "expected names such as LeftHand or hand_L, the shape of a person, or a map that says "
            "which joint is which");
}

TEST(Mapping, no_limb_takes_the_root_that_it_shares_with_the_other_side) {
  std::vector<Line> lines = kMixamo;
  std::erase_if(lines, [](const Line& l) { return l.name == "m:*Shoulder" || l.name == "m:*Arm"; });
  for (Line& line : lines) {
    if (line.name == "m:*ForeArm") line.parent = "m:Hips";
  }
  EXPECT_TRUE(rejection(lines).starts_with(
      "no humanoid found: leftLowerArm, leftUpperArm, rightLowerArm, rightUpperArm are missing"))
      << rejection(lines);
}

TEST(Mapping, a_finger_is_not_taken_for_a_hand_that_is_missing) {
  std::vector<Line> lines = kMixamo;
  std::erase_if(lines, [](const Line& l) { return l.name == "m:*Hand"; });
  for (Line& line : lines) {
    if (line.parent == "m:*Hand") line.parent = "m:*ForeArm";
  }
  expect_mapping(lines, "Left", "Right");
}

TEST(Mapping, where_feet_have_other_names_the_shape_of_the_legs_tells_them) {
  std::vector<Line> lines = kMixamo;
  lines[15].name = "m:*Hoof";
  lines[16].parent = "m:*Hoof";
  lines[16].name = "m:*Nail";
  lines[17].parent = "m:*Nail";
  expect_mapping(lines, "Left", "Right");
}

TEST(Mapping, missing_feet_are_named_alone) {
  std::vector<Line> lines = kMixamo;
  std::erase_if(lines, [](const Line& l) {
    return l.name == "m:*Foot" || l.name == "m:*ToeBase" || l.name == "m:*Toe_End";
  });
  EXPECT_TRUE(rejection(lines).starts_with(
      "no humanoid found: leftFoot, rightFoot are missing among 'm:Hips'"));
}

TEST(Mapping, what_is_known_goes_before_what_is_found) {
  const MadeUp rig = make_up(kMixamo, "Left", "Right");
  const std::vector<JointPositions> poses = {rig.positions};
  const int spine1 = rig.joint.at("m:Spine1"), below = rig.joint.at("m:Spine");
  const Result<Mapping> got =
      map_humanoid(rig.skeleton, poses, {{index(spine), below}, {index(neck), -1}});
  ASSERT_TRUE(got.ok()) << got.error().message;
  EXPECT_EQ(got->joint_of[index(spine)], below);
  EXPECT_EQ(got->reasons[index(spine)], "as given");
  EXPECT_EQ(got->joint_of[index(neck)], -1);
  EXPECT_EQ(got->joint_of[index(head)], rig.joint.at("m:Head"));
  EXPECT_EQ(std::count(got->joint_of.begin(), got->joint_of.end(), spine1), 0);
}

TEST(Mapping, what_is_known_but_cannot_be_is_rejected) {
  const MadeUp rig = make_up(kMixamo, "Left", "Right");
  const std::vector<JointPositions> poses = {rig.positions};
  const auto message = [&](const KnownJoints& known) {
    const Result<Mapping> got = map_humanoid(rig.skeleton, poses, known);
    return got.ok() ? "mapped" : got.error().message;
  };
  EXPECT_EQ(message({{index(left_toes), rig.joint.at("m:RightToeBase")}}),
            "'m:RightToeBase' cannot be leftToes: expected a joint below leftFoot 'm:LeftFoot'");
  EXPECT_TRUE(message({{index(left_upper_arm), -1}})
                  .starts_with("no humanoid found: leftUpperArm is missing among 'm:Hips'"));
}

TEST(Mapping, bodies_in_pieces_and_poses_without_numbers_are_rejected) {
  std::vector<Line> lines = kMixamo;
  for (Line& line : lines) {
    if (line.name == "m:*UpLeg") line.parent = "";
  }
  EXPECT_TRUE(rejection(lines).starts_with("no humanoid found: hips is missing among"));
  lines = kMixamo;
  for (Line& line : lines) {
    if (line.name == "m:*Arm") line.parent = "";
  }
  EXPECT_TRUE(rejection(lines).starts_with("no humanoid found: chest, hips are missing among"))
      << rejection(lines);
  MadeUp rig = make_up(kMixamo, "Left", "Right");
  rig.positions.assign(rig.positions.size(), Vec3{NAN, NAN, NAN});
  EXPECT_FALSE(map_made_up(rig).ok());
  EXPECT_FALSE(map_humanoid(Skeleton{}, std::vector<JointPositions>(1)).ok());
}

}  // namespace
}  // namespace panache
