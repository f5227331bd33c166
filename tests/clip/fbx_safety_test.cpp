// No file can hurt us: whatever is done to a good file, the answer is a message or clips that keep
// their promises and can be written again.

#include <cmath>

#include <gtest/gtest.h>

#include "base/file.h"
#include "clip/binary_fbx.h"
#include "clip/fbx.h"
#include "clip/make_fbx.h"
#include "clip/make_fbx6.h"
#include "clip/make_fbx_scene.h"
#include "make_clip.h"

namespace panache {
namespace {

std::string rejection(const std::string& bytes) {
  const auto file = parse_fbx(bytes, "in.fbx");
  return file ? "" : file.error().message;
}

// What is accepted keeps its promises, can be written in every way, and is accepted again.
void check_harmless(const std::string& bytes, const std::string& what) {
  SCOPED_TRACE(what);
  const auto file = parse_fbx(bytes, "in.fbx");
  if (!file) {
    EXPECT_TRUE(file.error().message.starts_with("in.fbx")) << file.error().message;
    return;
  }
  const Clip& clip = (*file)->clip(0);
  ASSERT_GT(clip.joints(), 0u);
  ASSERT_GE(clip.frames, 1);
  if (clip.frames > 200) return;
  for (int f = 0; f < clip.frames; ++f) {
    for (size_t j = 0; j < clip.joints(); ++j) {
      const Quat q = clip.pose(f).rotations[j];
      ASSERT_NEAR(dot(q, q), 1, 1e-5);
      ASSERT_TRUE(is_finite(clip.pose(f).translations[j]));
      ASSERT_LT(clip.skeleton.joints[j].parent, static_cast<int>(j));
    }
  }
  Clip changed = clip;
  std::vector<double> frames;
  for (int f = 0; f < clip.frames; ++f) {
    frames.push_back(f);
    changed.pose(f).rotations[0] = Quat{0.6f, 0, 0.8f, 0};
  }
  const ClipEdit edit = {0, &changed, frames, "new"};
  for (const EditMode mode : {EditMode::replace, EditMode::add_first}) {
    const auto again = parse_fbx((*file)->encode({&edit, 1}, mode), "again.fbx");
    EXPECT_TRUE(again.ok()) << again.error().message;
  }
}

std::vector<std::string> small_files() {
  std::vector<std::string> out;
  for (const char* name : {"pivots", "two-figures-equal-names", "additive-layer"}) {
    out.push_back(
        *read_file(std::string(PANACHE_SOURCE_DIR "/tests/fixtures/fbx/") + name + ".fbx"));
    out.push_back(test::to_binary_fbx7(out.back(), 7400, true));
    out.push_back(test::to_binary_fbx7(out.back().empty() ? "" : out[out.size() - 2], 7700, false));
  }
  const Clip walk = test::walking_clip(3);
  out.push_back(test::Fbx6Maker(walk, 3, 1).make());
  out.push_back(test::to_binary_fbx6(out.back()));
  out.push_back(format_fbx(walk.skeleton, {{&walk, "walk"}}, 1, Quat{}));
  return out;
}

TEST(FbxSafety, a_file_that_ends_anywhere_is_harmless) {
  for (const std::string& bytes : small_files()) {
    for (size_t size = 0; size < bytes.size(); size += 1 + bytes.size() / 41) {
      check_harmless(bytes.substr(0, size), std::to_string(size));
    }
  }
}

TEST(FbxSafety, a_flipped_bit_anywhere_is_harmless) {
  for (const std::string& bytes : small_files()) {
    for (size_t bit = 0; bit < 8 * bytes.size(); bit += 1 + 8 * bytes.size() / 31) {
      std::string flipped = bytes;
      flipped[bit / 8] = static_cast<char>(flipped[bit / 8] ^ 1 << bit % 8);
      check_harmless(flipped, std::to_string(bit));
    }
  }
}

// The text with `to` instead of the first `from`.
std::string spoilt(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

TEST(FbxSafety, what_is_wrong_is_told_so) {
  const std::string two = test::make_fbx_scene({{"a", -1, {}}, {"b", 0, {}}}, {});
  const std::string walk = test::format_fbx(test::walking_clip(3));
  const std::string packed = test::to_binary_fbx7(walk, 7400, true);
  const size_t count_at = packed.find("KeyTimel") + 8;
  const auto with_count = [&](const char* count) {
    return std::string(packed).replace(count_at, 4, std::string(count, 4));
  };
  // Written with its first lines changed, such a file would not begin as FBX files do.
  std::string zero = test::format_fbx(test::walking_clip(30));
  ASSERT_GT(zero.size(), 5000u);
  zero.insert(zero.rfind("\n\t") + 2, 1, '\0');
  const std::string none = "in.fbx: does not begin as FBX files do; is it damaged?";
  const std::string times = "expected whole numbers as the times of keys";
  const std::pair<std::string, std::string> cases[] = {
      {"", none},
      {"HIERARCHY\nROOT", none},
      {"; FBX 5.0 project file\nFBXHeaderExtension: {\nFBXVersion: 5000\n}\n",
       "expected FBX 6 or 7, found version 5000; Autodesk's FBX Converter"},
      {"; FBX 7.4.0 project file\n", "in.fbx: expected joints (models of FBX), found none"},
      {zero, "expected text, found a byte of 0; is the file damaged?"},
      {spoilt(two, "\"OO\",2000,0", "\"OO\",2000,2001"),
       "in.fbx: expected models that hang on the scene, found 2 that hang on each other in a "
       "circle"},
      {with_count("\xff\xff\xff\xff"), times},
      {with_count("\x04\x00\x00\x00"), times},
      {with_count("\x00\x00\x00\x01"), times},
      {test::make_fbx_scene(
           {{"a", -1, {{"Lcl Scaling", {1, 0, 1}}}}, {"b", 0, {{"Lcl Translation", {1, 1, 1}}}}},
           {}),
       "expected a scale that leaves each of its axes some length"},
      {spoilt(walk, "KeyValueFloat: *3 {\n\t\t\ta: ", "KeyValueFloat: *3 {\n\t\t\ta: 1,"),
       "expected a curve with as many values as times"}};
  for (const auto& [bytes, message] : cases) {
    EXPECT_NE(rejection(bytes).find(message), std::string::npos)
        << rejection(bytes) << "\ninstead of: " << message;
  }
}

}  // namespace
}  // namespace panache
