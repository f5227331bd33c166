// What kind of mistake a failure is, beside its message.

#include <string>

#include <gtest/gtest.h>

#include "panache/panache.h"

namespace panache {
namespace {

TEST(ErrorKindOfC, tells_a_missing_rate_from_a_damaged_file) {
  const std::string no_rate =
      "HIERARCHY\nROOT hips\n{\n  OFFSET 0 0 0\n  CHANNELS 3 Zrotation Xrotation Yrotation\n"
      "  End Site\n  {\n    OFFSET 0 1 0\n  }\n}\nMOTION\nFrames: 1\nFrame Time: 0\n0 0 0\n";
  panache_motion_file* file = nullptr;
  EXPECT_NE(panache_motion_file_create(no_rate.data(), no_rate.size(), "a.bvh", &file), PANACHE_OK);
  EXPECT_EQ(panache_last_error_kind(), PANACHE_ERROR_RATE_NEEDED) << panache_last_error();
  EXPECT_NE(panache_motion_file_create("x", 1, "a.bvh", &file), PANACHE_OK);
  EXPECT_EQ(panache_last_error_kind(), PANACHE_ERROR_OTHER) << panache_last_error();
}

}  // namespace
}  // namespace panache
