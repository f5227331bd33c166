#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <gtest/gtest.h>

#include "eval/performer_judges.h"
#include "learn/make_takes.h"
#include "make_styled_takes.h"
#include "takes/load_takes.h"
#include "takes/manifest.h"
#include "train/matrix_products.h"

namespace panache {
namespace {

// Of one performer.
std::vector<Take> takes_of(int set, const std::vector<std::string>& styles,
                           const std::vector<int>& numbers) {
  std::vector<Take> takes = test::styled_takes(styles, numbers);
  for (Take& take : takes) {
    take.row.set = set;
    take.row.person = set == 0 ? "ann" : "bob";
  }
  return takes;
}

std::vector<Take> together(std::vector<Take> takes, const std::vector<Take>& more) {
  takes.insert(takes.end(), more.begin(), more.end());
  return takes;
}

// What is asked for, whatever the motion.
std::vector<Take> as_style(std::vector<Take> takes, const std::string& style) {
  for (Take& take : takes) {
    take.row.style = style;
    take.row.neutral = false;
  }
  return takes;
}

class PerformerJudgesTest : public testing::Test {
 protected:
  static void SetUpTestSuite() { EXPECT_TRUE(prepare_matrix_products().ok()); }
};

TEST_F(PerformerJudgesTest, real_takes_are_recognised_by_their_own_judge) {
  const PerformerJudges judges(together(takes_of(0, {"neutral", "old", "proud"}, {0, 1}),
                                        takes_of(1, {"neutral", "proud"}, {0, 1})),
                               together(takes_of(0, {"neutral", "old", "proud"}, {4}),
                                        takes_of(1, {"neutral", "proud"}, {4})));
  ASSERT_EQ(judges.real().size(), 10u);
  for (const ClipVerdict& clip : judges.real()) {
    EXPECT_TRUE(clip.recognised()) << clip.performer << " " << clip.style << ": " << clip.verdict;
    EXPECT_EQ(clip.judge, clip.performer);
    EXPECT_LT(clip.cm, 3);
  }
  EXPECT_EQ(clips_by(&ClipVerdict::performer, judges.real())["bob"].size(), 4u);
}

// What training takes call old, test takes call proud. Only a judge that has seen the test takes
// tells them.
TEST_F(PerformerJudgesTest, test_takes_are_not_learnt_from) {
  std::vector<Take> test = takes_of(0, {"neutral", "old", "proud"}, {4, 5, 6});
  for (Take& take : test) {
    if (!take.row.neutral) take.row.style = take.row.style == "old" ? "proud" : "old";
  }
  const PerformerJudges judges(takes_of(0, {"neutral", "old", "proud"}, {0}), test);
  EXPECT_EQ(summarize_clips(styled_clips(judges.real())).recognised, 0);
  EXPECT_EQ(summarize_clips(styled_clips(judges.real())).clips, 12u);
}

TEST_F(PerformerJudgesTest, outputs_count_where_they_show_what_was_asked_for) {
  const std::vector<std::string> labels = {"neutral", "old", "proud"};
  const PerformerJudges judges(takes_of(0, labels, {0, 1}), takes_of(0, labels, {4}));
  // A system that ignores the style, one that always makes the same, and one that does it right.
  const std::vector<Take> neutral = takes_of(0, {"neutral"}, {5}), old = takes_of(0, {"old"}, {5});
  const auto recognised = [&](const std::vector<Take>& outputs) {
    return summarize_clips(judges.judge(outputs)).recognised;
  };
  EXPECT_EQ(recognised(together(as_style(neutral, "old"), as_style(neutral, "proud"))), 0);
  EXPECT_EQ(recognised(together(as_style(old, "old"), as_style(old, "proud"))), 0.5);
  EXPECT_EQ(recognised(takes_of(0, {"old", "proud"}, {5})), 1);
  // The nearest take is one of the style, performer and content asked for.
  EXPECT_LT(summarize_clips(judges.judge(old)).cm, 3);
  EXPECT_GT(summarize_clips(judges.judge(as_style(old, "proud"))).cm, 10);
  // Nobody tells what no judge knows.
  EXPECT_TRUE(judges.judge(as_style(old, "jolly")).empty());
  EXPECT_TRUE(judges.judge(takes_of(1, {"old"}, {5})).empty());
}

// Bob's takes of these numbers, in posture a share of the way from neutral to a style.
std::vector<Take> bobs(const std::string& style, float share, const std::vector<int>& numbers) {
  std::vector<Take> takes = takes_of(1, {"neutral"}, numbers);
  const std::vector<Take> styled = takes_of(1, {style}, numbers);
  for (size_t t = 0; t < takes.size(); ++t) {
    for (int f = 0; f < takes[t].frames(); ++f) {
      for (int j = 0; j < kHumanJoints; ++j) {
        Vec3& joint = takes[t].body[f][j];
        joint = joint + (styled[t].body[f][j] - joint) * share;
      }
    }
  }
  return takes;
}

// Bob stoops. What makes him proud is about what makes ann proud, and looks like her neutral.
TEST_F(PerformerJudgesTest, what_differs_between_performers_is_taken_off_across) {
  const std::vector<Take> ann = takes_of(0, {"neutral", "old", "proud"}, {0, 1});
  const std::vector<Take> bob =
      together(bobs("old", 0.6f, {0, 1}), as_style(bobs("proud", 0.4f, {0, 1}), "proud"));
  const PerformerJudges judges(together(ann, bob), {});
  std::vector<Take> proud = as_style(bobs("proud", 0.4f, {5}), "proud");
  const std::vector<ClipVerdict> across = judges.judge_across(proud);
  ASSERT_EQ(across.size(), 2u);  // Of two contents.
  for (const ClipVerdict& clip : across) {
    EXPECT_EQ(clip.judge, "ann");
    EXPECT_EQ(clip.performer, "bob");
    EXPECT_EQ(clip.verdict, "proud");
  }
  // From somebody without neutral takes nothing is taken off.
  for (Take& take : proud) take.row.set = 7;
  for (const ClipVerdict& clip : judges.judge_across(proud)) {
    EXPECT_EQ(clip.recognised(), clip.judge == "bob") << clip.judge;
  }
  ManifestRow row = proud.front().row;
  EXPECT_TRUE(judges.is_judged_across(row));
  row.content = "kick";
  EXPECT_FALSE(judges.is_judged_across(row));
  row = ann.back().row;
  row.style = "old";
  EXPECT_FALSE(judges.is_judged_across(row));  // Only ann is old.
}

TEST_F(PerformerJudgesTest, actors_of_cmu_are_known_by_their_own_judges) {
  const char* data = std::getenv("PANACHE_DATA");
  if (!data) GTEST_SKIP() << "PANACHE_DATA is not set";
  std::vector<Take> training, test;
  int set = 0;
  for (const char* person : {"91", "142", "104", "132", "136", "137"}) {
    const auto rows = read_manifest(std::string(data) + "/cmu-styles-" + person + ".csv", set++);
    ASSERT_TRUE(rows.ok()) << rows.error().message;
    const auto takes = load_takes(*rows, PoseLayout::positions);
    ASSERT_TRUE(takes.ok()) << takes.error().message;
    for (const Take& take : *takes) (take.row.test ? test : training).push_back(take);
  }
  const PerformerJudges judges(training, test);
  // A clip is worth 0.03 to 0.06; the floors lie two clips lower than what was measured.
  ClipGroups of = clips_by(&ClipVerdict::performer, judges.real());
  const std::pair<const char*, double> kFloors[] = {{"91", 0.82}, {"142", 0.86}, {"104", 0.82},
                                                    {"132", 0.9}, {"136", 0.92}, {"137", 0.6}};
  for (const auto& [person, floor] : kFloors) {
    const ClipSummary found = summarize_clips(of["cmu-styles-" + std::string(person)]);
    EXPECT_GE(found.recognised, floor) << person;
    EXPECT_LT(found.cm, 10) << person;
  }
}

Take part_of(const Take& take, int first, int frames, int stride = 1) {
  Take part;
  for (int f = 0; f < frames; ++f) part.body.push_back(take.body[first + f * stride]);
  return part;
}

TEST(WarpedDistance, a_part_of_the_real_take_is_found_wherever_it_begins) {
  const Take real = test::walk_take("old", "walk", 200, 0.3f);
  EXPECT_EQ(warped_distance(part_of(real, 37, 100), real), 0);
  EXPECT_EQ(warped_distance(part_of(real, 37, 20), real), 0);
  EXPECT_EQ(warped_distance(real, part_of(real, 0, 200)), 0);
  // One frame is a motion too.
  EXPECT_EQ(warped_distance(part_of(real, 5, 1), real), 0);
}

TEST(WarpedDistance, half_and_double_speed_cost_little) {
  const Take real = test::walk_take("old", "walk", 200, 0.3f);
  EXPECT_EQ(warped_distance(part_of(real, 10, 90, 2), real), 0);
  // Every other frame of the slow take lies half-way between two.
  const Take fast = part_of(real, 0, 100, 2);
  const double slow = warped_distance(part_of(real, 0, 120), fast);
  EXPECT_LT(slow, 2);
  EXPECT_GT(slow, 0);
}

TEST(WarpedDistance, what_differs_in_every_frame_is_measured_in_centimetres) {
  const Take real = test::walk_take("old", "walk", 150, 0.3f);
  Take raised = part_of(real, 20, 100);
  for (HumanPositions& pose : raised.body) {
    for (Vec3& joint : pose) joint.y += 0.5f;
  }
  // Every joint is half a metre from its own place, and of other instants no nearer but for a bit.
  EXPECT_LE(warped_distance(raised, real), 50.001);
  EXPECT_GT(warped_distance(raised, real), 49);
}

TEST(WarpedDistance, standing_still_is_no_way_to_be_near_a_walk) {
  const Take real = test::walk_take("old", "walk", 150, 0.3f);
  Take still = part_of(real, 0, 60);
  std::fill(still.body.begin(), still.body.end(), real.body[30]);
  EXPECT_GT(warped_distance(still, real), 1);
}

}  // namespace
}  // namespace panache
