#include "train/classifier.h"

#include <gtest/gtest.h>

#include "make_styled_takes.h"
#include "train/matrix_products.h"

namespace panache {
namespace {

std::vector<std::string> styles_of(const std::vector<Take>& takes) {
  std::vector<std::string> labels;
  for (const Take& take : takes) labels.push_back(take.row.style);
  return labels;
}

// To train a classifier takes seconds, so two answer all questions.
TEST(Classifier, learns_its_classes_alone_and_the_same_from_the_same_seed) {
  EXPECT_TRUE(prepare_matrix_products().ok());
  std::vector<Take> takes = test::styled_takes({"old", "proud"}, {0});
  std::vector<std::string> labels = styles_of(takes);
  const Classifier without(takes, labels, {"proud", "old"}, 3);
  // Takes of no class are not learnt from: they change nothing at all.
  for (const Take& take : test::styled_takes({"neutral"}, {1, 2})) {
    takes.push_back(take);
    labels.push_back("jolly");
  }
  const Classifier classifier(takes, labels, {"proud", "old"}, 3);
  EXPECT_EQ(classifier.find("old"), 1);
  EXPECT_EQ(classifier.find("jolly"), -1);
  const Take stranger = test::styled_take("neutral", "walk", 1);
  EXPECT_TRUE(torch::equal(classifier.classify(stranger).probabilities,
                           without.classify(stranger).probabilities));

  const Classification classified = classifier.classify(test::styled_take("old", "walk", 3, 90));
  ASSERT_EQ(classified.probabilities.size(0), 7);  // 29 frames each, 10 apart, in 90 frames.
  EXPECT_EQ(classified.probabilities.size(1), 2);
  EXPECT_EQ(classified.features.size(0), 7);
  EXPECT_LT((classified.probabilities.sum(1) - 1).abs().max().item<float>(), 1e-5f);
  EXPECT_GT(classified.probabilities.select(1, 1).min().item<float>(), 0.9f);

  // What is shorter than a window is held at its last frame.
  const Classification one = classifier.classify(test::styled_take("proud", "walk", 3, 12));
  ASSERT_EQ(one.probabilities.size(0), 1);
  EXPECT_GT(one.probabilities[0][0].item<float>(), 0.5f);
}

}  // namespace
}  // namespace panache
