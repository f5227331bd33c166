#include "train/coverage.h"

#include <gtest/gtest.h>

#include "known_recipes.h"
#include "make_styled_takes.h"
#include "takes/manifest.h"
#include "train/trainer.h"

namespace panache {
namespace {

ManifestRow row(const std::string& style, const std::string& content, int set = 0,
                bool test = false) {
  ManifestRow made;
  made.path = style + content;
  made.style = style;
  made.content = content;
  made.neutral = style == "neutral";
  made.test = test;
  made.set = set;
  made.manifest = set == 0 ? "one.csv" : "two.csv";
  return made;
}

using Lines = std::vector<std::string>;

TEST(Coverage, contents_and_manifests_without_a_pair_are_named) {
  EXPECT_EQ(list_unpaired({row("neutral", "walk"), row("old", "walk")}), Lines());
  EXPECT_EQ(list_unpaired({row("neutral", "walk"), row("old", "walk"), row("old", "crawl"),
                           row("sad", "crawl"), row("old", "crawl"), row("neutral", "run")}),
            (Lines{"one.csv: content 'crawl' is left out: it has no neutral take (3 takes of old, "
                   "sad)",
                   "one.csv: content 'run' is left out: it has no styled take (1 neutral take)"}));
  // A neutral take of another manifest is no help, and neither is one that is held out.
  EXPECT_EQ(list_unpaired({row("neutral", "walk"), row("old", "walk"), row("old", "walk", 1),
                           row("neutral", "walk", 1, true)}),
            (Lines{"two.csv: the manifest is left out: no content of it has both a neutral and a "
                   "styled take",
                   "two.csv: content 'walk' is left out: it has no neutral take (1 take of old)"}));
}

TEST(Coverage, a_performer_without_a_neutral_take_is_compared_with_others_of_the_manifest) {
  std::vector<ManifestRow> rows = {row("neutral", "walk"), row("old", "walk"), row("sad", "walk"),
                                   row("sad", "run")};
  rows[0].person = rows[1].person = "ann";
  rows[2].person = rows[3].person = "bob";
  rows[2].set = rows[3].set = 1;
  EXPECT_EQ(list_unpaired(rows),
            (Lines{"one.csv: performer 'bob': content 'run' is left out: it has no neutral take (1 "
                   "take of sad)",
                   "one.csv: performer 'bob': content 'walk' has no neutral take: styled takes are "
                   "compared with the neutral ones of the other performers"}));
  EXPECT_TRUE(check_styles(rows, {{"old", {"old"}, ""}, {"sad", {"sad"}, ""}}).ok());
}

TEST(Coverage, all_styles_that_cannot_be_learnt_are_named_at_once) {
  const std::vector<StyleName> styles = {
      {"old", {"old"}, ""}, {"sad", {"sad"}, ""}, {"shy", {"shy"}, ""}, {"tired", {"tired"}, ""}};
  const std::vector<ManifestRow> rows = {row("neutral", "walk"),
                                         row("old", "walk"),
                                         row("old", "run"),
                                         row("sad", "run"),
                                         row("sad", "crawl"),
                                         row("shy", "walk", 1),
                                         row("tired", "walk", 0, true),
                                         row("neutral", "run", 1)};
  const Result<void> good = check_styles(rows, styles);
  ASSERT_FALSE(good.ok());
  EXPECT_EQ(
      good.error().message,
      "nothing can be learnt of 3 styles: 'sad' (crawl, run), 'shy' (walk), 'tired' (no take "
      "to train on); expected a neutral take of one of these contents, to train on, in the "
      "manifest of the style; add one, or leave the styles out (--styles lists those to learn)");
  EXPECT_TRUE(check_styles(rows, {styles[0]}).ok());
}

// Takes of 'old' and of 'brief', whose takes are too short for a window.
TrainingData data_with_short_takes() {
  TrainingData data;
  data.takes = test::styled_takes({"neutral", "old"}, {0});
  data.takes.push_back(test::styled_take("brief", "walk", 0, 6));
  std::vector<int> styled, neutral;
  for (size_t t = 0; t < data.takes.size(); ++t) {
    (data.takes[t].row.neutral ? neutral : styled).push_back(static_cast<int>(t));
  }
  data.pairings = pair_takes(data.takes, styled, neutral);
  return data;
}

TEST(Coverage, the_table_counts_what_is_trained_on) {
  const TrainingData data = data_with_short_takes();
  const SampleSet set(data.takes, data.pairings, {"brief", "old"}, test::kPanache, false);
  std::vector<int> all;
  for (size_t i = 0; i < set.samples().size(); ++i) all.push_back(static_cast<int>(i));
  const std::vector<StyleCoverage> styles = cover_styles(data.takes, set, all, {"brief", "old"});
  ASSERT_EQ(styles.size(), 2u);
  EXPECT_EQ(styles[0].style, "brief");
  EXPECT_EQ(styles[0].takes, 0u);
  EXPECT_EQ(styles[0].samples, 0u);
  EXPECT_EQ(styles[1].takes, 2u);
  EXPECT_EQ(styles[1].samples, all.size());
  double seconds = 0;
  for (const Take& take : data.takes) {
    if (take.row.style == "old") seconds += take.frames() / kTakeRate;
  }
  EXPECT_DOUBLE_EQ(styles[1].seconds, seconds);
  const Lines lines = list_too_short(data.takes, set);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].substr(0, lines[0].find(" (")),
            "style 'brief' is left out in content 'walk': its takes or the neutral ones are too "
            "short");
}

TEST(Coverage, training_rejects_a_style_without_samples) {
  TrainOptions options(test::kPanache);
  options.settings.steps = 2;
  options.settings.predictor_steps = 0;
  Lines notes;
  options.note = [&](const std::string& line) { notes.push_back(line); };
  const std::vector<StyleName> styles = {{"brief", {"brief"}, ""}, {"old", {"old"}, ""}};
  const Result<Trained> trained = train(data_with_short_takes(), styles, options);
  ASSERT_FALSE(trained.ok());
  EXPECT_EQ(trained.error().message,
            "no samples of the style 'brief'; expected longer takes, styled and neutral; add some, "
            "or leave the style out (--styles lists those to learn)");
  EXPECT_EQ(notes.size(), 1u);
}

}  // namespace
}  // namespace panache
