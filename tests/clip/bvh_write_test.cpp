#include <cmath>
#include <random>

#include "clip/euler.h"
#include "fixtures.h"

namespace panache {
namespace {

// All words of a text.
std::vector<std::string> words(const std::string& text) {
  std::vector<std::string> out(1);
  for (const char c : text) {
    const bool space = c == ' ' || c == '\t' || c == '\r' || c == '\n';
    if (!space) {
      out.back() += c;
    } else if (!out.back().empty()) {
      out.emplace_back();
    }
  }
  if (out.back().empty()) out.pop_back();
  return out;
}

std::string encode_same(const MotionFile& file) {
  return file.encode(file.clip(), same_frames(file.clip().frames));
}

// One joint with the channels ZXY and the angles given, 6 decimals.
std::string one_joint(const std::vector<EulerAngles>& frames) {
  std::string text =
      "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\nCHANNELS 3 Zrotation Xrotation Yrotation\n}\nMOTION\n"
      "Frames: " +
      std::to_string(frames.size()) + "\nFrame Time: 0.1\n";
  for (const EulerAngles& f : frames) {
    text += std::to_string(f[0]) + " " + std::to_string(f[1]) + " " + std::to_string(f[2]) + "\n";
  }
  return text;
}

// The angles that one_joint() wrote.
std::vector<EulerAngles> angles_of(const std::string& text) {
  std::vector<EulerAngles> out;
  const auto all = words(text.substr(text.find("Frame Time:")));
  for (size_t i = 3; i + 3 <= all.size(); i += 3) {
    out.push_back({std::stod(all[i]), std::stod(all[i + 1]), std::stod(all[i + 2])});
  }
  return out;
}

// The file with the rotation of frame i turned by turn(i) on the left, written.
template <class Turn>
std::vector<EulerAngles> turned(const std::vector<EulerAngles>& frames, Turn turn) {
  const auto file = must_parse(one_joint(frames));
  Clip clip = file->clip();
  for (int i = 0; i < clip.frames; ++i) {
    Quat& q = clip.pose(i).rotations[0];
    q = normalized(turn(i) * q);
  }
  const std::string text = file->encode(clip, same_frames(clip.frames));
  const auto back = must_parse(text);
  for (int i = 0; i < clip.frames; ++i) {
    // Three angles rounded to 5e-7 degrees, and the float's own 2e-7 radians twice.
    EXPECT_LT(angle_between(back->clip().rotations[static_cast<size_t>(i)],
                            clip.rotations[static_cast<size_t>(i)]),
              1e-6);
  }
  return angles_of(text);
}

TEST(BvhWriting, an_unchanged_file_comes_back_byte_for_byte) {
  for (const char* fixture : kBvhFixtures) {
    const std::string text = read_fixture(fixture);
    for (const std::string& variant :
         {text, replaced_all(text, '\n', "\r\n"), replaced_all(text, '\n', "\r"),
          replaced_all(text, '\n', " \t\n\n"), "\xef\xbb\xbf" + text, text + "\n \n"}) {
      const auto file = must_parse(variant);
      ASSERT_TRUE(file);
      EXPECT_EQ(encode_same(*file), variant);
    }
  }
}

TEST(BvhWriting, a_wrong_count_and_a_cut_row_stay_while_the_file_does) {
  const std::string plain = read_fixture("plain.bvh");
  for (const char* count : {"Frames: 1", "Frames: 3", "Frames: 44"}) {
    for (const char* cut : {"", "1 2 3", "1 2 3\r\n"}) {
      const std::string text = replaced(plain, "Frames: 3", count) + cut;
      const auto file = must_parse(text);
      EXPECT_EQ(encode_same(*file), text);
      EXPECT_EQ(file->encode({}, EditMode::replace), text);
      // With a change, the result is a sound file.
      Clip clip = file->clip();
      clip.pose(1).translations[0].x += 1;
      const auto back = must_parse(file->encode(clip, same_frames(3)));
      EXPECT_EQ(back->clip().frames, 3);
      EXPECT_EQ(back->notes(), std::vector<std::string>{});
      clip.resize(2);
      EXPECT_EQ(must_parse(file->encode(clip, same_frames(2)))->notes(),
                std::vector<std::string>{});
    }
  }
}

TEST(BvhWriting, frames_may_be_left_out_repeated_and_reordered) {
  const std::string text = read_fixture("plain.bvh");
  const auto file = must_parse(text);
  const size_t table = text.find("0.100000 93");
  std::vector<std::string> lines;
  for (size_t at = table; at < text.size(); at = text.find('\n', at) + 1) {
    lines.push_back(text.substr(at, text.find('\n', at) + 1 - at));
  }
  for (const std::vector<double>& order :
       std::vector<std::vector<double>>{{1}, {2, 1, 0}, {0, 0, 1, 1, 2, 2, 2}, {2, 2}}) {
    Clip clip = file->clip();
    clip.resize(static_cast<int>(order.size()));
    std::string expected =
        replaced(text.substr(0, table), "Frames: 3", "Frames: " + std::to_string(order.size()));
    for (size_t i = 0; i < order.size(); ++i) {
      sample(file->clip(), order[i], clip.pose(static_cast<int>(i)));
      expected += lines[static_cast<size_t>(order[i])];
    }
    // The line before the end of a file may lack its line end; in between each line has one.
    EXPECT_EQ(file->encode(clip, order), expected);
  }
}

TEST(BvhWriting, the_only_frame_of_a_file_without_a_last_line_end_may_be_repeated) {
  for (const std::string line_end : {"\n", "\r\n", "\r"}) {
    std::string text = replaced_all(one_joint({{1, 2, 3}}), '\n', line_end);
    text.resize(text.size() - line_end.size());
    const auto file = must_parse(text);
    Clip clip = file->clip();
    clip.resize(2);
    sample(file->clip(), 0, clip.pose(1));
    EXPECT_EQ(file->encode(clip, std::vector<double>{0, 0}),
              replaced(text, "Frames: 1", "Frames: 2") + line_end + "1.000000 2.000000 3.000000");
  }
}

TEST(BvhWriting, only_the_changed_joint_gets_new_numbers) {
  const std::string text = read_fixture("odd.bvh");
  const auto file = must_parse(text);
  Clip clip = file->clip();
  clip.pose(0).rotations[3] = normalized(rotation_y(0.01f) * clip.pose(0).rotations[3]);
  clip.pose(1).translations[2].y = 21.5f;
  const std::string out = file->encode(clip, same_frames(2));
  // Y X Z: a turn of 0.01 radians (0.57296 degrees) about y goes into the first angle alone. The
  // file uses at most one decimal, so four are written; spaces stay.
  EXPECT_EQ(out, replaced(replaced(text, "30 40 50", "30.5730 40.0000 50.0000"), "-3 10 20 .5 5.",
                          "-3 10 20 .5 21.5000"));
}

TEST(BvhWriting, a_translation_without_a_channel_is_the_offset) {
  const std::string text = read_fixture("odd.bvh");
  const auto file = must_parse(text);
  Clip clip = file->clip();
  clip.pose(0).translations[0].x = 77;  // The joint has Zposition only.
  clip.pose(0).rotations[1] = rotation_y(1.0f);
  EXPECT_EQ(file->encode(clip, same_frames(2)), text);
}

TEST(BvhWriting, fewer_than_three_rotations_take_what_they_can) {
  const auto file = must_parse(read_fixture("odd.bvh"));
  Clip clip = file->clip();
  const Quat twist = rotation_y(0.5f), swing = axis_angle(Vec3{1, 0, 0}, 0.3f);
  clip.pose(0).rotations[0] = normalized(twist * swing);  // Only Yrotation can be written.
  const auto back = must_parse(file->encode(clip, same_frames(2)));
  // Four decimals of a degree are 9e-7 radians.
  EXPECT_LT(angle_between(back->clip().pose(0).rotations[0], twist), 2e-6);
}

TEST(BvhWriting, a_frame_between_two_is_written_with_the_files_decimals) {
  const std::string text = read_fixture("plain.bvh");
  const auto file = must_parse(text);
  Clip clip = file->clip();
  clip.resize(1);
  sample(file->clip(), 0.25, clip.pose(0));
  const std::string out = file->encode(clip, std::vector<double>{0.25});
  // Xrotation and Yrotation of the leg stand still, but its rotation as a whole does not.
  EXPECT_NE(out.find("\n0.125000 93.025002 -4.175000 1.12"), std::string::npos) << out;
  const auto back = must_parse(out);
  for (size_t j = 0; j < 3; ++j) {
    EXPECT_LT(angle_between(back->clip().rotations[j], clip.rotations[j]), 1e-6);
  }
}

TEST(BvhWriting, no_new_wraps_appear) {
  // The file winds through 180 without a wrap, and comes back; the change is a turn by a right
  // angle.
  std::vector<EulerAngles> frames;
  for (int i = 0; i < 200; ++i) frames.push_back({0, 10, 400 * std::sin(i * 0.0314)});
  const auto out = turned(frames, [](int) { return rotation_y(1.5f); });
  for (size_t i = 1; i < out.size(); ++i) {
    for (size_t k = 0; k < 3; ++k) EXPECT_LT(std::abs(out[i][k] - out[i - 1][k]), 40) << i;
  }
}

TEST(BvhWriting, half_a_turn_away_from_the_file_there_are_no_wraps_either) {
  // A turn about z by 174 to 186 degrees: what is nearest to the file's own angle is now +180, now
  // -180, so a choice frame by frame would flicker.
  std::vector<EulerAngles> frames;
  for (int i = 0; i < 200; ++i) frames.push_back({5 * std::sin(i * 0.3), 3 * std::cos(i * 0.7), 0});
  const auto out = turned(frames, [](int i) {
    return axis_angle(Vec3{0, 0, 1}, 3.14159f + 0.1f * std::sin(0.5f * static_cast<float>(i)));
  });
  for (size_t i = 1; i < out.size(); ++i) {
    for (size_t k = 0; k < 3; ++k) EXPECT_LT(std::abs(out[i][k] - out[i - 1][k]), 20) << i;
  }
}

TEST(BvhWriting, the_files_own_wraps_stay) {
  std::vector<EulerAngles> frames;
  for (int i = 0; i < 100; ++i) {
    const double y = std::remainder(i * 10.0, 360.0);
    frames.push_back({0, 10, y});
  }
  const auto out = turned(frames, [](int) { return rotation_y(0.1f); });
  ASSERT_EQ(out.size(), frames.size());
  for (size_t i = 0; i < out.size(); ++i) {
    for (size_t k = 0; k < 3; ++k) EXPECT_NEAR(out[i][k], frames[i][k], 8) << i;
  }
}

TEST(BvhWriting, at_the_pole_the_angles_stay_with_the_file) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> noise(-1e-6, 1e-6);
  std::vector<EulerAngles> frames;
  for (int i = 0; i < 100; ++i) frames.push_back({20, 90 + noise(random), 50 + 0.1 * i});
  // A turn about y after which the pole is still the pole: R = Rz Rx Ry, and at x = 90 only z + y
  // counts, so a turn about the file's y axis on the right goes into any mixture of both.
  const auto file = must_parse(one_joint(frames));
  Clip clip = file->clip();
  for (Quat& q : clip.rotations) q = normalized(q * rotation_y(0.2f));
  const auto out = angles_of(file->encode(clip, same_frames(clip.frames)));
  for (size_t i = 0; i < out.size(); ++i) EXPECT_NEAR(out[i][0], 20, 0.01) << i;
  for (size_t i = 1; i < out.size(); ++i) EXPECT_NEAR(out[i][2] - out[i - 1][2], 0.1, 0.01) << i;
}

TEST(BvhWriting, too_large_and_non_finite_numbers_still_make_a_file) {
  const auto file = must_parse(read_fixture("plain.bvh"));
  Clip clip = file->clip();
  clip.pose(0).translations[0] = {NAN, INFINITY, -3e30f};
  clip.pose(1).rotations[1] = {NAN, NAN, NAN, NAN};
  EXPECT_EQ(broken_promise(must_parse(file->encode(clip, same_frames(3)))->clip()), "");
}

}  // namespace
}  // namespace panache
