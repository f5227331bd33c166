#include "base/result.h"

#include <gtest/gtest.h>

namespace panache {
namespace {

TEST(Result, a_place_in_front_of_an_error_keeps_its_kind) {
  const Error error = located("walk.bvh", Error{"no humanoid found", ErrorKind::not_humanoid});
  EXPECT_EQ(error.message, "walk.bvh: no humanoid found");
  EXPECT_EQ(error.kind, ErrorKind::not_humanoid);
}

}  // namespace
}  // namespace panache
