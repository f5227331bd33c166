#include "train/statistics_guide.h"

#include <gtest/gtest.h>

#include "make_styled_takes.h"
#include "train/classifier.h"
#include "train/matrix_products.h"

namespace panache {
namespace {

const std::vector<std::string> kClasses = {"old", "proud", "neutral"};

// The first second of a take. [1][kClassifiedPoses][21][3]
torch::Tensor bodies_of(const Take& take) {
  torch::Tensor bodies = torch::empty({1, kClassifiedPoses, kHumanJoints, 3});
  float* to = bodies.data_ptr<float>();
  for (int p = 0; p < kClassifiedPoses; ++p) {
    for (const Vec3& joint : take.body[p * kClassifiedSpacing]) {
      *to++ = joint.x, *to++ = joint.y, *to++ = joint.z;
    }
  }
  return bodies;
}

StatisticsGuide guide() {
  EXPECT_TRUE(prepare_matrix_products().ok());
  const std::vector<Take> takes = test::styled_takes({"old", "proud", "neutral"}, {0, 1});
  std::vector<std::string> labels;
  for (const Take& take : takes) labels.push_back(take.row.style);
  return StatisticsGuide(takes, labels, kClasses);
}

TEST(StatisticsGuide, knows_the_styles_of_takes_that_it_has_not_seen) {
  const StatisticsGuide known = guide();
  for (size_t c = 0; c < kClasses.size(); ++c) {
    const torch::Tensor bodies = bodies_of(test::styled_take(kClasses[c], "walk", 3));
    for (size_t other = 0; other < kClasses.size(); ++other) {
      if (other == c) continue;
      const auto loss = [&](size_t wanted) {
        return known.loss(bodies, torch::tensor({static_cast<int64_t>(wanted)}), 0).item<float>();
      };
      EXPECT_LT(loss(c) + 1, loss(other)) << kClasses[c] << " for " << kClasses[other];
    }
  }
}

TEST(StatisticsGuide, its_gradient_leads_to_the_style) {
  const StatisticsGuide known = guide();
  torch::Tensor bodies = bodies_of(test::styled_take("neutral", "walk", 3)).set_requires_grad(true);
  const torch::Tensor wanted = torch::tensor({int64_t{0}});
  const torch::Tensor before = known.loss(bodies, wanted, 0);
  before.backward();
  ASSERT_TRUE(bodies.grad().isfinite().all().item<bool>());
  const double slope = bodies.grad().square().sum().item<double>();
  EXPECT_GT(slope, 0);
  const torch::Tensor moved = (bodies - 0.1 / slope * bodies.grad()).detach();
  EXPECT_LT(known.loss(moved, wanted, 0).item<double>(), before.item<double>() - 0.02);
}

TEST(MotionStatistics, of_a_body_at_rest_have_a_slope) {
  torch::Tensor bodies = bodies_of(test::styled_take("neutral", "walk", 0)).slice(1, 0, 1);
  bodies = bodies.repeat({1, kClassifiedPoses, 1, 1}).set_requires_grad(true);
  motion_statistics(bodies).sum().backward();
  EXPECT_TRUE(bodies.grad().isfinite().all().item<bool>());
}

TEST(LinearDiscriminant, puts_the_border_half_way_whatever_the_spread_across) {
  torch::manual_seed(1);
  const auto cloud = [](double x) {
    return torch::randn({400, 2}, torch::kFloat64) * torch::tensor({1.0, 5.0}, torch::kFloat64) +
           torch::tensor({x, 0.0}, torch::kFloat64);
  };
  const LinearDiscriminant found({cloud(-3), cloud(3)});
  const torch::Tensor left = torch::tensor({{-1.0, 8.0}, {1.0, 8.0}}, torch::kFloat64);
  const torch::Tensor scores = found.scores(left);
  EXPECT_GT((scores[0][0] - scores[0][1]).item<double>(), 1);
  EXPECT_GT((scores[1][1] - scores[1][0]).item<double>(), 1);
}

}  // namespace
}  // namespace panache
