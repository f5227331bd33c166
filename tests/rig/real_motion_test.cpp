// Every rig and every frame of real motion that is at hand.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "clip/clip.h"
#include "clip/motion_file.h"
#include "rig/rig_checks.h"

namespace panache {
namespace {

using namespace test;
namespace fs = std::filesystem;

std::vector<fs::path> motion_files(const std::string& folder) {
  std::vector<fs::path> out;
  const char* data = std::getenv("PANACHE_DATA");
  if (!data || !fs::exists(fs::path(data) / folder)) return out;
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(data) / folder)) {
    if (entry.path().extension() == ".bvh") out.push_back(entry.path());
  }
  std::sort(out.begin(), out.end());
  return out;
}

struct Loaded {
  std::unique_ptr<MotionFile> file;
  Rig rig;
};

std::optional<Loaded> load(const fs::path& path) {
  auto file = read_motion(path.string());
  if (!file) {
    ADD_FAILURE() << file.error().message;
    return std::nullopt;
  }
  auto rig = Rig::create((*file)->clip());
  if (!rig) {
    ADD_FAILURE() << path << ": " << rig.error().message;
    return std::nullopt;
  }
  return Loaded{*std::move(file), *std::move(rig)};
}

// Calls visit(path, loaded) for every file of all sets that can be loaded.
template <class Visit>
void for_each_file(const Visit& visit) {
  for (const char* folder : {"bandai-1", "xia", "formats"}) {
    for (const fs::path& path : motion_files(folder)) {
      if (auto loaded = load(path)) visit(path, *loaded);
    }
  }
}

// The joints' names in order, '-' for a missing one.
std::string names(const Rig& rig) {
  std::string out;
  for (const JointMatch& match : rig.matches()) {
    out += (out.empty() ? "" : " ") + (match.joint.empty() ? std::string("-") : match.joint);
  }
  return out;
}

// What the files of a folder must map to; `end` distinguishes files of one folder.
struct Known {
  const char* folder;
  const char* start;  // Of the file's name.
  const char* up;
  const char* joints;
};

constexpr const char* kCmu =
    "Hips Spine Spine1 Neck1 Head LeftShoulder LeftArm LeftForeArm LeftHand RightShoulder RightArm "
    "RightForeArm RightHand LeftUpLeg LeftLeg LeftFoot LeftToeBase RightUpLeg RightLeg RightFoot "
    "RightToeBase";
constexpr Known kKnown[] = {
    {"bandai-1", "", "+Y",
     "Hips Spine Chest Neck Head Shoulder_L UpperArm_L LowerArm_L Hand_L Shoulder_R UpperArm_R "
     "LowerArm_R Hand_R UpperLeg_L LowerLeg_L Foot_L Toes_L UpperLeg_R LowerLeg_R Foot_R Toes_R"},
    {"xia", "", "+Y", kCmu},
    {"formats/cmu", "", "+Y", kCmu},
    {"formats/cmu21", "", "+Y", kCmu},
    {"formats/daz", "", "+Y",
     "hip abdomen chest neck head lCollar lShldr lForeArm lHand rCollar rShldr rForeArm rHand "
     "lThigh lShin lFoot - rThigh rShin rFoot -"},
    {"formats/max", "", "+Y",
     "Hips Chest Chest2 Neck Head LeftCollar LeftShoulder LeftElbow LeftWrist RightCollar "
     "RightShoulder RightElbow RightWrist LeftHip LeftKnee LeftAnkle LeftToe RightHip RightKnee "
     "RightAnkle RightToe"},
    {"formats/other", "Anthro", "+Y", kCmu},
    {"formats/other", "Robot", "+Y", kCmu},
    {"formats/other", "ad_", "+Z",
     "Hips Spine2 Spine3 Neck Head LeftShoulder LeftArm LeftForeArm LeftHand RightShoulder "
     "RightArm "
     "RightForeArm RightHand LeftUpLeg LeftLeg LeftFoot LeftToeBase RightUpLeg RightLeg RightFoot "
     "RightToeBase"},
    {"formats/other", "olaf_test", "+Y",
     "Hips Chest Chest2 Neck Head LeftCollar LeftShoulder LeftElbow LeftWrist RightCollar "
     "RightShoulder RightElbow RightWrist LeftHip LeftKnee LeftAnkle - RightHip RightKnee "
     "RightAnkle -"},
    {"formats/other", "olaf_walk", "+Y",
     "Hips Spine Spine1 Neck Head LeftShoulder LeftArm LeftForeArm LeftHand RightShoulder RightArm "
     "RightForeArm RightHand LeftUpLeg LeftLeg LeftFoot - RightUpLeg RightLeg RightFoot -"},
    {"formats/other", "pybvh", "+Z",
     "Hips Spine2 Spine3 Neck1 Head LeftShoulder LeftArm LeftForeArm LeftHand RightShoulder "
     "RightArm RightForeArm RightHand LeftUpLeg LeftLeg LeftFoot LeftToeBase RightUpLeg RightLeg "
     "RightFoot RightToeBase"},
};

