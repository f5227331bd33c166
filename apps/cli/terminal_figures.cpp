#include "terminal_figures.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "messages.h"
#include "rig/posed_rig.h"

namespace panache::cli {
namespace {

using enum HumanJoint;

constexpr int kFigures = 6, kColumns = 12, kRows = 11;  // Number of figures; characters per figure.
constexpr int kWidth = 2 * kColumns, kHeight = 4 * kRows;  // In dots: 2 by 4 per character.
constexpr float kDotsPerMetre = 21;                        // A standing body with raised arms fits.
constexpr float kYaw = 0.6f;    // Turned from the side view towards the viewer, radians.
constexpr float kSkull = 0.1f;  // Radius, metres.

class Dots {
 public:
  // Right and up from the lower left corner; dots outside are ignored.
  void set(float x, float y) {
    const auto column = static_cast<int>(std::lround(x)), row = static_cast<int>(std::lround(y));
    if (column < 0 || column >= kFigures * kWidth || row < 0 || row >= kHeight) return;
    // The bits of a character's dots, from the top row down.
    constexpr std::array<std::array<int, 2>, 4> kBits = {
        {{0x01, 0x08}, {0x02, 0x10}, {0x04, 0x20}, {0x40, 0x80}}};
    const int down = kHeight - 1 - row;
    bits_[static_cast<size_t>(down / 4)][static_cast<size_t>(column / 2)] |=
        kBits[static_cast<size_t>(down % 4)][static_cast<size_t>(column % 2)];
  }
  void line(Vec3 a, Vec3 b) {
    const float steps = std::max({std::abs(b.x - a.x), std::abs(b.y - a.y), 1.0f});
    for (float s = 0; s <= steps; ++s) {
      const Vec3 at = lerp(a, b, s / steps);
      set(at.x, at.y);
    }
  }
  std::string text() const {
    std::string text;
    for (const auto& row : bits_) {
      std::string line;
      for (const int bits : row) {
        // U+2800 plus the bits, in UTF-8.
        line += bits ? std::string{'\xe2', static_cast<char>(0xa0 | (bits >> 6)),
                                   static_cast<char>(0x80 | (bits & 0x3f))}
                     : std::string(" ");
      }
      line.erase(line.find_last_not_of(' ') + 1);
      // Omits rows above all heads.
      if (!line.empty() || !text.empty()) text += line + "\n";
    }
    return text;
  }

 private:
  std::array<std::array<int, kFigures * kColumns>, kRows> bits_{};
};

void draw(const BodyPose& body, int figure, Dots& dots) {
  const Vec3 origin = body.positions[index(hips)];
  const auto on_picture = [&](Vec3 position) {
    const Vec3 offset = rotate(rotation_y(-body.facing - kYaw), position - origin);
    return Vec3{(static_cast<float>(figure) + 0.5f) * kWidth + offset.z * kDotsPerMetre,
                position.y * kDotsPerMetre, 0};
  };
  for (size_t j = 1; j < kHumanJoints; ++j) {
    dots.line(on_picture(body.positions[static_cast<size_t>(kHumanParent[j])]),
              on_picture(body.positions[j]));
  }
  const Vec3 neck_to_head =
      normalized(body.positions[index(head)] - body.positions[index(neck)], {0, 1, 0});
  const Vec3 skull = on_picture(body.positions[index(head)] + neck_to_head * kSkull);
  for (int i = 0; i < 32; ++i) {
    const float angle = static_cast<float>(i) * 0.19635f;
    dots.set(skull.x + kSkull * kDotsPerMetre * std::cos(angle),
             skull.y + kSkull * kDotsPerMetre * std::sin(angle));
  }
}

}  // namespace

std::string draw_figures(const Clip& clip, const Rig& rig) {
  PosedRig posed(rig);
  Dots dots;
  std::string times;
  for (int i = 0; i < kFigures; ++i) {
    const int frame = (clip.frames - 1) * i / (kFigures - 1);
    BodyPose body;
    posed.read(clip.pose(frame), body);
    draw(body, i, dots);
    const std::string time = fixed(frame * clip.frame_time, 1) + " s";
    const auto before =
        static_cast<size_t>(i * kColumns + (kColumns - static_cast<int>(time.size())) / 2);
    times += std::string(before - times.size(), ' ') + time;
  }
  return dots.text() + times + "\n";
}

}  // namespace panache::cli
