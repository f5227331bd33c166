#pragma once
// SVG drawings: simple shapes, later ones on top.

#include <string>
#include <string_view>
#include <vector>

namespace panache {

// x to the right, y down, in pixels.
struct Point {
  double x = 0, y = 0;
};

// Line style, with round caps and joins.
struct Stroke {
  std::string colour = "#000000";
  double width = 1;
  double opacity = 1;
  std::string dashes;  // Lengths of dash and gap ("4 3"); empty: solid.
};

struct TextStyle {
  double size = 12;  // Pixels.
  std::string colour = "#333333";
  enum class Anchor { start, middle, end } anchor = Anchor::start;  // The part of the text at x.
  bool bold = false;
  bool upwards = false;  // Rotated by 90 degrees to read upwards.
};

// Coordinates have two decimals; non-finite ones count as 0. Texts are any UTF-8; characters that
// XML does not allow are replaced.
class Svg {
 public:
  // A drawing of this size with a white background.
  Svg(double width, double height);

  void line(Point from, Point to, const Stroke& stroke);
  void polyline(const std::vector<Point>& points, const Stroke& stroke);
  void circle(Point centre, double radius, std::string_view fill);
  // `radius` rounds the corners.
  void rect(Point corner, double width, double height, std::string_view fill, double radius = 0);
  // `at` is on the baseline.
  void text(Point at, std::string_view text, const TextStyle& style);

  // The whole file.
  std::string str() const;

 private:
  double width_, height_;
  std::string shapes_;
};

// The approximate width of `text` at `size`, pixels.
double text_width(std::string_view text, double size);

// The i-th colour of a palette that is safe for colour-blind readers, on white.
std::string palette(size_t i);

// Blends `colour` ("#rrggbb") towards white (amount 1) or black (amount -1); others stay unchanged.
std::string tinted(const std::string& colour, double amount);

}  // namespace panache
