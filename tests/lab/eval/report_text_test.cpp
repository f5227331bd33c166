// The report as a text, and what is put into its page, which is tested in a browser:
// page/page.test.mjs.

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/text.h"
#include "base/xml_check.h"
#include "eval/make_report.h"
#include "eval/report.h"
#include "eval/report_numbers.h"

namespace panache {
namespace {

using test::kRude;
using test::made_up_report;
using test::made_up_system;
using test::numbers;

// The lines of a text that are wider than a terminal of ours, as its reader counts.
std::string lines_too_long(const std::string& text) {
  std::istringstream lines(text);
  std::string found;
  for (std::string line; std::getline(lines, line);) {
    if (character_count(line) > 110) found += line + "\n";
  }
  return found;
}

TEST(ReportText, no_line_is_wider_than_110_columns) {
  Report report = made_up_report();
  EXPECT_EQ(lines_too_long(report_text(report)), "");
  // Many systems with long names, many long contents, numbers as large as they may become.
  const std::string long_name = "a system with a name that does not end \xc3\xa9\xc3\xa9 " + kRude;
  for (int i = 0; i < 7; ++i) {
    report.systems.push_back(made_up_system(long_name + std::to_string(i), 0.7));
    report.systems.back().by_content[long_name + long_name] = numbers(1e15);
    report.systems.back().seen = numbers(-1e15);
    report.systems.back().disturbances[0].name = long_name + long_name + long_name;
    report.systems.back().unseen[0].name = long_name + long_name + long_name;
  }
  EXPECT_EQ(lines_too_long(report_text(report)), "");
}

TEST(ReportText, columns_are_aligned) {
  const std::string text = report_text(made_up_report());
  std::istringstream lines(text);
  std::vector<std::string> table;
  for (std::string line; std::getline(lines, line) && !line.empty();) table.push_back(line);
  // A title, two lines of headings, real takes, input, two systems.
  ASSERT_EQ(table.size(), 7u);
  EXPECT_TRUE(table[3].starts_with("real takes")) << table[3];
  EXPECT_TRUE(table[5].starts_with("panache")) << table[5];
  for (size_t line = 3; line < table.size(); ++line) {
    EXPECT_EQ(character_count(table[line]), character_count(table[2])) << table[line];
  }
  EXPECT_NE(table[5].find("0.801"), std::string::npos);
}

TEST(ReportText, a_weak_classifier_is_set_beside_real_takes) {
  Report report = made_up_report();
  EXPECT_TRUE(ceiling_notes(report).empty());
  EXPECT_NE(report_text(report).find("Style recognised by strength (real takes: 0.97"),
            std::string::npos);
  report.real["style_accuracy"] = 0.72;
  report.real["content_accuracy"] = 0.5;
  const std::vector<std::string> notes = ceiling_notes(report);
  ASSERT_EQ(notes.size(), 2u);
  EXPECT_EQ(notes[0],
            "The style classifier recognises 0.720 of the windows of real held-out takes, less "
            "than 0.950: compare its figures (style, style probability, strengths and mixes) with "
            "those of the real takes, not with 1.");
  EXPECT_TRUE(notes[1].starts_with("The content classifier recognises 0.500 of the windows"));
  std::string text = report_text(report);
  EXPECT_EQ(lines_too_long(text), "");
  EXPECT_NE(text.find("(real takes: 0.720)"), std::string::npos);
  std::replace(text.begin(), text.end(), '\n', ' ');
  for (const std::string& note : notes) {
    EXPECT_NE(text.find(note), std::string::npos) << text;
    EXPECT_NE(report_page(report).find(note), std::string::npos);
    EXPECT_NE(report_json(report).find(note), std::string::npos);
  }
}

TEST(ReportText, all_its_parts_are_there) {
  const std::string text = report_text(made_up_report());
  for (const char* part :
       {"Overall", "By content", "Style recognised by strength", "Content kept by strength",
        "split A", "split B", "Out-of-distribution motion", "Disturbed windows", "floor -5 cm",
        "Whole clips before the judge of their performer", "Motion of other performers",
        "The same clips before the judges", "all styles", "Input prediction", "Persons: panache"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part;
  }
  EXPECT_EQ(occurrences(report_text(Report()), "Foreign"), 0u);
}

// What is put into the page of a report. The page itself is tested in a browser:
// page/page.test.mjs.

// What stands between `open` and the next `close`.
std::string between(const std::string& page, std::string_view open, std::string_view close) {
  const size_t from = page.find(open);
  EXPECT_NE(from, page.npos) << open;
  const size_t begin = from + open.size();
  return page.substr(begin, page.find(close, begin) - begin);
}
std::string numbers_in(const std::string& page) {
  return between(page, "<script id=\"report\" type=\"application/json\">", "</script>");
}

TEST(ReportPage, it_holds_the_numbers_of_the_json) {
  using OrderedJson = nlohmann::ordered_json;
  const Report report = made_up_report();
  EXPECT_EQ(OrderedJson::parse(numbers_in(report_page(report))),
            OrderedJson::parse(report_json(report)));
  EXPECT_EQ(OrderedJson::parse(numbers_in(report_page(Report()))),
            OrderedJson::parse(report_json(Report())));
}

TEST(ReportPage, it_asks_the_network_for_nothing) {
  const std::string page = report_page(made_up_report());
  for (const char* reference :
       {"src=", "url(", "@import", "<link", "import(", "fetch(", "<iframe"}) {
    EXPECT_EQ(occurrences(page, reference), 0u) << reference;
  }
  // The name of SVG's kind of XML is a name, not an address to load from.
  EXPECT_EQ(occurrences(page, "http"), occurrences(page, "http://www.w3.org/2000/svg"));
}

TEST(ReportPage, no_name_ends_the_script_or_breaks_a_strip) {
  Report report = made_up_report();
  const std::string before = report_page(report);
  const std::string name = "</script><!--" + kRude + "</template>";
  report.systems[0].name = report.systems[0].recipe = report.styles[0] = name;
  report.strips[0].title = report.strips[0].rows[0].label = name;
  const std::string page = report_page(report);
  for (const char* tag : {"</script>", "<!--", "</template>", "<script"}) {
    EXPECT_EQ(occurrences(page, tag), occurrences(before, tag)) << tag;
  }
  const std::string strips = between(page, "<template id=\"drawn-strips\">", "</template>");
  EXPECT_EQ(xml_problem(strips), "");
  EXPECT_EQ(occurrences(strips, "<figure"), 1u);
}

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
