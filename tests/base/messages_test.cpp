// What people are told: errors with their place, progress.

#include <gtest/gtest.h>

#include "base/progress.h"
#include "base/result.h"

namespace panache {
namespace {

TEST(Result, a_place_in_front_of_an_error_keeps_its_kind) {
  const Error error = located("walk.bvh", Error{"no humanoid found", ErrorKind::not_humanoid});
  EXPECT_EQ(error.message, "walk.bvh: no humanoid found");
  EXPECT_EQ(error.kind, ErrorKind::not_humanoid);
}

using std::chrono::milliseconds;

// What is written to stderr, which is a file here.
std::string log_of(Progress::Clock::duration every, const std::vector<double>& shares,
                   const std::string& text = "") {
  testing::internal::CaptureStderr();
  {
    Progress progress("training", every);
    for (const double share : shares) progress.update(share, text);
  }
  return testing::internal::GetCapturedStderr();
}

TEST(Progress, a_log_gets_a_line_now_and_then) {
  EXPECT_EQ(log_of(milliseconds(0), {0.25, 0.5, 1}),
            "training: 25 %, 0:00 left\ntraining: 50 %, 0:00 left\n");
  EXPECT_EQ(log_of(milliseconds(0), {0.5}, "pose loss 0.1"),
            "training: 50 %, 0:00 left, pose loss 0.1\n");
  // Short work is not worth a line, and neither is every update of a long one.
  EXPECT_EQ(log_of(std::chrono::seconds(30), {0.25, 0.5, 1}), "");
}

}  // namespace
}  // namespace panache
