// Motion of SMPL and its like: arrays, skeletons, what is written, and that nothing of it hurts.

#include "clip/smpl.h"

#include <cmath>

#include "clip/clip.h"
#include "clip/npy.h"
#include "fixtures.h"
#include "make_clip.h"

namespace panache {
namespace {

using test::world_positions;

constexpr double kQuarter = 1.5707963267948966;

std::string pack(const std::vector<NpzMember>& members) {
  std::string out;
  for (const NpzMember& member : members) out += member.name + "\n" + member.bytes + "\n";
  return out;
}

NpzMember member(const std::string& name, const std::vector<double>& numbers,
                 std::vector<size_t> shape, const std::string& type = "<f8") {
  return {name + ".npy", format_npy(npy_array(numbers, std::move(shape), type))};
}

// Three frames, each of which goes half a metre along x; the left shoulder of the second turns by a
// quarter about z.
std::vector<NpzMember> small_motion(size_t joints = 24, const std::string& type = "<f8") {
  std::vector<double> poses(3 * joints * 3);
  poses[(joints + 16) * 3 + 2] = -kQuarter;
  return {member("poses", poses, {3, joints * 3}, type),
          member("trans", {0, 1, 0, 0.5, 1, 0, 1, 1, 0}, {3, 3}, type),
          member("mocap_framerate", {120}, {}),
          member("betas", {0.5, -1, 2}, {3}),
          member("dmpls", {1, 2, 3, 4, 5, 6}, {3, 2}),
          member("root_orient", std::vector<double>(9), {3, 3}),
          {"gender.npy", format_npy({"<U4", false, {}, std::string(16, 'x')})},
          {"note.txt", "no array"}};
}

std::unique_ptr<MotionFile> must_read(std::vector<NpzMember> members) {
  std::string whole = pack(members);
  auto file = parse_smpl(std::move(members), std::move(whole), pack, "a.npz");
  EXPECT_TRUE(file.ok()) << file.error().message;
  if (!file) return nullptr;
  EXPECT_EQ(broken_promise((*file)->clip()), "");
  return *std::move(file);
}
std::string smpl_rejection(std::vector<NpzMember> members) {
  auto file = parse_smpl(std::move(members), "", pack, "a.npz");
  return file.ok() ? "(accepted)" : file.error().message;
}

// The members of a file that encode() gave, by pack().
std::vector<double> numbers_in(const std::string& bytes, const std::string& array) {
  const size_t at = bytes.find("\n" + array + ".npy\n");
  EXPECT_TRUE(at != std::string::npos || bytes.starts_with(array)) << array;
  const size_t begin = bytes.find('\n', at == std::string::npos ? 0 : at + 1) + 1;
  // Each ends where the next name begins; too many bytes are no array, so shorter and shorter.
  for (size_t end = bytes.find('\n', begin); end != std::string::npos;
       end = bytes.find('\n', end + 1)) {
    const auto read = parse_npy(std::string_view(bytes).substr(begin, end - begin), array);
    if (read) return *npy_numbers(*read, array);
  }
  ADD_FAILURE() << array;
  return {};
}

TEST(SmplSkeleton, the_trees_are_those_that_were_published) {
  // SMPL's kinematic tree, and how SMPL-X goes on: jaw, eyes, then five fingers of three on each
  // wrist.
  const std::vector<int> kBody = {-1, 0, 0, 0, 1,  2,  3,  4,  5,  6,  7,
                                  8,  9, 9, 9, 12, 13, 14, 16, 17, 18, 19};
  for (const size_t joints : {kSmplJoints, kSmplHJoints, kSmplXJoints}) {
    std::vector<int> want = kBody;
    if (joints == kSmplJoints) want.insert(want.end(), {20, 21});
    if (joints == kSmplXJoints) want.insert(want.end(), {15, 15, 15});
    for (const int wrist : {20, 21}) {
      for (int finger = 0; joints != kSmplJoints && finger < 5; ++finger) {
        const int first = static_cast<int>(want.size());
        want.insert(want.end(), {wrist, first, first + 1});
      }
    }
    std::vector<int> got;
    for (const Joint& joint : smpl_skeleton(joints).joints) got.push_back(joint.parent);
    EXPECT_EQ(got, want) << joints;
  }
}

TEST(SmplSkeleton, it_stands_in_t_pose_and_both_sides_are_alike) {
  for (const size_t joints : {kSmplJoints, kSmplHJoints, kSmplXJoints}) {
    const Clip rest = rest_clip(smpl_skeleton(joints));
    const std::vector<Vec3> at = world_positions(rest, 0);
    for (size_t j = 0; j < joints; ++j) {
      const std::string& name = rest.skeleton.joints[j].name;
      if (!name.starts_with("left")) continue;
      for (size_t k = 0; k < joints; ++k) {
        if (rest.skeleton.joints[k].name != "right" + name.substr(4)) continue;
        EXPECT_LT(length(at[j] - Vec3{-at[k].x, at[k].y, at[k].z}), 1e-6f) << name;
      }
      EXPECT_GT(at[j].x, 0.02f) << name;
    }
    EXPECT_GT(at[20].x, 0.6f);                      // The left wrist,
    EXPECT_NEAR(at[20].y, at[16].y, 0.02f);         // as high as its shoulder.
    EXPECT_GT(at[10].z, at[7].z + 0.1f);            // Toes ahead of an ankle.
    EXPECT_NEAR(at[15].y - at[10].y, 1.5f, 0.05f);  // From toes to the joint of the head.
  }
}

TEST(Smpl, rotation_vectors_turn_joints_and_trans_moves_all) {
  for (const size_t joints : {kSmplJoints, kSmplHJoints, kSmplXJoints}) {
    const auto file = must_read(small_motion(joints));
    ASSERT_TRUE(file);
    const Clip& clip = file->clip();
    EXPECT_EQ(clip.joints(), joints);
    EXPECT_EQ(clip.frames, 3);
    EXPECT_DOUBLE_EQ(clip.frame_time, 1.0 / 120);
    const std::vector<Vec3> rest = world_positions(file->rest(), 0),
                            first = world_positions(clip, 0), second = world_positions(clip, 1);
    EXPECT_LT(length(first[15] - rest[15] - Vec3{0, 1, 0}), 1e-6f);
    EXPECT_LT(length(second[15] - rest[15] - Vec3{0.5f, 1, 0}), 1e-6f);
    // From along x to straight down, so is the forearm's way from the shoulder.
    const Vec3 arm = rest[18] - rest[16];
    EXPECT_LT(length(second[18] - second[16] - Vec3{arm.y, -arm.x, arm.z}), 1e-6f);
  }
}

TEST(Smpl, types_and_orders_of_numbers_make_no_difference) {
  const Clip want = must_read(small_motion())->clip();
  EXPECT_EQ(must_read(small_motion(24, "<f4"))->clip().translations, want.translations);
  // Columns first, and bytes the other way round.
  std::vector<NpzMember> members = small_motion();
  NpyArray trans = *parse_npy(members[1].bytes, "");
  std::string turned;
  for (size_t c = 0; c < 3; ++c) {
    for (size_t r = 0; r < 3; ++r) turned += trans.elements.substr((r * 3 + c) * 8, 8);
  }
  trans.by_columns = true;
  trans.elements = turned;
  members[1].bytes = format_npy(trans);
  EXPECT_EQ(must_read(members)->clip().translations, want.translations);
  trans.type = ">f8";
  for (size_t i = 0; i < turned.size(); i += 8) {
    std::reverse(trans.elements.begin() + static_cast<long>(i),
                 trans.elements.begin() + static_cast<long>(i) + 8);
  }
  members[1].bytes = format_npy(trans);
  EXPECT_EQ(must_read(members)->clip().translations, want.translations);
  // A rate in whole numbers, under the name that SMPL-X has for it.
  for (const auto& [type, size] :
       {std::pair("<i4", 4), {"<u4", 4}, {"<i8", 8}, {"<u8", 8}, {"<u2", 2}, {"|i1", 1}}) {
    std::string rate(static_cast<size_t>(size), '\0');
    rate[0] = 120;
    members[2] = {"mocap_frame_rate.npy", format_npy({type, false, {1}, rate})};
    EXPECT_DOUBLE_EQ(must_read(members)->clip().frame_time, 1.0 / 120) << type;
  }
}

// As numpy.save writes them.
TEST(Npy, the_shape_is_written_as_pythons_tuple) {
  const auto shape = [](std::vector<size_t> sizes) {
    const std::string bytes = format_npy(npy_array(std::vector<double>(6), sizes, "<f8"));
    const size_t begin = bytes.find("'shape': ");
    return bytes.substr(begin, bytes.find('}') - begin);
  };
  EXPECT_EQ(shape({6}), "'shape': (6,), ");
  EXPECT_EQ(shape({2, 3}), "'shape': (2, 3), ");
}

TEST(Smpl, whole_numbers_of_every_size_have_their_sign) {
  std::vector<NpzMember> members = small_motion();
  members[1] = member("trans", std::vector<double>(9, -2), {3, 3});
  const Clip want = must_read(members)->clip();
  for (const auto& [type, size] : {std::pair("<i8", 8), {">i4", 4}, {"<i2", 2}, {"|i1", 1}}) {
    std::string number(static_cast<size_t>(size), '\xff');
    (type[0] == '>' ? number.back() : number.front()) = '\xfe';
    std::string elements;
    for (int i = 0; i < 9; ++i) elements += number;
    members[1] = {"trans.npy", format_npy({type, false, {3, 3}, elements})};
    EXPECT_EQ(must_read(members)->clip().translations, want.translations) << type;
  }
}

TEST(Smpl, what_did_not_change_is_the_file_itself) {
  for (const char* type : {"<f8", "<f4"}) {
    const auto file = must_read(small_motion(52, type));
    const std::vector<double> frames = same_frames(3);
    EXPECT_EQ(file->encode(file->clip(), frames), pack(small_motion(52, type)));
    EXPECT_EQ(file->encode({}, EditMode::replace), pack(small_motion(52, type)));
  }
}

TEST(Smpl, a_changed_joint_changes_its_own_numbers_and_what_repeats_them) {
  std::vector<NpzMember> members = small_motion();
  // Angles that a float does not hold: what comes back is not the rotation written again.
  std::vector<double> before(3 * 72);
  for (size_t i = 0; i < before.size(); ++i) before[i] = 0.1 + 0.001 * static_cast<double>(i);
  members[0] = member("poses", before, {3, 72});
  const auto file = must_read(members);
  Clip changed = file->clip();
  for (int f = 0; f < 3; ++f) {
    changed.pose(f).rotations[0] = axis_angle(Vec3{0, 1, 0}, 0.25f);
    changed.pose(f).translations[0] += Vec3{0, 0, 2};
  }
  const std::string out = file->encode(changed, same_frames(3));
  const std::vector<double> poses = numbers_in(out, "poses"), trans = numbers_in(out, "trans");
  ASSERT_EQ(poses.size(), before.size());
  for (size_t i = 0; i < poses.size(); ++i) {
    if (i % 72 >= 3) {
      EXPECT_EQ(poses[i], before[i]);
    } else {
      EXPECT_NEAR(poses[i], i % 72 == 1 ? 0.25 : 0, 1e-7);
    }
  }
  EXPECT_NEAR(trans[2], 2, 1e-6);
  EXPECT_EQ(numbers_in(out, "betas"), (std::vector<double>{0.5, -1, 2}));
  EXPECT_EQ(numbers_in(out, "root_orient"),
            (std::vector<double>{poses[0], poses[1], poses[2], poses[72], poses[73], poses[74],
                                 poses[144], poses[145], poses[146]}));
  EXPECT_EQ(out.find("dmpls"), std::string::npos);
  EXPECT_NE(out.find("no array"), std::string::npos);
}

TEST(Smpl, frames_from_other_times_keep_the_numbers_of_whole_ones) {
  const auto file = must_read(small_motion());
  Clip changed = file->clip();
  changed.resize(2);
  sample(file->clip(), 2, changed.pose(0));
  sample(file->clip(), 0.5, changed.pose(1));
  const std::vector<double> frames = {2, 0.5};
  const std::string out = file->encode(changed, frames);
  const std::vector<double> trans = numbers_in(out, "trans");
  EXPECT_EQ(trans.size(), 6u);
  EXPECT_EQ(trans[0], 1);
  EXPECT_NEAR(trans[3], 0.25, 1e-6);
  EXPECT_NEAR(numbers_in(out, "poses")[72 + 16 * 3 + 2], -kQuarter / 2, 1e-6);
}

TEST(Smpl, the_rate_may_have_any_usual_name) {
  for (const char* name : {"mocap_frame_rate", "fps", "framerate", "frame_rate"}) {
    std::vector<NpzMember> members = small_motion();
    members[2] = member(name, {25}, {});
    EXPECT_EQ(must_read(members)->clip().frame_time, 1.0 / 25) << name;
  }
}

TEST(Smpl, a_rate_that_is_given_takes_the_place_of_one_that_is_wrong_or_missing) {
  const ReadOptions at_50 = {.fps = 50};
  for (const bool missing : {false, true}) {
    std::vector<NpzMember> members = small_motion();
    members[2] = member(missing ? "unrelated" : "mocap_framerate", {0}, {});
    EXPECT_FALSE(parse_smpl(members, pack(members), pack, "a.npz").ok());
    const auto file = parse_smpl(members, pack(members), pack, "a.npz", at_50);
    ASSERT_TRUE(file.ok()) << file.error().message;
    EXPECT_EQ((*file)->clip().frame_time, 1.0 / 50);
    // What is written has it, and all else of the file.
    if (missing) members.emplace_back();
    (missing ? members.back() : members[2]) = member("mocap_framerate", {50}, {});
    EXPECT_EQ((*file)->encode({}, EditMode::replace), pack(members));
    const Clip clip = (*file)->clip();
    EXPECT_EQ((*file)->encode(clip, same_frames(clip.frames)), pack(members));
  }
}

TEST(Smpl, a_new_clip_brings_its_own_rate) {
  const auto file = must_read(small_motion());
  Clip clip = file->clip();
  clip.frame_time = 1.0 / 50;
  clip.resize(2);
  const ClipEdit edits[] = {{kNewClip, &clip, {}, ""}};
  const std::string out = file->encode(edits, EditMode::replace);
  EXPECT_EQ(numbers_in(out, "mocap_framerate"), std::vector<double>{50});
  EXPECT_EQ(numbers_in(out, "trans").size(), 6u);
  EXPECT_EQ(out.find("dmpls"), std::string::npos);
}

TEST(Smpl, a_new_file_stands_on_the_floor_with_z_up) {
  Clip clip = smpl_body();
  clip.frame_time = 0.0333333;
  clip.pose(0).translations[0] = {0.5f, 1, 2};
  const auto file = must_read(format_smpl(clip));
  ASSERT_TRUE(file);
  EXPECT_DOUBLE_EQ(file->clip().frame_time, 1.0 / 30);
  const std::vector<Vec3> want = world_positions(clip, 0), got = world_positions(file->clip(), 0);
  for (size_t j = 0; j < want.size(); ++j) {
    EXPECT_LT(length(got[j] - Vec3{want[j].x, -want[j].z, want[j].y}), 1e-6f) << j;
  }
}

TEST(Smpl, what_is_wrong_is_said) {
  const NpzMember text = {"trans.npy", format_npy({"<U1", false, {1}, "abcd"})};
  const NpzMember objects = {"trans.npy", replaced(text.bytes, "'<U1'", "'|O8'")};
  const NpzMember cut = {"trans.npy", text.bytes.substr(0, text.bytes.size() - 1)};
  const struct {
    size_t which;
    NpzMember instead;
    std::string message;
  } cases[] = {
      {1,
       {"transl.npy", ""},
       "expected an array trans, as in AMASS, found poses, transl, mocap_framerate, betas, dmpls, "
       "root_orient, gender, note.txt"},
      {2,
       {"speed.npy", ""},
       "expected an array mocap_framerate, as in AMASS, found poses, trans, speed, betas, dmpls, "
       "root_orient, gender, note.txt; give its rate"},
      {0, member("poses", std::vector<double>(18), {3, 6}),
       "poses: expected frames of 72 (SMPL), 156 (SMPL-H) or 165 (SMPL-X) numbers, found (3, 6)"},
      {0, member("poses", {}, {0, 72}), "poses: expected 1 to 2083333 frames, found 0"},
      {1, member("trans", {0, 1, 2}, {1, 3}),
       "trans: expected (3, 3), as many frames as poses has, found (1, 3)"},
      {2, member("mocap_framerate", {0}, {}),
       "mocap_framerate: expected a number of frames per second above 0, found 0.000000; give its "
       "rate"},
      {1, member("trans", {NAN, 1, 2}, {1, 3}),
       "trans: expected numbers between -1e9 and 1e9, found one outside or NaN"},
      {1, {"trans.npy", "text"}, "trans: expected an array as numpy.save writes it, found 'text'"},
      {1, text, "trans: expected floats of 4 or 8 bytes or whole numbers, found the type '<U1'"},
      {1, cut, "trans: expected as many bytes as its shape says, found 3"},
      {1, objects, "trans: expected an array of numbers or text, found the type '|O8'"}};
  for (const auto& [which, instead, message] : cases) {
    std::vector<NpzMember> members = small_motion();
    members[which] = instead;
    EXPECT_EQ(smpl_rejection(members), "a.npz: " + message);
  }
  EXPECT_EQ(smpl_rejection({}), "a.npz: expected an array poses, as in AMASS, found none");
}

TEST(SmplSafety, every_truncation_and_every_changed_byte_is_harmless) {
  int accepted = 0, rejected = 0;
  const auto check = [&](std::vector<NpzMember> members) {
    auto file = parse_smpl(members, "", pack, "a.npz");
    ++(file ? accepted : rejected);
    if (file) {
      EXPECT_EQ(broken_promise((*file)->clip()), "");
      Clip changed = (*file)->clip();
      for (Quat& q : changed.rotations) q = Quat{q.w, -q.z, q.y, -q.x};
      (*file)->encode(changed, same_frames(changed.frames));
    } else {
      expect_whole_message(file.error(), "a.npz: ");
    }
  };
  const std::vector<NpzMember> good = small_motion();
  for (size_t m = 0; m < good.size(); ++m) {
    // Of the numbers of the poses the first will do; the headers are the rest.
    const size_t size = std::min<size_t>(good[m].bytes.size(), 200);
    for (size_t i = 0; i < size; ++i) {
      std::vector<NpzMember> spoilt = good;
      spoilt[m].bytes.resize(i);
      check(spoilt);
      for (const int value : {0, 0x39, 0x28, 0x2c, 0x7f, 0xff}) {
        spoilt = good;
        spoilt[m].bytes = with_byte(good[m].bytes, i, value);
        check(spoilt);
      }
    }
  }
  EXPECT_GT(accepted, 500);
  EXPECT_GT(rejected, 500);
}

TEST(SmplSafety, an_announced_flood_is_rejected_before_memory_is_taken) {
  std::vector<NpzMember> members = small_motion();
  const std::string good = members[0].bytes;
  for (const char* shape : {"(99999999999999, 72)", "(4294967296, 4294967296)",
                            "(1125899906842624, 1125899906842624, 16384)"}) {
    members[0].bytes = replaced(good, "(3, 72)", shape);
    EXPECT_NE(smpl_rejection(members), "(accepted)");
  }
}

}  // namespace
}  // namespace panache
