#include "learn/style_file.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>

namespace panache {
namespace {

using enum HumanJoint;

// Pixels are centimetres.
constexpr int kPictureWidth = 90, kPictureHeight = 190, kGround = 180, kSkull = 11,
              kNeckToHead = 12;
// Rotation of the figures from the side view towards the viewer: 35 degrees.
constexpr float kAlong = 0.82f, kAcross = 0.57f;
constexpr const char* kDark = "#1f5f8b";
constexpr const char* kLight = "#8fb8d4";

struct Point {
  int x, y;
};
Point point_of(Vec3 joint, int figure) {
  // Forward is to the right; the body's right side, -x, faces the viewer.
  const float right = joint.z * kAlong - joint.x * kAcross;
  return {kPictureWidth * figure + kPictureWidth / 2 + static_cast<int>(std::lround(100 * right)),
          kGround - static_cast<int>(std::lround(100 * joint.y))};
}

// "M45 80L47 60"
std::string line(const HumanPositions& body, int figure, std::initializer_list<HumanJoint> joints) {
  std::string path;
  for (const HumanJoint joint : joints) {
    const auto [x, y] = point_of(body[index(joint)], figure);
    path += (path.empty() ? "M" : "L") + std::to_string(x) + " " + std::to_string(y);
  }
  return path;
}

std::string stroke(const std::string& path, const char* colour) {
  return "<path d=\"" + path + "\" stroke=\"" + colour + "\"/>";
}

std::string figure(const HumanPositions& body, int number) {
  const auto [x, y] = point_of(body[index(head)], number);
  return stroke(line(body, number, {left_shoulder, left_upper_arm, left_lower_arm, left_hand}) +
                    line(body, number, {left_upper_leg, left_lower_leg, left_foot, left_toes}),
                kLight) +
         stroke(line(body, number, {hips, spine, chest, neck, head}) +
                    line(body, number,
                         {right_shoulder, right_upper_arm, right_lower_arm, right_hand}) +
                    line(body, number, {right_upper_leg, right_lower_leg, right_foot, right_toes}),
                kDark) +
         "<circle cx=\"" + std::to_string(x) + "\" cy=\"" + std::to_string(y - kNeckToHead) +
         "\" r=\"" + std::to_string(kSkull) + "\" fill=\"" + kDark + "\"/>";
}

}  // namespace

std::string draw_thumbnail(std::span<const HumanPositions> bodies) {
  const int width = kPictureWidth * static_cast<int>(bodies.size());
  const std::string size = std::to_string(width) + " " + std::to_string(kPictureHeight);
  std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + size +
                    "\"><g fill=\"none\" stroke-width=\"7\" stroke-linecap=\"round\" "
                    "stroke-linejoin=\"round\"><path d=\"M0 " +
                    std::to_string(kGround) + "H" + std::to_string(width) +
                    "\" stroke=\"#ccc\" stroke-width=\"2\"/>";
  int number = 0;
  for (const HumanPositions& body : bodies) svg += figure(body, number++);
  return svg + "</g></svg>";
}

std::string thumbnail_of(const Take& take) {
  constexpr int kFigures = 6;
  constexpr double kApart = 0.25 * kTakeRate;  // Frames.
  const int count = take.frames() == 1 ? 1 : kFigures, last = take.frames() - 1;
  std::vector<HumanPositions> bodies;
  for (int i = 0; i < count; ++i) {
    const double at = last / 2.0 + (i - (count - 1) / 2.0) * kApart;
    bodies.push_back(take.body[std::clamp(static_cast<int>(std::lround(at)), 0, last)]);
  }
  return draw_thumbnail(bodies);
}

}  // namespace panache
