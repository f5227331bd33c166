#pragma once
// Motion as a strip of stick figures, one row a motion, for reports and documentation.

#include <string>
#include <vector>

#include "rig/humanoid.h"

namespace panache {

struct StripRow {
  std::string label;  // Long ones take several lines.
  // In the world, metres; one every StripOptions::seconds_between. Figures that are not finite are
  // left out.
  std::vector<HumanPositions> frames;
  std::string colour;  // "#rrggbb"; empty for one of our own.
};

struct StripOptions {
  std::string title;
  double seconds_between = 0.25;  // From one frame to the next, for the labels.
  // How far the figures turn from the side view towards the viewer (90: they come towards it), and
  // how far the camera looks down; degrees. Straight ahead is each row's own way: where it goes, or
  // where its figures face on average, if it goes nowhere or not that way.
  double yaw_deg = 32, pitch_deg = 8;
  double pixels_per_metre = 84;
  // Whether each figure stands where it is, on a ground marked in metres, instead of at equal
  // distance from its neighbours. Rows share one scale, so a slower walk is a shorter row. Half a
  // second from figure to figure keeps a walk's from covering each other.
  bool travel = false;
};

// An SVG file. The body's right is drawn in full colour, its left in a lighter one.
std::string draw_strip(const std::vector<StripRow>& rows, const StripOptions& options);

}  // namespace panache
