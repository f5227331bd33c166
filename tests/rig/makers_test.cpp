// The rigs of many makers, tools and languages are understood without help.

#include <ostream>

#include <gtest/gtest.h>

#include "rig/put_on.h"
#include "rig/rig.h"

namespace panache {
namespace {

using namespace test;
using enum HumanJoint;

// A body that stands, steps and swings its arms a little: enough to tell what turns about what.
Clip moving_body() {
  const Skeleton body = canonical_skeleton();
  Clip out{body, 1.0 / 30, 40, {}, {}};
  for (int f = 0; f < out.frames; ++f) {
    const float swing = std::sin(static_cast<float>(f) * 0.3f);
    for (int j = 0; j < kHumanJoints; ++j) {
      const auto is = [&](HumanJoint joint) { return j == index(joint); };
      Vec3 turn;
      if (is(left_upper_arm)) turn = {0, 0.4f * swing, -1.2f};
      if (is(right_upper_arm)) turn = {0, 0.4f * swing, 1.2f};
      if (is(left_upper_leg)) turn = {-0.4f * swing, 0, 0};
      if (is(right_upper_leg)) turn = {0.4f * swing, 0, 0};
      if (is(left_lower_leg) || is(right_lower_leg)) turn = {0.3f, 0, 0};
      if (is(chest)) turn = {0.1f, 0.2f * swing, 0};
      out.rotations.push_back(exp_rotation(turn));
      out.translations.push_back(body.joints[j].offset);
    }
  }
  return out;
}

// `order`: of the joints of a clip whose own names say nothing.
void expect_maps(const Clip& clip, const std::array<int, kHumanJoints>& want,
                 const std::vector<int>& order = {}) {
  const Result<Rig> rig = Rig::create(clip);
  ASSERT_TRUE(rig.ok()) << rig.error().message;
  for (int j = 0; j < kHumanJoints; ++j) {
    int found = rig->joints()[j];
    if (found >= 0 && !order.empty()) found = order[found];
    EXPECT_EQ(found, want[j]) << human_joint_name(j);
  }
}

TEST(Makers, every_rig_maps_as_a_person_would_map_it_in_motion_and_at_rest) {
  for (const Maker& maker : makers()) {
    SCOPED_TRACE(maker.name);
    const Clip clip = put_on(maker, moving_body()).clip, rest = rest_clip(clip.skeleton);
    for (const Clip& each : {clip, rest}) expect_maps(each, expected_joints(maker, each));
  }
}

TEST(Makers, a_rig_whose_joints_are_shuffled_and_renamed_maps_by_its_shape) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    for (const Maker& maker : makers()) {
      // That arms hang on the neck and legs on the spine only its names tell.
      if (maker.name == std::string("3ds Max Biped")) continue;
      SCOPED_TRACE(maker.name + std::string(", seed ") + std::to_string(seed));
      const Character character = put_on(maker, moving_body());
      const Anonymous nameless = anonymous(character.clip, seed);
      expect_maps(nameless.clip, expected_joints(maker, character.clip), nameless.order);
    }
  }
}

// The names of a plain skeleton; a '*' stands for the side, "" for a joint that is not there.
struct PlainNames {
  const char *maker, *left, *right;
  const char *root, *hips, *spine, *chest, *neck, *head;
  const char *shoulder, *upper_arm, *lower_arm, *hand, *finger;
  const char *upper_leg, *lower_leg, *foot, *toes;
};

// In the names of tests.
void PrintTo(const PlainNames& names, std::ostream* out) { *out << names.maker; }

