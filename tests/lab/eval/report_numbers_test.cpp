#include "eval/report_numbers.h"

#include <cmath>

#include <gtest/gtest.h>

#include "eval/make_report.h"

namespace panache {
namespace {

using test::numbers;

TEST(ReportNumbers, numbers_are_written_alike_everywhere) {
  EXPECT_EQ(number_text(0.9996, 3), "1.000");
  EXPECT_EQ(number_text(-0.0004, 3), "0.000");
  EXPECT_EQ(number_text(-0.5, 1), "-0.5");
  EXPECT_EQ(number_text(kNotMeasured, 2), kDash);
  EXPECT_EQ(count_text(0), kDash);
  EXPECT_EQ(count_text(999), "999");
  EXPECT_EQ(count_text(1234567), "1,234,567");
}

TEST(ReportNumbers, means_and_quantiles_leave_out_what_was_not_measured) {
  EXPECT_EQ(quantile({3, kNotMeasured, 1, 2}, 0.5), 2);
  EXPECT_EQ(quantile({1, 2}, 0.5), 1.5);
  EXPECT_TRUE(std::isnan(quantile({}, 0.5)));
  Metrics a = numbers(0.2), b = numbers(0.4);
  b["fmd"] = kNotMeasured;
  const Metrics mean = mean_metrics(MetricsTable{{"a", a}, {"b", b}});
  EXPECT_EQ(mean.takes, a.takes + b.takes);
  EXPECT_DOUBLE_EQ(mean["style_accuracy"], (a["style_accuracy"] + b["style_accuracy"]) / 2);
  EXPECT_EQ(mean["fmd"], a["fmd"]);
}

}  // namespace
}  // namespace panache
