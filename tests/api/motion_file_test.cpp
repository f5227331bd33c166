// Motion files in memory.
#include "stick_api.h"

namespace {

using panache::test::created;
using panache::test::Owned;
using panache::test::rejection;
using panache::test::text_of;
using panache::test::walk_bvh;

constexpr int kFrames = 60;

using File = Owned<panache_motion_file>;

File open(const std::string& bytes, const char* name = "walk.bvh") {
  return created<panache_motion_file>([&](auto** out) {
    return panache_motion_file_create(bytes.data(), bytes.size(), name, out);
  });
}

panache_clip clip_of(const File& file, int32_t clip = 0) {
  panache_clip out{};
  EXPECT_EQ(panache_motion_file_get_clip(file.get(), clip, &out), PANACHE_OK)
      << panache_last_error();
  return out;
}

std::string write(const File& file, const panache_clip_edit& edit) {
  return text_of(created<panache_bytes>([&](auto** out) {
    return panache_motion_file_write(file.get(), &edit, 1, PANACHE_REPLACE, out);
  }));
}

class MotionFileApi : public panache::test::StickApi {};

TEST_F(MotionFileApi, a_file_tells_its_joints_and_motions) {
  const File file = open(walk_bvh(kFrames));
  ASSERT_EQ(panache_motion_file_joint_count(file.get()), STICK_JOINTS);
  panache_joint joint;
  panache_motion_file_get_joint(file.get(), 14, &joint);
  EXPECT_STREQ(joint.name, "LeftToes");
  EXPECT_EQ(joint.parent, 13);
  EXPECT_EQ(joint.rotation[3], 1);
  EXPECT_EQ(joint.translation[2], 14);
  EXPECT_EQ(panache_motion_file_clip_count(file.get()), 1);
  EXPECT_STREQ(panache_motion_file_clip_name(file.get(), 0), "");
  EXPECT_EQ(panache_motion_file_clip_name(file.get(), 1), nullptr);
  EXPECT_EQ(panache_motion_file_clip_name(file.get(), -1), nullptr);
  const panache_clip clip = clip_of(file);
  EXPECT_EQ(clip.frame_count, kFrames);
  EXPECT_EQ(clip.frame_seconds, 0.016667);
  stick_pose pose;
  stick_walk(9 / 60.0, 0, &pose);
  for (int k = 0; k < 4; ++k) {  // Degrees have six digits in the file.
    EXPECT_NEAR(clip.rotations[4 * (9 * STICK_JOINTS + 11) + k], pose.rotations[11][k], 1e-6);
  }
  const panache_clip rest = clip_of(file, -1);
  EXPECT_EQ(rest.frame_count, 1);
  EXPECT_EQ(rest.rotations[4 * 11 + 3], 1);
}

TEST_F(MotionFileApi, what_is_not_changed_keeps_its_bytes) {
  const std::string text = walk_bvh(kFrames);
  const File file = open(text);
  panache_clip_edit edit = {0, nullptr, clip_of(file), nullptr};
  EXPECT_EQ(write(file, edit), text);
  std::vector<double> twice;  // Each frame two times: other frames, the same lines.
  std::vector<float> rotations, translations;
  for (int f = 0; f < 2 * kFrames; ++f) {
    const panache_clip& from = edit.frames;
    twice.push_back(f / 2);
    const float* q = from.rotations + 4 * STICK_JOINTS * (f / 2);
    const float* v = from.translations + 3 * STICK_JOINTS * (f / 2);
    rotations.insert(rotations.end(), q, q + 4 * STICK_JOINTS);
    translations.insert(translations.end(), v, v + 3 * STICK_JOINTS);
  }
  edit.frames = {nullptr, 2 * kFrames, edit.frames.frame_seconds, rotations.data(),
                 translations.data()};
  edit.source_frames = twice.data();
  const std::string written = write(file, edit);
  std::istringstream lines(text.substr(text.find("Frame Time"))),
      doubled(written.substr(written.find("Frame Time")));
  std::string line, first, second;
  std::getline(lines, line), std::getline(doubled, first);
  for (int f = 0; f < kFrames; ++f) {
    std::getline(lines, line), std::getline(doubled, first), std::getline(doubled, second);
    EXPECT_EQ(first, line) << f;
    EXPECT_EQ(second, line) << f;
  }
}

TEST_F(MotionFileApi, a_motion_is_styled_and_written) {
  const File file = open(walk_bvh(kFrames));
  const auto skeleton = created<panache_skeleton>(
      [&](auto** out) { return panache_motion_file_create_skeleton(file.get(), 0, nullptr, out); });
  EXPECT_EQ(panache_skeleton_find(skeleton.get(), "leftToes"), 14);
  panache_clip clip = clip_of(file);
  clip.skeleton = skeleton.get();
  const auto styled = stylize(clip, "old");
  const int32_t frames = panache_styled_clip_frame_count(styled.get());
  const panache_clip_edit edit = {
      0,
      "old",
      {nullptr, frames, clip.frame_seconds, panache_styled_clip_rotations(styled.get()),
       panache_styled_clip_translations(styled.get())},
      panache_styled_clip_source_frames(styled.get())};
  const File written = open(write(file, edit));
  const panache_clip again = clip_of(written);
  ASSERT_EQ(again.frame_count, frames);
  double difference = 0, change = 0;
  for (int i = 0; i < 4 * STICK_JOINTS; ++i) {
    const int at = 4 * STICK_JOINTS * (frames - 1) + i;
    difference = std::max<double>(
        difference, std::abs(std::abs(again.rotations[at]) - std::abs(edit.frames.rotations[at])));
    change = std::max<double>(change, std::abs(again.rotations[at] - clip.rotations[at % 1000]));
  }
  EXPECT_LT(difference, 1e-5);  // Of six digits of a degree, and of a float.
  EXPECT_GT(change, 0.05);
}

TEST_F(MotionFileApi, a_new_motion_takes_the_place_of_a_bvh_files_own) {
  const File file = open(walk_bvh(kFrames));
  panache_clip frames = clip_of(file);
  frames.frame_count = 5;
  frames.frame_seconds = 0.05;
  const panache_clip again = clip_of(open(write(file, {-1, "new", frames, nullptr})));
  EXPECT_EQ(again.frame_count, 5);
  EXPECT_EQ(again.frame_seconds, 0.05);
}

std::string rejection_of(const std::string& bytes, const char* name) {
  return rejection<panache_motion_file>(PANACHE_BAD_FILE, [&](auto** out) {
    return panache_motion_file_create(bytes.data(), bytes.size(), name, out);
  });
}
const std::string kHinge =
    "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\nCHANNELS 1 Xrotation\nEnd Site\n{\nOFFSET 0 1 0\n}\n}\n"
    "MOTION\nFrames: 1\nFrame Time: 0.1\n0\n";

TEST_F(MotionFileApi, what_is_wrong_with_a_file_is_said) {
  const std::string expected =
      "expected a motion file (.bvh, .glb, .gltf, .vrm, .vrma, .amc, .fbx), found ";
  EXPECT_EQ(rejection_of(walk_bvh(1), "walk"), "walk: " + expected + "no extension");
  EXPECT_EQ(rejection_of(walk_bvh(1), "walk.c3d"),
            "walk.c3d: " + expected + "the extension '.c3d'");
  EXPECT_TRUE(rejection_of("HIERARCHY\nROOF", "a.BVH").starts_with("a.BVH:2:1"));
  const auto no_skeleton = [](panache_status status, const std::string& bytes, int32_t clip,
                              const panache_skeleton_options* options = nullptr) {
    return rejection<panache_skeleton>(status, [&](auto** out) {
      return panache_motion_file_create_skeleton(open(bytes).get(), clip, options, out);
    });
  };
  EXPECT_TRUE(no_skeleton(PANACHE_BAD_SKELETON, kHinge, 0).starts_with("walk.bvh: "));
  EXPECT_EQ(no_skeleton(PANACHE_BAD_ARGUMENT, kHinge, 1),
            "walk.bvh: there is no motion 1; it has 1");
  const panache_skeleton_options zeros{};
  no_skeleton(PANACHE_BAD_ARGUMENT, walk_bvh(1), 0, &zeros);
}

TEST_F(MotionFileApi, an_error_kind_tells_a_missing_rate_from_a_damaged_file) {
  std::string no_rate = kHinge;
  no_rate.replace(no_rate.find("0.1\n"), 3, "0");
  rejection_of(no_rate, "a.bvh");
  EXPECT_EQ(panache_last_error_kind(), PANACHE_ERROR_RATE_NEEDED) << panache_last_error();
  rejection_of("x", "a.bvh");
  EXPECT_EQ(panache_last_error_kind(), PANACHE_ERROR_OTHER) << panache_last_error();
}

// Bytes of no character are replaced in what is shown, and stay in the file.
TEST_F(MotionFileApi, names_and_messages_are_utf_8_whatever_the_bytes_of_a_file_are) {
  std::string text = walk_bvh(kFrames);
  text.replace(text.find("LeftToes"), 8, "Left\xfcToes");
  text.replace(text.find("Frames: "), 9, "Frames: 9");
  const File file = open(text, "w\xe4lk.bvh");
  panache_joint joint;
  panache_motion_file_get_joint(file.get(), 14, &joint);
  EXPECT_STREQ(joint.name, "Left\xef\xbf\xbdToes");
  EXPECT_EQ(write(file, {0, nullptr, clip_of(file), nullptr}), text);
  const std::string note = text_of(created<panache_bytes>(
      [&](auto** out) { return panache_motion_file_get_notes(file.get(), out); }));
  EXPECT_TRUE(note.starts_with("w\xef\xbf\xbdlk.bvh:")) << note;
  const std::string message = rejection_of("HIERARCHY\nROOT \xff x", "r\xf6t.bvh");
  EXPECT_TRUE(message.starts_with("r\xef\xbf\xbdt.bvh:")) << message;
  EXPECT_EQ(message.find_first_of("\xff\xf6"), std::string::npos) << message;
}

TEST_F(MotionFileApi, a_vrm_animation_takes_one_edit) {
  const std::string bytes = R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}],
    "nodes": [{"name": "hips"}], "extensions": {"VRMC_vrm_animation": {"specVersion": "1.0",
      "humanoid": {"humanBones": {"hips": {"node": 0}}}}},
    "animations": [{"channels": [{"sampler": 0, "target": {"node": 0, "path": "rotation"}}],
      "samplers": [{"input": 0, "output": 1}]}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 2, "type": "SCALAR"},
      {"bufferView": 1, "componentType": 5126, "count": 2, "type": "VEC4"}],
    "bufferViews": [{"buffer": 0, "byteLength": 8},
      {"buffer": 0, "byteOffset": 8, "byteLength": 32}],
    "buffers": [{"byteLength": 40, "uri": "data:application/octet-stream;base64,AAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAAAAAAAAAAAAAAAAACAPw=="}]})";
  const File file = open(bytes, "walk.vrma");
  panache_clip_edit edit{};
  edit.frames = clip_of(file);
  const panache_clip_edit edits[] = {edit, edit};
  EXPECT_EQ(rejection<panache_bytes>(PANACHE_BAD_ARGUMENT,
                                     [&](auto** out) {
                                       return panache_motion_file_write(file.get(), edits, 2,
                                                                        PANACHE_ADD_LAST, out);
                                     }),
            "walk.vrma: 2 edits; expected 1, as a VRMA file holds one motion");
}