Maker plain(const PlainNames& n) {
  Maker out{n.maker, n.left, n.right, RestPose::t, Axes::world, 100, false, 1.05f, 1, 1, {}};
  const auto first = [&](std::initializer_list<const char*> names) {
    for (const char* each : names) {
      if (*each) return std::string(each);
    }
    return std::string();
  };
  const auto add = [&](const char* joint, const std::string& parent, HumanJoint target,
                       float along = 1) {
    const bool is_human = joint != n.root && joint != n.finger;
    if (*joint) out.lines.push_back({joint, parent, target, along, is_human ? index(target) : -1});
  };
  add(n.root, "", hips, 0);
  add(n.hips, n.root, hips);
  add(n.spine, n.hips, spine);
  add(n.chest, first({n.spine, n.hips}), chest);
  add(n.neck, n.chest, neck);
  add(n.head, first({n.neck, n.chest}), head);
  add(n.shoulder, n.chest, left_shoulder);
  add(n.upper_arm, first({n.shoulder, n.chest}), left_upper_arm);
  add(n.lower_arm, n.upper_arm, left_lower_arm);
  add(n.hand, n.lower_arm, left_hand);
  add(n.finger, n.hand, left_hand, 1.4f);
  add(n.upper_leg, n.hips, left_upper_leg);
  add(n.lower_leg, n.upper_leg, left_lower_leg);
  add(n.foot, n.lower_leg, left_foot);
  add(n.toes, n.foot, left_toes);
  return out;
}

