// What is put into the page of a report. The page itself is tested in a browser:
// page/page.test.mjs.

#include "eval/report.h"

#include <string_view>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/xml_check.h"
#include "eval/make_report.h"

namespace panache {
namespace {

using test::kRude;
using test::made_up_report;

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
  using Json = nlohmann::ordered_json;
  const Report report = made_up_report();
  EXPECT_EQ(Json::parse(numbers_in(report_page(report))), Json::parse(report_json(report)));
  EXPECT_EQ(Json::parse(numbers_in(report_page(Report()))), Json::parse(report_json(Report())));
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

}  // namespace
}  // namespace panache
