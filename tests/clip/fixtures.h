#pragma once
// What the tests of motion files share.

#include <cmath>
#include <filesystem>
#include <numeric>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/file.h"
#include "clip/bvh.h"
#include "clip/motion_file.h"

namespace panache {

inline const char* const kBvhFixtures[] = {"plain.bvh", "odd.bvh", "two_roots.bvh"};

inline std::string read_fixture(const std::string& name) {
  auto bytes = read_file(PANACHE_SOURCE_DIR "/tests/fixtures/bvh/" + name);
  EXPECT_TRUE(bytes.ok()) << bytes.error().message;
  return bytes.ok() ? *bytes : std::string();
}

// The file, which has to be readable.
inline std::unique_ptr<MotionFile> must_parse(const std::string& text,
                                              const std::string& name = "test.bvh") {
  auto file = parse_bvh(text, name);
  if (!file) {
    ADD_FAILURE() << file.error().message;
    return nullptr;
  }
  return std::move(*file);
}

// The message that says why `text` is no BVH file.
inline std::string rejection(const std::string& text) {
  auto file = parse_bvh(text, "walk.bvh");
  return file.ok() ? "(accepted)" : file.error().message;
}

// The text with the first `from` in it replaced; it has to be there.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

inline std::string replaced_all(const std::string& text, char from, const std::string& to) {
  std::string out;
  for (const char c : text) out += c == from ? to : std::string(1, c);
  return out;
}

// 0, 1, 2, ...: every frame comes from itself.
inline std::vector<double> same_frames(int count) {
  std::vector<double> frames(static_cast<size_t>(count));
  std::iota(frames.begin(), frames.end(), 0.0);
  return frames;
}

// The angle of the rotation between two unit quaternions, radians; exact near zero too.
template <class T>
double angle_between(BasicQuat<T> a, BasicQuat<T> b) {
  return static_cast<double>(
      length(log_rotation(conjugate(a.template as<double>()) * b.template as<double>())));
}

// Messages are one line: where, what was expected, and what was found.
inline void expect_whole_message(const Error& error, const std::string& where) {
  EXPECT_TRUE(error.message.starts_with(where)) << error.message;
  EXPECT_NE(error.message.find("expected "), std::string::npos) << error.message;
  EXPECT_EQ(error.message.find('\n'), std::string::npos) << error.message;
}

// The text with one byte changed: to `value`, or by its last bit where that is negative.
inline std::string with_byte(std::string text, size_t at, int value) {
  text[at] = static_cast<char>(value < 0 ? text[at] ^ 1 : value);
  return text;
}

// Why `clip` breaks a promise that every clip keeps; empty where it keeps all.
inline std::string broken_promise(const Clip& clip) {
  if (clip.skeleton.joints.empty()) return "no joints";
  if (clip.frames < 1) return "no frames";
  if (!(clip.frame_time > 0) || !std::isfinite(clip.frame_time)) return "frame time";
  const size_t poses = static_cast<size_t>(clip.frames) * clip.joints();
  if (clip.rotations.size() != poses || clip.translations.size() != poses) return "sizes";
  for (size_t j = 0; j < clip.joints(); ++j) {
    const Joint& joint = clip.skeleton.joints[j];
    if (joint.parent < -1 || joint.parent >= static_cast<int>(j)) return "parents before children";
    if (joint.name.empty()) return "joint without a name";
    if (!is_finite(joint.offset)) return "offset not finite";
    for (const Vec3 end : joint.ends) {
      if (!is_finite(end)) return "end not finite";
    }
  }
  for (size_t i = 0; i < poses; ++i) {
    if (!is_finite(clip.translations[i])) return "translation not finite";
    // A float quaternion made from an exact one is unit to a few times 2^-24.
    const Quatd q = clip.rotations[i].as<double>();
    if (!(std::abs(dot(q, q) - 1) < 1e-6)) return "rotation not unit";
  }
  return "";
}

}  // namespace panache
