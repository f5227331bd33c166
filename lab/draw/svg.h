#pragma once
// Drawings as SVG files: a few shapes, one after another, later ones on top.

#include <string>
#include <string_view>
#include <vector>

namespace panache {

// x to the right, y down, in pixels.
struct Point {
  double x = 0, y = 0;
};

// A line's look. Ends and corners are round.
struct Stroke {
  std::string colour = "#000000";
  double width = 1;
  double opacity = 1;
  std::string dashes;  // Lengths of dash and gap ("4 3"); empty for none.
};

struct TextStyle {
  double size = 12;  // Pixels.
  std::string colour = "#333333";
  enum class Anchor { start, middle, end } anchor = Anchor::start;  // Which part stands at x.
  bool bold = false;
  bool upwards = false;  // Turned to be read from below.
};

// Coordinates have two decimals; those that are not finite count as 0. Texts are UTF-8 of any
// content: what XML cannot hold is replaced.
class Svg {
 public:
  // A drawing of this size on a white ground.
  Svg(double width, double height);

  void line(Point from, Point to, const Stroke& stroke);
  void polyline(const std::vector<Point>& points, const Stroke& stroke);
  void circle(Point centre, double radius, std::string_view fill);
  // `radius` rounds the corners.
  void rect(Point corner, double width, double height, std::string_view fill, double radius = 0);
  // `at` is on the base line.
  void text(Point at, std::string_view text, const TextStyle& style);

  // The whole file.
  std::string str() const;

 private:
  double width_, height_;
  std::string shapes_;
};

// About how wide `text` is when drawn at `size`, pixels.
double text_width(std::string_view text, double size);

// The colour of the i-th of several things: told apart by the colour-blind too, on white.
std::string palette(size_t i);

// `colour` ("#rrggbb") on its way to white (amount 1) or black (amount -1); others are left alone.
std::string tinted(const std::string& colour, double amount);

}  // namespace panache