TEST_F(MotionFileApi, what_is_wrong_with_an_edit_is_said) {
  const File file = open(walk_bvh(kFrames));
  const panache_clip clip = clip_of(file);
  const auto message = [&](std::vector<panache_clip_edit> edits, int mode = 0) {
    return rejection<panache_bytes>(PANACHE_BAD_ARGUMENT, [&](auto** out) {
      return panache_motion_file_write(file.get(), edits.data(), static_cast<int32_t>(edits.size()),
                                       static_cast<panache_edit_mode>(mode), out);
    });
  };
  const panache_clip_edit good = {0, nullptr, clip, nullptr};
  EXPECT_EQ(message({good}, 3), "there is no edit mode 3; expected 0 to 2");
  EXPECT_EQ(message({}), "walk.bvh: 0 edits; expected 1, as a BVH file holds one motion");
  EXPECT_EQ(message({good, good}), "walk.bvh: 2 edits; expected 1, as a BVH file holds one motion");
  panache_clip_edit edit = good;
  edit.clip = 2;
  EXPECT_EQ(message({edit}), "walk.bvh: there is no motion 2; it has 1");
  edit = good;
  edit.frames.frame_count = 0;
  EXPECT_EQ(message({edit}), "edit 0: has no frames");
  edit = good;
  edit.frames.frame_count = 7;
  EXPECT_EQ(message({edit}), "edit 0: has 7 frames and no source_frames; the motion has 60");
  const std::vector<double> late(7, 60.0);
  edit.source_frames = late.data();
  EXPECT_EQ(message({edit}), "edit 0: source frame 0 is 60.000000; expected 0 to 59");
  edit = good;
  edit.frames.frame_seconds = 0.5;
  EXPECT_EQ(message({edit}),
            "edit 0: has frames 0.500000 seconds apart; those of the motion are 0.016667");
  std::vector<float> rotations(clip.rotations, clip.rotations + 4 * kFrames * STICK_JOINTS);
  rotations[4 * STICK_JOINTS + 3] = NAN;
  edit = good;
  edit.frames.rotations = rotations.data();
  EXPECT_EQ(message({edit}),
            "edit 0: frames: pose 1, joint 0: its rotation is not a unit quaternion (x, y, z, w)");
}

}  // namespace