// CMU's takes begin with a T-pose, but for 02_01; DAZ's too.
int known_first_frame(const fs::path& path) {
  const std::string folder = path.parent_path().filename();
  return (folder == "cmu" && path.filename() != "02_01.bvh") || folder == "daz";
}

TEST(RealMotion, every_file_maps_as_a_person_would_map_it) {
  size_t seen = 0;
  for (const Known& known : kKnown) {
    for (const fs::path& path : motion_files(known.folder)) {
      if (!path.filename().string().starts_with(known.start)) continue;
      const auto loaded = load(path);
      if (!loaded) continue;
      EXPECT_EQ(names(loaded->rig), known.joints) << path;
      EXPECT_EQ(loaded->rig.up_axis(), known.up) << path;
      EXPECT_EQ(loaded->rig.first_frame(), known_first_frame(path)) << path;
      ++seen;
    }
  }
  if (seen == 0) GTEST_SKIP() << "PANACHE_DATA names no folder with real motion.";
  EXPECT_EQ(seen, motion_files("bandai-1").size() + motion_files("xia").size() +
                      motion_files("formats").size());
}

// Joints that only the name tells from others at the same place, or beyond the end of a limb.
bool same_address(const Clip& clip, int a, int b) {
  if (a == b) return true;
  if (a < 0 || b < 0) return false;
  std::vector<Quat> rotations(clip.joints());
  std::vector<Vec3> at(clip.joints());
  world_pose(clip.skeleton, clip.pose(clip.frames / 2), {rotations, at});
  return length(at[a] - at[b]) < 1e-4f * length(at[0] - at[a]);
}

TEST(RealMotion, every_file_maps_the_same_when_its_joints_have_no_names) {
  size_t seen = 0;
  for_each_file([&](const fs::path& path, const Loaded& loaded) {
    const Clip& clip = loaded.file->clip();
    const Anonymous nameless = anonymous(clip, static_cast<unsigned>(++seen));
    const auto rig = Rig::create(nameless.clip);
    EXPECT_TRUE(rig.ok()) << path << ": " << rig.error().message;
    for (int j = 0; rig && j < kHumanJoints; ++j) {
      const int got = rig->joints()[j] < 0 ? -1 : nameless.order[rig->joints()[j]];
      const int want = loaded.rig.joints()[j];
      EXPECT_TRUE(same_address(clip, want, got))
          << path << " " << human_joint_name(j) << ": " << want << " but " << got;
    }
  });
  if (seen == 0) GTEST_SKIP() << "PANACHE_DATA names no folder with real motion.";
}

TEST(RealMotion, every_frame_of_every_file_survives_reading_and_writing) {
  long frames = 0;
  Deviation worst;
  std::mt19937 random(1);
  for_each_file([&](const fs::path& path, const Loaded& loaded) {
    const Clip& clip = loaded.file->clip();
    PosedRig rig(loaded.rig);
    PoseBuffer out(clip.joints());
    for (int f = 0; f < clip.frames; ++f, ++frames) {
      ASSERT_TRUE(unchanged(rig, clip.pose(f), out.pose())) << path << " frame " << f;
      if (f % 10) continue;
      BodyPose body;
      rig.read(clip.pose(f), body);
      expect_canonical(body);
      const BodyChange change = random_change(random);
      const Deviation off = deviation(rig, clip, clip.pose(f), change, out.pose());
      worst.limb_deg = std::max(worst.limb_deg, off.limb_deg);
      worst.rotation_deg = std::max(worst.rotation_deg, off.rotation_deg);
      worst.mid_hip = std::max(worst.mid_hip, off.mid_hip);
    }
  });
  if (frames == 0) GTEST_SKIP() << "PANACHE_DATA names no folder with real motion.";
  std::printf("%ld frames; largest deviations: limbs %.1e deg, rotations %.1e deg, hips %.1e m\n",
              frames, worst.limb_deg, worst.rotation_deg, worst.mid_hip);
  EXPECT_LT(worst.limb_deg, 1e-3);
  EXPECT_LT(worst.rotation_deg, 1e-3);
  EXPECT_LT(worst.mid_hip, 1e-4);
}

}  // namespace
}  // namespace panache
