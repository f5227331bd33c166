// VRM animations: what three-vrm makes of those that we write, and what becomes of those of others.

#include <cmath>
#include <functional>

#include <nlohmann/json.hpp>

#include "cli/node.h"
#include "clip/clip.h"
#include "clip/gltf.h"
#include "clip/make_character.h"
#include "rig/posed_rig.h"
#include "rig/put_on.h"

namespace panache::test {
namespace {

using enum HumanJoint;

// Floats along a chain of eight joints.
constexpr double kShownAlikeDeg = 0.1;

// Seconds at which characters are looked at.
constexpr double kTimes[] = {0, 0.4, 1};

// An avatar as a VRM 1.0 file, with an expression.
GltfParts avatar() {
  GltfParts parts = character({.vrm = CharacterOptions::Vrm::vrm1});
  Json& vrm = parts.json["extensions"]["VRMC_vrm"];
  vrm["meta"] = {
      {"name", "boxes"}, {"authors", {"nobody"}}, {"licenseUrl", "https://vrm.dev/licenses/1.0/"}};
  vrm["expressions"]["preset"]["happy"] = Json::object();
  return parts;
}

// The body of a .vrma, with two nodes more that carry a happy face and a gaze.
GltfParts with_expression(const std::string& vrma) {
  GltfParts parts = glb_parts(vrma);
  Json& json = parts.json;
  const size_t happy = json["nodes"].size(), gaze = happy + 1;
  json["nodes"].push_back({{"name", "happy"}});
  json["nodes"].push_back({{"name", "gaze"}});
  json["scenes"][0]["nodes"].push_back(happy);
  json["scenes"][0]["nodes"].push_back(gaze);
  Json& extension = json["extensions"]["VRMC_vrm_animation"];
  extension["expressions"]["preset"]["happy"]["node"] = happy;
  extension["lookAt"] = {{"node", gaze}, {"offsetFromHeadBone", {0, 0.06, 0}}};
  const size_t times = parts.add_bounded({0, 1}, "SCALAR", 1);
  parts.add_channel(0, happy, "translation", "LINEAR", times,
                    parts.add(std::vector<float>{0, 0, 0, 1, 0, 0}, "VEC3", 3));
  parts.add_channel(0, gaze, "rotation", "LINEAR", times,
                    parts.add(std::vector<float>{0, 0, 0, 1, 0, 0.6f, 0, 0.8f}, "VEC4", 4));
  return parts;
}

size_t joint_of(const Clip& clip, const std::string& name) {
  size_t j = 0;
  while (j + 1 < clip.joints() && clip.skeleton.joints[j].name != name) ++j;
  return j;
}

class Vrma : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write_walk("walk.bvh", 31);
    must_quietly("convert walk.bvh -o walk.vrma");
  }

  // What three-vrm shows of a file at kTimes.
  Json played(const std::string& name, const GltfParts& on = avatar()) {
    write("avatar.vrm", to_glb(on));
    std::string times;
    for (const double seconds : kTimes) times += " " + std::to_string(seconds);
    EXPECT_TRUE(run_node(*this, "play-vrma.mjs", name + " avatar.vrm" + times)) << read("err.txt");
    return Json::parse(read("out.txt"), nullptr, false);
  }

  // Where three-vrm shows a joint in the pose of one of kTimes.
  static Vec3 shown_at(const Json& seen, size_t time, int joint) {
    const Json& p = seen["poses"][time]["joints"][std::string(human_joint_name(joint))];
    return {p[0].get<float>(), p[1].get<float>(), p[2].get<float>()};
  }
  // The largest angle between a limb and the same of the other body, degrees.
  using Positions = std::function<Vec3(int)>;
  static double worst_limb(
      const Positions& one, const Positions& other,
      const std::function<bool(int)>& counts = [](int) { return true; }) {
    double worst = 0;
    for (const HumanJoint joint : {left_lower_arm, left_hand, right_lower_arm, right_hand,
                                   left_lower_leg, left_foot, right_lower_leg, right_foot}) {
      const int j = index(joint), parent = kHumanParent[j];
      if (!counts(j)) continue;
      worst = std::max(
          worst, angle_deg(normalized(one(j) - one(parent)), normalized(other(j) - other(parent))));
    }
    return worst;
  }

