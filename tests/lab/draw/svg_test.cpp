#include "draw/svg.h"

#include <limits>

#include <gtest/gtest.h>

#include "base/xml_check.h"

namespace panache {
namespace {

std::string text_element(std::string_view text) {
  Svg svg(10, 10);
  svg.text({1, 2}, text, {});
  const std::string file = svg.str();
  EXPECT_EQ(xml_problem(file), "") << file;
  const size_t start = file.find("<text"), end = file.find("</text>");
  const size_t content = file.find('>', start) + 1;
  return file.substr(content, end - content);
}

TEST(XmlCheck, tells_well_formed_from_broken) {
  EXPECT_EQ(xml_problem("<a b=\"1\"><c/>x &lt; y</a>\n"), "");
  for (const char* bad : {"", "<a>", "<a></b>", "<a b=1/>", "<a/><a/>", "<a>&x;</a>", "<a>\x01</a>",
                          "<a b=\"<\"/>", "<a b=\"1\" b=\"2\"/>", "x<a/>", "<a", "<a b=\"1"}) {
    EXPECT_NE(xml_problem(bad), "") << bad;
  }
}

TEST(Svg, the_file_is_what_was_drawn) {
  Svg svg(30, 20.5);
  svg.line({0, 1}, {2.256, -3}, {"#ff0000", 2, 0.5, "4 3"});
  svg.polyline({{1, 2}, {3.1, 4}}, {});
  svg.circle({5, 6}, 7, "#00ff00");
  svg.rect({1, 2}, 3, 4, "#0000ff", 1);
  svg.text({8, 9}, "up", {11, "#123456", TextStyle::Anchor::end, true, true});
  EXPECT_EQ(
      svg.str(),
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"30\" height=\"20.5\" "
      "viewBox=\"0 0 30 20.5\" font-family=\"Helvetica, Arial, 'Liberation Sans', sans-serif\">\n"
      "<rect x=\"0\" y=\"0\" width=\"30\" height=\"20.5\" fill=\"#ffffff\"/>\n"
      "<line x1=\"0\" y1=\"1\" x2=\"2.26\" y2=\"-3\" stroke=\"#ff0000\" stroke-width=\"2\" "
      "stroke-linecap=\"round\" stroke-linejoin=\"round\" stroke-opacity=\"0.5\" "
      "stroke-dasharray=\"4 3\"/>\n"
      "<polyline fill=\"none\" stroke=\"#000000\" stroke-width=\"1\" stroke-linecap=\"round\" "
      "stroke-linejoin=\"round\" points=\"1,2 3.1,4\"/>\n"
      "<circle cx=\"5\" cy=\"6\" r=\"7\" fill=\"#00ff00\"/>\n"
      "<rect x=\"1\" y=\"2\" width=\"3\" height=\"4\" rx=\"1\" fill=\"#0000ff\"/>\n"
      "<text x=\"8\" y=\"9\" font-size=\"11\" fill=\"#123456\" text-anchor=\"end\" "
      "font-weight=\"bold\" transform=\"rotate(-90 8 9)\">up</text>\n"
      "</svg>\n");
}

TEST(Svg, text_is_escaped) {
  EXPECT_EQ(text_element("a < b & \"c\" > d"), "a &lt; b &amp; &quot;c&quot; &gt; d");
  EXPECT_EQ(text_element("caf\xc3\xa9 \xf0\x9f\x92\x83"), "caf\xc3\xa9 \xf0\x9f\x92\x83");
}

TEST(Svg, what_xml_cannot_hold_is_replaced) {
  const std::string mark = "\xef\xbf\xbd";
  EXPECT_EQ(text_element(std::string("a\0b\x1b", 4)), "a" + mark + "b" + mark);
  EXPECT_EQ(text_element("\xff"), mark);                        // No UTF-8.
  EXPECT_EQ(text_element("\xc3"), mark);                        // Cut short.
  EXPECT_EQ(text_element("\xc0\xaf"), mark + mark);             // Longer than need be.
  EXPECT_EQ(text_element("\xed\xa0\x80"), mark + mark + mark);  // Half a surrogate pair.
  EXPECT_EQ(text_element("\xef\xbf\xbe"), mark);                // U+FFFE.
  EXPECT_EQ(text_element("\xe0\x9f\xbf"), mark + mark + mark);
  EXPECT_EQ(text_element("\xf0\x8f\xbf\xbf"), mark + mark + mark + mark);
  EXPECT_EQ(text_element("\xf4\x90\x80\x80"), mark + mark + mark + mark);  // Beyond U+10FFFF.
  EXPECT_EQ(text_element("\xf5\x80\x80\x80"), mark + mark + mark + mark);
  EXPECT_EQ(text_element("\x7f\t"), mark + "\t");
  // The first and the last of each length, and what is beside the surrogates.
  for (const std::string good : {"\xc2\x80", "\xdf\xbf", "\xe0\xa0\x80", "\xed\x9f\xbf",
                                 "\xee\x80\x80", "\xf0\x90\x80\x80", "\xf4\x8f\xbf\xbf"}) {
    EXPECT_EQ(text_element(good), good);
  }
}

TEST(Svg, attributes_are_escaped_too) {
  Svg svg(1, 1);
  svg.circle({0, 0}, 1, "\"/><script>");
  EXPECT_EQ(xml_problem(svg.str()), "");
  EXPECT_EQ(svg.str().find("<script"), std::string::npos);
}

TEST(Svg, numbers_are_short_finite_and_bounded) {
  const auto radius = [](double value) {
    Svg svg(1, 1);
    svg.circle({0, 0}, value, "red");
    const std::string file = svg.str();
    const size_t start = file.find(" r=\"") + 4;
    return file.substr(start, file.find('"', start) - start);
  };
  EXPECT_EQ(radius(1), "1");
  EXPECT_EQ(radius(-0.001), "0");
  EXPECT_EQ(radius(-0.05), "-0.05");
  EXPECT_EQ(radius(1.5), "1.5");
  EXPECT_EQ(radius(0.1), "0.1");
  EXPECT_EQ(radius(99.999), "100");
  EXPECT_EQ(radius(std::numeric_limits<double>::quiet_NaN()), "0");
  EXPECT_EQ(radius(std::numeric_limits<double>::infinity()), "0");
  EXPECT_EQ(radius(1e300), "1000000000");
}

TEST(Svg, tints_go_to_white_and_to_black) {
  EXPECT_EQ(tinted("#204060", 0), "#204060");
  EXPECT_EQ(tinted("#204060", 1), "#ffffff");
  EXPECT_EQ(tinted("#204060", -1), "#000000");
  EXPECT_EQ(tinted("#204060", -0.5), "#102030");
  EXPECT_EQ(tinted("red", 0.5), "red");
  EXPECT_EQ(tinted("#20406", 0.5), "#20406");
}

}  // namespace
}  // namespace panache