const PlainNames kNames[] = {
    {"Second Life", "Left", "Right", "", "mPelvis", "mTorso", "mChest", "mNeck", "mHead",
     "mCollar*", "mShoulder*", "mElbow*", "mWrist*", "mHandIndex1*", "mHip*", "mKnee*", "mAnkle*",
     "mFoot*"},
    {"Character Creator", "L", "R", "RL_BoneRoot", "CC_Base_Hip", "CC_Base_Waist",
     "CC_Base_Spine02", "CC_Base_NeckTwist01", "CC_Base_Head", "CC_Base_*_Clavicle",
     "CC_Base_*_Upperarm", "CC_Base_*_Forearm", "CC_Base_*_Hand", "CC_Base_*_Index1",
     "CC_Base_*_Thigh", "CC_Base_*_Calf", "CC_Base_*_Foot", "CC_Base_*_ToeBase"},
    {"MakeHuman", "L", "R", "root", "spine05", "spine03", "spine01", "neck01", "head", "clavicle.*",
     "upperarm01.*", "lowerarm01.*", "wrist.*", "finger2-1.*", "upperleg01.*", "lowerleg01.*",
     "foot.*", "toe1-1.*"},
    {"Advanced Skeleton", "L", "R", "", "Root_M", "Spine1_M", "Chest_M", "Neck_M", "Head_M",
     "Scapula_*", "Shoulder_*", "Elbow_*", "Wrist_*", "IndexFinger1_*", "Hip_*", "Knee_*",
     "Ankle_*", "Toes_*"},
    {"OptiTrack", "L", "R", "", "Skeleton 001:Hip", "Skeleton 001:Ab", "Skeleton 001:Chest",
     "Skeleton 001:Neck", "Skeleton 001:Head", "Skeleton 001:*Shoulder", "Skeleton 001:*UArm",
     "Skeleton 001:*FArm", "Skeleton 001:*Hand", "", "Skeleton 001:*Thigh", "Skeleton 001:*Shin",
     "Skeleton 001:*Foot", "Skeleton 001:*Toe"},
    {"Acclaim", "l", "r", "", "root", "lowerback", "thorax", "lowerneck", "head", "*clavicle",
     "*humerus", "*radius", "*hand", "*fingers", "*femur", "*tibia", "*foot", "*toes"},
    {"Kinect", "LEFT", "RIGHT", "", "PELVIS", "SPINE_NAVAL", "SPINE_CHEST", "NECK", "HEAD",
     "CLAVICLE_*", "SHOULDER_*", "ELBOW_*", "WRIST_*", "HANDTIP_*", "HIP_*", "KNEE_*", "ANKLE_*",
     "FOOT_*"},
    {"ARKit", "left", "right", "root", "hips_joint", "spine_4_joint", "spine_7_joint",
     "neck_1_joint", "head_joint", "*_shoulder_1_joint", "*_arm_joint", "*_forearm_joint",
     "*_hand_joint", "*_handIndexStart_joint", "*_upLeg_joint", "*_leg_joint", "*_foot_joint",
     "*_toes_joint"},
    {"Valve", "L", "R", "", "ValveBiped.Bip01_Pelvis", "ValveBiped.Bip01_Spine1",
     "ValveBiped.Bip01_Spine4", "ValveBiped.Bip01_Neck1", "ValveBiped.Bip01_Head1",
     "ValveBiped.Bip01_*_Clavicle", "ValveBiped.Bip01_*_UpperArm", "ValveBiped.Bip01_*_Forearm",
     "ValveBiped.Bip01_*_Hand", "ValveBiped.Bip01_*_Finger0", "ValveBiped.Bip01_*_Thigh",
     "ValveBiped.Bip01_*_Calf", "ValveBiped.Bip01_*_Foot", "ValveBiped.Bip01_*_Toe0"},
    {"HumanIK", "Left", "Right", "Character1_Reference", "Character1_Hips", "Character1_Spine",
     "Character1_Spine1", "Character1_Neck", "Character1_Head", "Character1_*Shoulder",
     "Character1_*Arm", "Character1_*ForeArm", "Character1_*Hand", "Character1_*HandIndex1",
     "Character1_*UpLeg", "Character1_*Leg", "Character1_*Foot", "Character1_*ToeBase"},
    {"MikuMikuDance", "左", "右", "センター", "下半身", "上半身", "上半身2", "首", "頭", "*肩",
     "*腕", "*ひじ", "*手首", "*人指１", "*足", "*ひざ", "*足首", "*つま先"},
    {"Maya", "lf", "rt", "", "cog_jnt", "spine_02_jnt", "spine_05_jnt", "neck_01_jnt", "head_jnt",
     "*_clav_jnt", "*_shoulder_jnt", "*_elbow_jnt", "*_wrist_jnt", "*_index_01_jnt", "*_hip_jnt",
     "*_knee_jnt", "*_ankle_jnt", "*_ball_jnt"},
    {"Spanish", "Izq", "Der", "", "Cadera", "Columna", "Pecho", "Cuello", "Cabeza", "Clavicula*",
     "Brazo*", "Antebrazo*", "Mano*", "", "Muslo*", "Pierna*", "Pie*", "Dedos*"},
    {"German", "links", "rechts", "", "Becken", "Lende", "Brust", "Hals", "Kopf", "Schulter_*",
     "Oberarm_*", "Unterarm_*", "Hand_*", "", "Oberschenkel_*", "Unterschenkel_*", "Fuss_*",
     "Zehen_*"},
    {"capitals", "LEFT", "RIGHT", "", "HIPS", "SPINE", "CHEST", "NECK", "HEAD", "*SHOULDER",
     "*UPPERARM", "*LOWERARM", "*HAND", "", "*UPPERLEG", "*LOWERLEG", "*FOOT", "*TOES"},
    {"words apart", "left", "right", "", "lower body", "belly", "upper body", "", "the head", "",
     "upper arm (*)", "lower arm (*)", "hand (*)", "", "upper leg (*)", "lower leg (*)", "foot (*)",
     ""},
    {"side behind", "_left", "_right", "", "pelvis", "torso", "chest", "neck", "head", "collar*",
     "arm*", "fore_arm*", "wrist*", "", "thigh*", "shank*", "ankle*", "toe*"},
};

class MoreMakers : public testing::TestWithParam<PlainNames> {};

TEST_P(MoreMakers, maps_as_a_person_would_map_it) {
  const Maker maker = plain(GetParam());
  const Clip clip = put_on(maker, rest_clip(canonical_skeleton())).clip;
  expect_maps(clip, expected_joints(maker, clip));
}

INSTANTIATE_TEST_SUITE_P(Names, MoreMakers, testing::ValuesIn(kNames), [](const auto& test) {
  std::string name;
  for (const char c : std::string(test.param.maker)) {
    if (std::isalnum(static_cast<unsigned char>(c))) name += c;
  }
  return name;
});

}  // namespace
}  // namespace panache