  // Limbs of the avatar point where those of the motion do, and its hips go as far in lengths of
  // their height.
  void expect_seen(const Clip& motion, const std::string& name) {
    const Json seen = played(name);
    ASSERT_TRUE(seen.is_object());
    const Rig rig = *Rig::create(motion);
    PosedRig reader(rig);
    Vec3 start, avatar_start;
    double worst_deg = 0;
    for (size_t i = 0; i < std::size(kTimes); ++i) {
      BodyPose body;
      const auto frame = static_cast<int>(std::lround(kTimes[i] / motion.frame_time));
      if (frame >= motion.frames) continue;
      reader.read(motion.pose(frame), body);
      const auto at = [&](int joint) { return shown_at(seen, i, joint); };
      // The rigs of makers without a hand have another wrist.
      const double off_deg = worst_limb([&](int j) { return body.joints[j]; }, at,
                                        [&](int j) { return rig.joints()[j] >= 0; });
      worst_deg = std::max(worst_deg, off_deg);
      EXPECT_LT(off_deg, kShownAlikeDeg) << name << " " << i;
      const Vec3 middle =
          mid_of(body.joints[index(left_upper_leg)], body.joints[index(right_upper_leg)]);
      const Vec3 avatar_middle = mid_of(at(index(left_upper_leg)), at(index(right_upper_leg)));
      if (i == 0) start = middle, avatar_start = avatar_middle;
      const float leg =
          length(body.joints[index(left_foot)] - body.joints[index(left_lower_leg)]) +
          length(body.joints[index(left_lower_leg)] - body.joints[index(left_upper_leg)]);
      const float avatar_leg = length(at(index(left_foot)) - at(index(left_lower_leg))) +
                               length(at(index(left_lower_leg)) - at(index(left_upper_leg)));
      const Vec3 travel = (middle - start) / leg,
                 avatar_travel = (avatar_middle - avatar_start) / avatar_leg;
      // Players scale by the height of the hips, and the avatar's are not as high as ours above
      // legs of the same length.
      EXPECT_LT(length(travel - avatar_travel), 0.1f * length(travel) + 0.01f) << name << " " << i;
    }
    std::printf("%s: worst limb %.4f deg\n", name.c_str(), worst_deg);
  }
  static Vec3 mid_of(Vec3 a, Vec3 b) { return (a + b) * 0.5f; }
};

TEST_F(Vrma, a_bvh_becomes_one_that_its_player_shows_alike) {
  if (const std::string what = missing_node(); !what.empty()) GTEST_SKIP() << what;
  expect_seen(walking_clip(31), "walk.vrma");
}

// Rest poses with arms half or wholly down, local axes anywhere, centimetres, Z up.
TEST_F(Vrma, motion_of_every_makers_rig_is_shown_as_it_is) {
  if (const std::string what = missing_node(); !what.empty()) GTEST_SKIP() << what;
  for (const Maker& maker : makers()) {
    SCOPED_TRACE(maker.name);
    const Clip clip = put_on(maker, walking_clip(31)).clip;
    const Rig rig = *Rig::create(clip);
    const Quat y_up = maker.z_up ? exp_rotation(Vec3{-3.14159265f / 2, 0, 0}) : Quat{};
    write("maker.glb", format_glb(clip, "walk", static_cast<double>(rig.scale()), y_up));
    must_quietly("convert maker.glb --force -o maker.vrma");
    expect_seen(clip, "maker.vrma");
  }
}

// The file with its arms, one thigh and the head turned at rest, and not turned back.
GltfParts with_turned_rest(const std::string& vrma, float degrees) {
  GltfParts parts = glb_parts(vrma);
  const float angle = degrees * 3.14159265f / 180;
  const auto turn = [&](const char* name, Vec3 axis, float by) {
    for (Json& node : parts.json["nodes"]) {
      if (node["name"] != name) continue;
      const Quat q = axis_angle(axis, by);
      node["rotation"] = {q.x, q.y, q.z, q.w};
    }
  };
  turn("leftUpperArm", {0, 0, 1}, -angle);
  turn("rightUpperArm", {0, 0, 1}, angle);
  turn("rightLowerArm", {0, 1, 0}, angle / 2);
  turn("leftUpperLeg", {1, 0, 0}, -angle / 2);
  turn("head", {0, 1, 0}, angle);
  return parts;
}

// Of a VRM animation whose rest pose is any, and of what becomes of it, the avatar shows what the
// clip has.
TEST_F(Vrma, rotations_are_against_the_rest_pose_whatever_that_is) {
  if (const std::string what = missing_node(); !what.empty()) GTEST_SKIP() << what;
  for (const float degrees : {40.0f, -25.0f}) {
    write("bent.vrma", to_glb(with_turned_rest(read("walk.vrma"), degrees)));
    const auto bent = open("bent.vrma");
    ASSERT_TRUE(bent);
    expect_seen(bent->clip(), "bent.vrma");
    // The arm of the avatar turns by the angle of the rest pose, against that of the plain file.
    const auto plain = open("walk.vrma");
    const auto arm = [](const Clip& clip) {
      const auto at = world_positions(clip, 10);
      const size_t upper = joint_of(clip, "leftUpperArm"), lower = joint_of(clip, "leftLowerArm");
      return normalized(at[lower] - at[upper]);
    };
    EXPECT_GT(angle_deg(arm(bent->clip()), arm(plain->clip())), 5);
    must_quietly("stylize bent.vrma --style old=1 --force -o bent-old.vrma");
    expect_seen(open("bent-old.vrma")->clip(), "bent-old.vrma");
    must_quietly("convert bent.vrma --force -o bent.bvh");
    must_quietly("convert bent.bvh --force -o again.vrma");
    expect_seen(bent->clip(), "again.vrma");
    must_quietly("retarget walk.bvh --onto bent.vrma --no-feet --force -o onto.vrma");
    expect_seen(open("walk.bvh")->clip(), "onto.vrma");
  }
}

