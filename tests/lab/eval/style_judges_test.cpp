#include "eval/style_judges.h"

#include <gtest/gtest.h>

#include "make_styled_takes.h"
#include "train/matrix_products.h"

namespace panache {
namespace {

void expect_real_takes_known(const StyleJudges& judges) {
  for (const Take& take : test::styled_takes({"old", "proud"}, {4}, 60)) {
    const OodVerdict verdict = judges.judge_real(take);
    EXPECT_GT(verdict.style_robust, 0.9) << take.row.path;
    EXPECT_GT(verdict.style_lda, 0.9) << take.row.path;
    ASSERT_EQ(verdict.robust_scores.size(), 2u);  // Neutral cannot be asked for.
    EXPECT_EQ(verdict.style, take.row.style == "old" ? 0 : 1);
    const size_t own = static_cast<size_t>(verdict.style);
    EXPECT_GT(verdict.robust_scores[own], verdict.robust_scores[1 - own]);
    EXPECT_GT(verdict.lda_scores[own], verdict.lda_scores[1 - own]);
  }
}

void expect_outputs_judged_as_the_style_asked_for(const StyleJudges& judges) {
  const Take neutral = test::styled_take("neutral", "walk", 5);
  const Take old = test::styled_take("old", "walk", 5);
  const OodVerdict right = judges.judge(neutral, old, 0, "old");
  EXPECT_GT(right.style_lda, 0.9);
  EXPECT_EQ(right.signature.sign, right.signature.traits);
  EXPECT_EQ(right.signature.amount, right.signature.traits);
  EXPECT_GT(right.signature.traits, 0u);
  const OodVerdict wrong = judges.judge(neutral, old, 0, "proud");
  EXPECT_LT(wrong.style_lda, 0.1);
  EXPECT_LT(wrong.style_robust, 0.1);
  EXPECT_LT(wrong.signature.sign_share(), 0.5);
  // The input itself has no style, and is no signature.
  const OodVerdict nothing = judges.judge(neutral, neutral, 0, "old");
  EXPECT_LT(nothing.style_robust, 0.1);
  EXPECT_EQ(nothing.signature.sign, 0u);
  EXPECT_EQ(judges.judge(neutral, old, 0, "jolly").style, -1);
}

// To train judges takes long, so one pair answers all questions.
TEST(StyleJudges, know_real_takes_and_outputs_and_do_not_learn_that_whoever_kicks_is_neutral) {
  EXPECT_TRUE(prepare_matrix_products().ok());
  std::vector<Take> takes = test::styled_takes({"neutral", "old", "proud"}, {0, 1, 2});
  // A kick that only neutral shows, and that looks like an old walk.
  for (Take kick : test::styled_takes({"old"}, {0, 1, 2, 3, 5, 6, 7, 8, 9}, 60)) {
    kick.row.style = "neutral";
    kick.row.neutral = true;
    kick.row.content = "kick";
    takes.push_back(kick);
  }
  std::vector<int> styled, neutral;
  for (size_t i = 0; i < takes.size(); ++i) {
    (takes[i].row.neutral ? neutral : styled).push_back(static_cast<int>(i));
  }
  const StyleJudges judges(takes, pair_takes(takes, styled, neutral), 1);
  expect_real_takes_known(judges);
  expect_outputs_judged_as_the_style_asked_for(judges);
}

// What old is in a walk is called proud where a hand waves: who has not seen the other action is
// wrong in every take of it, by one of the judges at least.
TEST(JudgeUnseenActions, is_done_by_judges_of_the_other_actions) {
  EXPECT_TRUE(prepare_matrix_products().ok());
  std::vector<Take> takes = test::styled_takes({"neutral", "old", "proud"}, {0, 1, 2}, 60);
  for (Take& take : takes) {
    if (take.row.content == "wave" && !take.row.neutral) {
      take.row.style = take.row.style == "old" ? "proud" : "old";
    }
  }
  const std::vector<OodRow> rows = judge_unseen_actions(takes, 1);
  EXPECT_EQ(rows.size(), 12u);  // Without neutral.
  std::map<std::string, int> clips;
  for (const OodRow& row : rows) {
    ++clips[row.clip];
    // Who has seen the action is right by both judges.
    EXPECT_LT(row.verdict.style_lda + row.verdict.style_robust, 1.5)
        << row.clip << " " << row.style;
  }
  // Each clip is shown in both styles.
  EXPECT_EQ(clips.size(), 6u);
  for (const auto& [clip, count] : clips) EXPECT_EQ(count, 2) << clip;

  // Left and right are one kind of action: nobody is left to judge it.
  for (Take& take : takes) take.row.content = take.row.content == "wave" ? "walk-left" : "walk";
  EXPECT_TRUE(judge_unseen_actions(takes, 1).empty());
}

}  // namespace
}  // namespace panache
