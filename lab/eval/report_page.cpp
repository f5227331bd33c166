// The report as one page that needs nothing but itself: the page of the folder `page`, with the
// film strips and report.json in it; and both as a folder.

#include <cassert>
#include <filesystem>

#include "base/file.h"
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

Result<void> write_report(const Report& report, const std::string& folder) {
  namespace fs = std::filesystem;
  std::error_code status;
  const fs::path path = folder.empty() ? "." : folder;
  if (fs::exists(path, status) && !fs::is_directory(path, status)) {
    return Error{folder + ": is a file; expected a folder to write the report into"};
  }
  fs::create_directories(path, status);
  if (!fs::is_directory(path, status)) {
    return Error{folder + ": cannot be made; expected a place where a folder may be written"};
  }
  const std::string json = report_json(report), page = report_page(report);
  Result<void> written = write_file((path / "report.json").string(), json, true);
  if (!written) return written;
  return write_file((path / "index.html").string(), page, true);
}

}  // namespace panache