// An avatar as a VRM 0 file, which faces -z.
GltfParts old_avatar() {
  GltfParts parts = character({.vrm = CharacterOptions::Vrm::vrm0});
  parts.json["nodes"][0]["rotation"] = {0, 1, 0, 0};
  parts.json["extensions"]["VRM"]["meta"] = {{"title", "boxes"}, {"author", "nobody"}};
  return parts;
}

// A motion put on a .vrm of either version is what the player shows of the motion on it.
TEST_F(Vrma, avatars_of_both_versions_get_what_the_player_shows) {
  if (const std::string what = missing_node(); !what.empty()) GTEST_SKIP() << what;
  write("bent.vrma", to_glb(with_turned_rest(read("walk.vrma"), 40)));
  for (const bool is_old : {true, false}) {
    const Json seen = played("bent.vrma", is_old ? old_avatar() : avatar());
    ASSERT_TRUE(seen.is_object());
    must_quietly("retarget bent.vrma --onto avatar.vrm --no-feet --replace --force -o onto.vrm");
    const auto onto = open("onto.vrm");
    ASSERT_TRUE(onto);
    const Clip& clip = onto->clip();
    double worst_deg = 0;
    for (size_t i = 0; i < std::size(kTimes); ++i) {
      const auto frame = static_cast<int>(std::lround(kTimes[i] / clip.frame_time));
      if (frame >= clip.frames) continue;
      const std::vector<Vec3> positions = world_positions(clip, frame);
      const auto position_of = [&](int human) {
        size_t j = 0;
        while (clip.skeleton.joints[j].role != human_joint_name(human)) ++j;
        return positions[j];
      };
      worst_deg = std::max(
          worst_deg, worst_limb(position_of, [&](int human) { return shown_at(seen, i, human); }));
    }
    std::printf("VRM %d: worst limb %.4f deg\n", is_old ? 0 : 1, worst_deg);
    EXPECT_LT(worst_deg, kShownAlikeDeg) << is_old;
  }
}

// Where the player leaves the avatar as it rests, the clip stands in a T-pose.
TEST_F(Vrma, the_rest_pose_is_the_t_pose) {
  write("bent.vrma", to_glb(with_turned_rest(read("walk.vrma"), 40)));
  const auto bent = open("bent.vrma"), plain = open("walk.vrma");
  ASSERT_TRUE(bent && plain);
  const auto a = world_positions(bent->rest(), 0), b = world_positions(plain->rest(), 0);
  for (size_t j = 0; j < a.size(); ++j) EXPECT_LT(length(a[j] - b[j]), 1e-5f) << j;
}

TEST_F(Vrma, fingers_come_along) {
  write("hero.glb", to_glb(character()));
  // A thumb that bends in the palm, beside what the motion does with the right index.
  const auto hero = open("hero.glb");
  ASSERT_TRUE(hero);
  Clip clip_of_hero = hero->clip(1);
  for (size_t j = 0; j < clip_of_hero.joints(); ++j) {
    if (clip_of_hero.skeleton.joints[j].name != "LeftHandThumb1") continue;
    for (int f = 0; f < clip_of_hero.frames; ++f) {
      Quat& q = clip_of_hero.pose(f).rotations[j];
      q = normalized(q * axis_angle(Vec3{0, 0, 1}, 0.5f));
    }
  }
  std::vector<double> frames;
  for (int f = 0; f < clip_of_hero.frames; ++f) frames.push_back(f);
  const ClipEdit edit = {1, &clip_of_hero, frames, ""};
  write("hero.glb", hero->encode({&edit, 1}, EditMode::replace));
  must_quietly("convert hero.glb --clip Wave -o wave.vrma");
  const auto wave = open("wave.vrma");
  ASSERT_TRUE(wave);
  const Clip& clip = wave->clip();
  int fingers = 0, bent = 0;
  for (size_t j = 0; j < clip.joints(); ++j) {
    const Joint& joint = clip.skeleton.joints[j];
    const bool finger = joint.parent >= 0 && !find_human_joint(joint.role);
    if (!finger) continue;
    ++fingers;
    // The motion bends the first joint of the right index by 0.6 radians from a second on.
    const float angle = length(log_rotation(clip.pose(45).rotations[j]));
    const float want = joint.role == "rightIndexProximal"    ? 0.6f
                       : joint.role == "leftThumbMetacarpal" ? 0.5f
                                                             : 0.0f;
    EXPECT_NEAR(angle, want, 1e-3f) << joint.role;
    bent += want > 0;
  }
  EXPECT_EQ(fingers, 30);
  EXPECT_EQ(bent, 2);
}

