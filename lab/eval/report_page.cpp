// The report as one page that needs nothing but itself: the page of the folder `page`, with the
// film strips and report.json in it.

#include <cassert>

#include "base/xml.h"
#include "draw/strip.h"
#include "eval/report.h"

namespace panache {

// The folder `page` as one text; CMakeLists.txt makes it.
extern const std::string_view kReportPage;

namespace {

void put(std::string& page, std::string_view mark, const std::string& text) {
  const size_t at = page.find(mark);
  assert(at != page.npos);
  page.replace(at, mark.size(), text);
}

std::string strips_html(const Report& report) {
  std::string out;
  for (const StripReport& strip : report.strips) {
    if (strip.rows.empty()) continue;
    StripOptions options;
    options.title = strip.title;
    options.seconds_between = strip.seconds_between;
    constexpr std::string_view kStart = "<svg";
    const std::string svg = draw_strip(strip.rows, options);
    assert(svg.starts_with(kStart));
    out += "<figure class=\"wide\"><svg role=\"img\" aria-label=\"Film strip: " +
           xml_escaped(strip.title) + "\"" + svg.substr(kStart.size()) + "</figure>\n";
  }
  return out;
}

// JSON between the tags of a script, which "</script>" or "<!--" in a name would end or open.
std::string json_for_html(const std::string& json) {
  std::string out;
  for (const char c : json) out += c == '<' ? "\\u003c" : std::string(1, c);
  return out;
}

}  // namespace

std::string report_page(const Report& report) {
  std::string page(kReportPage);
  put(page, "<!--report-->", json_for_html(report_json(report)));
  put(page, "<!--strips-->", strips_html(report));
  return page;
}

}  // namespace panache
