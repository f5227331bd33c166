#include "draw/svg.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "base/text.h"

namespace panache {
namespace {

// "12.34" in any locale; "12" rather than "12.00".
std::string decimal(double value) {
  constexpr double kLargest = 1e9;
  if (!std::isfinite(value)) value = 0;
  const long long hundredths = std::llround(std::clamp(value, -kLargest, kLargest) * 100);
  const long long whole = std::llabs(hundredths) / 100, rest = std::llabs(hundredths) % 100;
  std::string text = hundredths < 0 ? "-" : "";
  text += std::to_string(whole);
  if (rest == 0) return text;
  text += rest < 10 ? ".0" : ".";
  text += std::to_string(rest % 10 == 0 && rest >= 10 ? rest / 10 : rest);
  return text;
}

// A space and name="value".
std::string attribute(std::string_view name, std::string_view value) {
  std::string out(1, ' ');
  out += name;
  out += "=\"";
  out += xml_escaped(value);
  return out += '"';
}
std::string attribute(std::string_view name, double value) {
  return attribute(name, std::string_view(decimal(value)));
}

std::string stroke_attributes(const Stroke& stroke) {
  std::string out = attribute("stroke", stroke.colour) + attribute("stroke-width", stroke.width) +
                    " stroke-linecap=\"round\" stroke-linejoin=\"round\"";
  if (stroke.opacity != 1) out += attribute("stroke-opacity", stroke.opacity);
  if (!stroke.dashes.empty()) out += attribute("stroke-dasharray", stroke.dashes);
  return out;
}

}  // namespace

Svg::Svg(double width, double height) : width_(width), height_(height) {
  rect({0, 0}, width, height, "#ffffff");
}

void Svg::line(Point from, Point to, const Stroke& stroke) {
  shapes_ += "<line" + attribute("x1", from.x) + attribute("y1", from.y) + attribute("x2", to.x) +
             attribute("y2", to.y) + stroke_attributes(stroke) + "/>\n";
}

void Svg::polyline(const std::vector<Point>& points, const Stroke& stroke) {
  std::string list;
  for (const Point& p : points) {
    if (!list.empty()) list += ' ';
    list += decimal(p.x) + "," + decimal(p.y);
  }
  shapes_ +=
      "<polyline fill=\"none\"" + stroke_attributes(stroke) + attribute("points", list) + "/>\n";
}

void Svg::circle(Point centre, double radius, std::string_view fill) {
  shapes_ += "<circle" + attribute("cx", centre.x) + attribute("cy", centre.y) +
             attribute("r", radius) + attribute("fill", fill) + "/>\n";
}

void Svg::rect(Point corner, double width, double height, std::string_view fill, double radius) {
  shapes_ += "<rect" + attribute("x", corner.x) + attribute("y", corner.y) +
             attribute("width", width) + attribute("height", height) +
             (radius > 0 ? attribute("rx", radius) : "") + attribute("fill", fill) + "/>\n";
}

void Svg::text(Point at, std::string_view text, const TextStyle& style) {
  constexpr const char* kAnchors[] = {"start", "middle", "end"};
  shapes_ += "<text" + attribute("x", at.x) + attribute("y", at.y) +
             attribute("font-size", style.size) + attribute("fill", style.colour) +
             attribute("text-anchor", kAnchors[static_cast<int>(style.anchor)]) +
             (style.bold ? attribute("font-weight", "bold") : "");
  if (style.upwards) {
    shapes_ += attribute("transform", "rotate(-90 " + decimal(at.x) + " " + decimal(at.y) + ")");
  }
  shapes_ += '>';
  shapes_ += xml_escaped(text);
  shapes_ += "</text>\n";
}

std::string Svg::str() const {
  return "<svg xmlns=\"http://www.w3.org/2000/svg\"" + attribute("width", width_) +
         attribute("height", height_) +
         attribute("viewBox", "0 0 " + decimal(width_) + " " + decimal(height_)) +
         " font-family=\"Helvetica, Arial, 'Liberation Sans', sans-serif\">\n" + shapes_ +
         "</svg>\n";
}

double text_width(std::string_view text, double size) {
  // The mean width of a Helvetica character is a little over half its size.
  return 0.55 * size * static_cast<double>(character_count(text));
}

std::string palette(size_t i) {
  // Okabe and Ito's palette, with light colours darkened for a white background.
  constexpr std::array<const char*, 7> kColours = {"#0072b2", "#d55e00", "#009e73", "#aa3377",
                                                   "#56a4d9", "#c99700", "#555555"};
  return kColours[i % kColours.size()];
}

std::string tinted(const std::string& colour, double amount) {
  const bool hex = colour.size() == 7 && colour[0] == '#' &&
                   colour.find_first_not_of("0123456789abcdefABCDEF", 1) == std::string::npos;
  if (!hex) return colour;
  const double end = amount > 0 ? 255 : 0, share = std::min(std::abs(amount), 1.0);
  std::string out = "#";
  for (int channel = 0; channel < 3; ++channel) {
    const long from = std::strtol(colour.substr(1 + 2 * channel, 2).c_str(), nullptr, 16);
    const long to = std::lround(static_cast<double>(from) * (1 - share) + end * share);
    constexpr char kDigits[] = "0123456789abcdef";
    out += kDigits[to / 16];
    out += kDigits[to % 16];
  }
  return out;
}

}  // namespace panache