TEST_F(Vrma, the_validator_finds_no_error) {
  write("face.vrma", to_glb(with_expression(read("walk.vrma"))));
  must_quietly("stylize walk.vrma --style old=1 -o old.vrma");
  must_quietly("stylize face.vrma --style old=1 -o old-face.vrma");
  must_quietly("convert walk.vrma -o walk.glb");
  expect_valid_gltf(*this, "walk.vrma old.vrma old-face.vrma walk.glb");
}

TEST_F(Vrma, a_style_takes_the_place_of_the_motion) {
  must_quietly("stylize walk.vrma --style old=1 -o old.vrma");
  const auto walk = open("walk.vrma"), old = open("old.vrma");
  ASSERT_TRUE(walk && old);
  EXPECT_EQ(old->clip_names(), std::vector<std::string>{"walk"});
  EXPECT_FALSE(walk->clip().rotations == old->clip().rotations);
  const Json json = glb_parts(read("old.vrma")).json, before = glb_parts(read("walk.vrma")).json;
  EXPECT_EQ(json["extensions"], before["extensions"]);
  EXPECT_EQ(json["nodes"], before["nodes"]);
}

TEST_F(Vrma, strength_0_is_the_file_itself) {
  write("face.vrma", to_glb(with_expression(read("walk.vrma"))));
  for (const std::string name : {"walk.vrma", "face.vrma"}) {
    must_quietly({"stylize", name, "--style", "old=0", "--force", "-o", "same.vrma"});
    EXPECT_TRUE(glb_parts(read("same.vrma")).json == glb_parts(read(name)).json) << name;
    EXPECT_TRUE(glb_parts(read("same.vrma")).bin == glb_parts(read(name)).bin) << name;
  }
}

TEST_F(Vrma, expressions_and_gaze_are_no_joints_and_follow_the_tempo) {
  write("face.vrma", to_glb(with_expression(read("walk.vrma"))));
  const auto face = open("face.vrma");
  ASSERT_TRUE(face);
  EXPECT_EQ(face->clip().joints(), open("walk.vrma")->clip().joints());
  must_quietly("stylize face.vrma --style old=1 -o old.vrma");
  if (const std::string what = missing_node(); !what.empty()) GTEST_SKIP() << what;
  // The weight at the end is still that of the end, whenever that is.
  const Json before = played("face.vrma"), after = played("old.vrma");
  ASSERT_TRUE(before.is_object() && after.is_object());
  EXPECT_NEAR(before["poses"][1]["weights"]["happy"].get<double>(), 0.4, 1e-6);
  const double stretched = after["seconds"].get<double>() / before["seconds"].get<double>();
  EXPECT_NEAR(after["poses"][1]["weights"]["happy"].get<double>(), 0.4 / stretched, 0.05);
}

TEST_F(Vrma, it_goes_on_a_character_and_to_other_formats) {
  write("hero.glb", to_glb(character()));
  must_quietly("convert walk.vrma -o back.bvh");
  must_quietly("stylize walk.vrma --onto hero.glb --style old=1 -o hero-old.glb");
  const auto walk = open("walk.bvh"), back = open("back.bvh");
  ASSERT_TRUE(walk && back);
  const Rig rig = *Rig::create(walk->clip()), back_rig = *Rig::create(back->clip());
  PosedRig reader(rig), back_reader(back_rig);
  for (int f = 0; f < 31; f += 10) {
    BodyPose a, b;
    reader.read(walk->clip().pose(f), a);
    back_reader.read(back->clip().pose(f), b);
    // Canonical positions, metres; angles in BVH have six decimals of a degree.
    for (int j = 0; j < kHumanJoints; ++j) {
      EXPECT_LT(length(a.positions[j] - b.positions[j]), 1e-3f) << f << human_joint_name(j);
    }
  }
}

TEST_F(Vrma, what_is_none_gets_a_sentence) {
  write("hero.vrma", to_glb(character()));
  expect_rejected("info hero.vrma", 1,
                  "hero.vrma: extensions.VRMC_vrm_animation: expected a humanoid with hips, found "
                  "none; a file without it is a .glb");
}

}  // namespace
}  // namespace panache::test
