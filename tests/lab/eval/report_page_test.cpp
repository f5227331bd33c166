#include "eval/report.h"

#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "draw/svg.h"
#include "base/xml_check.h"
#include "eval/make_report.h"

namespace panache {
namespace {

using test::kRude;
using test::kRudeEscaped;
using test::made_up_report;
using test::numbers;

// A page without its first line, which is not XML.
std::string_view without_doctype(std::string_view page) {
  constexpr std::string_view kDoctype = "<!DOCTYPE html>\n";
  EXPECT_TRUE(page.starts_with(kDoctype));
  return page.substr(kDoctype.size());
}

TEST(ReportPage, it_is_well_formed) {
  EXPECT_EQ(xml_problem(without_doctype(report_page(made_up_report()))), "");
  EXPECT_EQ(xml_problem(without_doctype(report_page(Report()))), "");
}

TEST(ReportPage, it_asks_the_network_for_nothing) {
  const std::string page = report_page(made_up_report());
  for (const char* reference :
       {"src=", "url(", "@import", "<link", "<script", "<iframe", "srcset"}) {
    EXPECT_EQ(occurrences(page, reference), 0u) << reference;
  }
  // Links lead to places on the page that exist.
  EXPECT_GT(occurrences(page, "href=\""), 5u);
  for (size_t at = page.find("href=\""); at != page.npos; at = page.find("href=\"", at + 1)) {
    ASSERT_EQ(page[at + 6], '#');
    const std::string id = page.substr(at + 7, page.find('"', at + 7) - at - 7);
    EXPECT_EQ(occurrences(page, "id=\"" + id + "\""), 1u) << id;
  }
  // The name of SVG's kind of XML is a name, not an address to load from.
  EXPECT_EQ(occurrences(page, "http"), occurrences(page, "xmlns=\"http://www.w3.org/2000/svg\""));
}

TEST(ReportPage, names_are_escaped_wherever_they_stand) {
  Report report = made_up_report();
  report.tested_on = report.trained_on = report.styles = {kRude};
  report.contents.push_back(kRude);
  report.systems[0].by_content[kRude] = report.systems[0].by_style[kRude] = numbers(0.5);
  report.systems[0].mixes[0].first = kRude;
  report.systems[0].ood[0].clip = report.systems[0].ood[0].style = kRude;
  report.systems[0].disturbances[0].name = kRude;
  report.systems[0].recipe = report.systems[0].unseen[0].name = kRude;
  report.systems[0].clips[0].style = report.systems[0].clips[0].verdict = kRude;
  report.systems[0].clips_across[0].style = report.real_clips[0].style = kRude;
  report.systems[0].unseen[0].clips[0].content = kRude;
  report.systems[0].unseen[0].by_content[kRude] = numbers(0.5);
  report.strips[0].title = report.strips[0].rows[0].label = kRude;
  report.contacts[0].title = report.contacts[0].rows[0].label = kRude;
  const std::string page = report_page(report);
  EXPECT_EQ(xml_problem(without_doctype(page)), "");
  EXPECT_EQ(occurrences(page, "<b> &"), 0u);
  EXPECT_GT(occurrences(page, kRudeEscaped), 20u);
  // Neither twice.
  EXPECT_EQ(occurrences(page, "&amp;lt;"), 0u);
}

TEST(ReportPage, a_section_without_data_is_left_out) {
  const std::string full = report_page(made_up_report());
  Report report = made_up_report();
  report.strips.clear();
  report.contacts.clear();
  report.real_clips.clear();
  report.real_clips_across.clear();
  for (SystemReport& system : report.systems) {
    SystemReport bare;
    bare.name = system.name;
    bare.seen = system.seen;
    system = bare;
  }
  const std::string page = report_page(report);
  for (const char* section :
       {"content", "style", "performers", "strength", "mixes", "unseen", "foreign", "disturbances",
        "foresight", "strips", "contacts", "literature", "cost"}) {
    const std::string id = "<section id=\"" + std::string(section) + "\">";
    EXPECT_EQ(occurrences(full, id), 1u) << section;
    EXPECT_EQ(occurrences(page, id), 0u) << section;
  }
  for (const char* section : {"judged", "overall", "definitions"}) {
    EXPECT_EQ(occurrences(page, "<section id=\"" + std::string(section) + "\">"), 1u) << section;
  }
}

TEST(ReportPage, confusions_are_drawn_of_real_takes_and_of_each_system) {
  const std::string page = report_page(made_up_report());
  EXPECT_EQ(occurrences(page, "aria-label=\"Confusion of styles, real takes\""), 1u);
  EXPECT_EQ(occurrences(page, "aria-label=\"Confusion of styles, panache\""), 1u);
  EXPECT_EQ(occurrences(page, "What clips are taken for"), 3u);
}

TEST(ReportPage, every_column_of_the_overall_table_is_defined) {
  const std::string page = report_page(made_up_report());
  for (const Measure& measure : measures()) {
    EXPECT_EQ(occurrences(page, "<dt>" + std::string(measure.label) + "</dt>"), 1u)
        << measure.label;
  }
}

TEST(ReportPage, the_best_system_is_marked_with_more_than_colour) {
  Report report;
  report.real = numbers(0.97);
  SystemReport first, second;
  first.name = "first";
  second.name = "second";
  first.seen["style_accuracy"] = 0.5;
  second.seen["style_accuracy"] = 0.75;
  first.seen["jerk_ratio"] = 0.9;  // Nearer to 1, from below and from above.
  second.seen["jerk_ratio"] = 0.5;
  first.seen["cadence_ratio"] = 0.7;
  second.seen["cadence_ratio"] = 1.1;
  first.seen["pose_error_cm"] = 3.001;  // Printed alike.
  second.seen["pose_error_cm"] = 3.004;
  first.seen["fmd"] = 2;  // Nothing to compare it with.
  report.systems = {first, second};
  const std::string page = report_page(report);
  const auto marked = [&](const std::string& number) {
    return occurrences(page, "<b>\xe2\x80\xa2 " + number + "</b>");
  };
  EXPECT_EQ(marked("0.750"), 1u);
  EXPECT_EQ(marked("0.90"), 1u);
  EXPECT_EQ(marked("1.10"), 1u);
  EXPECT_EQ(marked("3.00"), 2u);
  EXPECT_EQ(occurrences(page, "<b>"), 5u);
}

TEST(ReportPage, a_number_that_was_not_measured_is_a_dash) {
  Report report;
  report.real = numbers(0.97);
  report.real["fmd"] = kNotMeasured;
  const std::string page = report_page(report);
  EXPECT_EQ(occurrences(page, "nan"), 0u);
  EXPECT_EQ(occurrences(page, "<td>0.98</td><td>0.98</td><td>\xe2\x80\x93</td>"), 1u);
}

TEST(ReportPage, classifiers_that_are_not_good_enough_are_told_of) {
  Report report = made_up_report();
  EXPECT_EQ(occurrences(report_page(report), "class=\"warning\""), 0u);
  report.real["style_accuracy"] = 0.94;
  EXPECT_EQ(occurrences(report_page(report), "class=\"warning\""), 1u);
  EXPECT_EQ(occurrences(report_text(report), "The style classifier recognises 0.940"), 1u);
  report.real["content_accuracy"] = kNotMeasured;
  EXPECT_EQ(occurrences(report_page(report), "class=\"warning\""), 2u);
  EXPECT_EQ(occurrences(report_text(report), "The content classifier recognises \xe2\x80\x93"), 1u);
}

TEST(ReportPage, a_planted_foot_is_a_bar_as_long_as_it_stands) {
  Report report;
  // Ten frames a second: the left foot stands for 2 of 4 seconds, the right one twice for half a
  // second.
  ContactRow row{"input", 10, std::vector<FootContacts>(40)};
  for (size_t f = 0; f < 40; ++f) {
    row.contacts[f] = {f < 20, (f >= 5 && f < 10) || f >= 35};
  }
  report.contacts = {{"walk", {row}}};
  const std::string page = report_page(report);
  // Tracks, light bars of the left foot, dark ones of the right.
  const auto widths = [&](const std::string& colour) {
    std::vector<double> found;
    const std::string fill = "rx=\"2\" fill=\"" + colour + "\"";
    for (size_t at = page.find(fill); at != page.npos; at = page.find(fill, at + 1)) {
      found.push_back(std::stod(page.substr(page.rfind("width=\"", at) + 7)));
    }
    return found;
  };
  const std::vector<double> tracks = widths("#f1f1f1"), left = widths(tinted(palette(0), 0.52));
  const std::vector<double> right = widths(palette(0));
  ASSERT_EQ(tracks.size(), 2u);
  ASSERT_EQ(left.size(), 1u);
  ASSERT_EQ(right.size(), 2u);
  // Hundredths of a pixel are written.
  EXPECT_NEAR(left[0], tracks[0] / 2, 0.011);
  EXPECT_NEAR(right[0], tracks[1] / 8, 0.011);
  EXPECT_NEAR(right[1], tracks[1] / 8, 0.011);
}

}  // namespace
}  // namespace panache
