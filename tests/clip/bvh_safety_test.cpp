// No file can hurt us: whatever is done to a good file, the answer is a message or a clip that
// keeps its promises.

#include "clip/clip.h"
#include "count_allocations.h"
#include "fixtures.h"

namespace panache {
namespace {

using test::allocations;
using test::allocations_left;

// Reads `text`; if it is accepted, the clip keeps its promises and the file comes back byte for
// byte. Returns whether it was accepted.
bool check_harmless(const std::string& text) {
  auto file = parse_bvh(text, "walk.bvh");
  if (!file) {
    expect_whole_message(file.error(), "walk.bvh:");
    return false;
  }
  const Clip& clip = (*file)->clip();
  EXPECT_EQ(broken_promise(clip), "") << text;
  EXPECT_EQ((*file)->encode(clip, same_frames(clip.frames)), text);

  std::vector<Quat> rotations(clip.joints());
  std::vector<Vec3> translations(clip.joints());
  for (int i = 0; i < clip.frames; ++i) {
    world_pose(clip.skeleton, clip.pose(i), {rotations, translations});
    for (size_t j = 0; j < clip.joints(); ++j) {
      EXPECT_TRUE(is_finite(rotations[j]) && is_finite(translations[j])) << text;
    }
  }
  return true;
}

TEST(BvhSafety, every_truncation_is_harmless) {
  for (const char* fixture : kBvhFixtures) {
    const std::string text = read_fixture(fixture);
    for (size_t size = 0; size < text.size(); ++size) check_harmless(text.substr(0, size));
  }
}

TEST(BvhSafety, every_changed_byte_is_harmless) {
  int accepted = 0, rejected = 0;
  for (const char* fixture : kBvhFixtures) {
    const std::string text = read_fixture(fixture);
    for (size_t i = 0; i < text.size(); ++i) {
      for (const int value : std::initializer_list<int>{-1, 0, ' ', '\n', '\r', '0', '9', '-', '.',
                                                        'e', '{', '}', 'X', 0x7f, 0xff}) {
        ++(check_harmless(with_byte(text, i, value)) ? accepted : rejected);
      }
    }
  }
  // Both ways were taken, or this test says nothing.
  EXPECT_GT(accepted, 1000);
  EXPECT_GT(rejected, 1000);
}

TEST(BvhSafety, every_missing_line_is_harmless) {
  for (const char* fixture : kBvhFixtures) {
    const std::string text = read_fixture(fixture);
    for (size_t begin = 0; begin < text.size();) {
      const size_t end = std::min(text.find('\n', begin), text.size() - 1) + 1;
      check_harmless(text.substr(0, begin) + text.substr(end));
      check_harmless(text.substr(0, end) + text.substr(begin));
      begin = end;
    }
  }
}

TEST(BvhSafety, every_failed_allocation_comes_out_as_bad_alloc) {
  std::string texts[] = {read_fixture(kBvhFixtures[0]), read_fixture(kBvhFixtures[1]),
                         read_fixture(kBvhFixtures[2]),
                         replaced(read_fixture(kBvhFixtures[0]), "89.000000", "eighty")};
  const std::string name = "a name that is too long to be kept without memory.bvh";
  for (const std::string& text : texts) {
    bool done = false;
    long allowed = 0;
    for (; !done; ++allowed) {
      ASSERT_LT(allowed, 10000);
      std::string copy = text;
      allocations_left = allowed;
      try {
        auto file = parse_bvh(std::move(copy), name);
        if (file) {
          const auto frames = same_frames((*file)->clip().frames);
          done = (*file)->encode((*file)->clip(), frames).size() == text.size();
        } else {
          done = true;
        }
      } catch (const std::bad_alloc&) {
      }
      allocations_left = LONG_MAX;
    }
    EXPECT_GT(allowed, 10);
  }
}

TEST(BvhSafety, an_announced_flood_takes_no_memory) {
  const std::string text =
      replaced(read_fixture("plain.bvh"), "Frames: 3", "Frames: 1000000000000");
  const long before = allocations;
  EXPECT_TRUE(parse_bvh(text, "walk.bvh").ok());
  EXPECT_LT(allocations - before, 150);
}

TEST(BvhSafety, sampling_and_forward_kinematics_allocate_nothing) {
  const auto file = must_parse(read_fixture("plain.bvh"));
  const Clip& clip = file->clip();
  std::vector<Quat> rotations(clip.joints());
  std::vector<Vec3> translations(clip.joints());
  const Pose pose = {rotations, translations};
  const long before = allocations;
  for (int i = 0; i < 1000; ++i) {
    sample(clip, i * 0.002, pose);
    world_pose(clip.skeleton, pose, pose);
  }
  EXPECT_EQ(allocations, before);
}

}  // namespace
}  // namespace panache
