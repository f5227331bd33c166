#include "draw/strip.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "draw/svg.h"

namespace panache {
namespace {

// Pixels.
constexpr double kMargin = 20, kRowGap = 22, kTitleHeight = 30, kTimeHeight = 24;
constexpr double kRowLabelSize = 15, kTimeSize = 11;
constexpr double kLabelWidth = 190, kLabelLine = 19;  // Maximum width of a line; line height.
// Thickness of the parts of a figure, metres.
constexpr double kArm = 0.062, kLeg = 0.085, kTorso = 0.15, kNeck = 0.07, kHalo = 0.022;
constexpr double kHeadRadius = 0.1, kHeadRise = 0.09;
constexpr const char* kGround = "#d5d5d5";
constexpr const char* kFaint = "#8a8a8a";

using enum HumanJoint;

// A point in camera space: metres to the right, up, and towards the viewer.
struct Projected {
  double right = 0, up = 0, near = 0;
};

// An orthographic camera that is rotated with the direction of motion.
class Camera {
 public:
  Camera(Vec3d ahead, const StripOptions& options) : ahead_(ahead) {
    const double radians = std::numbers::pi / 180;
    yaw_cos_ = std::cos(options.yaw_deg * radians);
    yaw_sin_ = std::sin(options.yaw_deg * radians);
    pitch_cos_ = std::cos(options.pitch_deg * radians);
    pitch_sin_ = std::sin(options.pitch_deg * radians);
  }

  Projected see(Vec3d point) const {
    const double forward = dot(point, ahead_);
    // To the body's right, the side that faces the viewer.
    const double right = dot(point, cross(ahead_, {0, 1, 0}));
    const double near = forward * yaw_sin_ + right * yaw_cos_;
    return {forward * yaw_cos_ - right * yaw_sin_, point.y * pitch_cos_ - near * pitch_sin_,
            near * pitch_cos_ + point.y * pitch_sin_};
  }

 private:
  Vec3d ahead_;
  double yaw_cos_, yaw_sin_, pitch_cos_, pitch_sin_;
};

bool all_finite(const HumanPositions& body) {
  return std::all_of(body.begin(), body.end(), [](Vec3 p) { return is_finite(p); });
}

// The body's heading, horizontal and of unit length.
Vec3d facing(const HumanPositions& body) {
  const Vec3d left = (body[index(left_upper_leg)] - body[index(right_upper_leg)]).as<double>() +
                     (body[index(left_upper_arm)] - body[index(right_upper_arm)]).as<double>();
  return normalized(cross(Vec3d{left.x, 0, left.z}, Vec3d{0, 1, 0}), Vec3d{0, 0, 1});
}

// The direction of a row, horizontal and of unit length: see StripOptions.
Vec3d direction_of(const StripRow& row) {
  constexpr double kGoes = 0.7;  // Metres.
  Vec3d faced;
  const HumanPositions* first = nullptr;
  const HumanPositions* last = nullptr;
  for (const HumanPositions& body : row.frames) {
    if (!all_finite(body)) continue;
    if (!first) first = &body;
    last = &body;
    faced += facing(body);
  }
  if (!first) return {0, 0, 1};
  faced = normalized(faced, facing(*first));
  Vec3d direction =
      ((*last)[index(HumanJoint::hips)] - (*first)[index(HumanJoint::hips)]).as<double>();
  direction.y = 0;
  const bool goes = length(direction) > kGoes && dot(normalized(direction), faced) > 0.5;
  return goes ? normalized(direction) : faced;
}

// Breaks a label into lines between words, after joining characters in file names, or anywhere if a
// single word is too wide.
std::vector<std::string> label_lines(const std::string& label) {
  std::vector<std::string> lines;
  std::string line, word;
  const auto put = [&] {
    if (!line.empty() && text_width(line + word, kRowLabelSize) > kLabelWidth) {
      lines.push_back(line);
      line.clear();
    }
    line += word;
    word.clear();
  };
  for (const char c : label) {
    // Keeps the bytes of a UTF-8 character together.
    const bool inside = (static_cast<unsigned char>(c) & 0xc0) == 0x80;
    if (!inside && text_width(word + c, kRowLabelSize) > kLabelWidth) put();
    word += c;
    if (c == ' ' || c == '-' || c == '_' || c == '/') put();
  }
  put();
  lines.push_back(line);
  return lines;
}

// One figure, in metres of the drawing: right and up from its row's origin.
struct Figure {
  std::array<Projected, kHumanJoints> joints;
  Projected head;
  double time = 0;
};

Figure make_figure(const HumanPositions& body, const Camera& camera, double hips_right) {
  // Subtracts only the hips' distance from the viewer, and their travel if figures stand apart.
  const Vec3d hips = body[index(HumanJoint::hips)].as<double>();
  const Projected ground = camera.see({hips.x, 0, hips.z});
  const auto project = [&](Vec3d p) {
    const Projected projected = camera.see(p);
    return Projected{projected.right - ground.right + hips_right, projected.up - ground.up,
                     projected.near - ground.near};
  };
  Figure figure;
  for (int j = 0; j < kHumanJoints; ++j) figure.joints[j] = project(body[j].as<double>());
  const Vec3d head_joint = body[index(HumanJoint::head)].as<double>();
  const Vec3d neck_joint = body[index(HumanJoint::neck)].as<double>();
  const Vec3d up = normalized(head_joint - neck_joint, Vec3d{0, 1, 0});
  figure.head = project(head_joint + up * kHeadRise);
  return figure;
}

// A body part: lines through joints, drawn together.
struct Part {
  struct Line {
    std::vector<HumanJoint> through;
    double width;
  };
  std::vector<Line> lines;
  double tint = 0;  // Towards white.
  bool head = false;
  double near = 0;
};

std::vector<Part> body_parts() {
  constexpr double kLeftTint = 0.52, kMiddleTint = 0.2;
  return {
      {{{{left_upper_leg, left_lower_leg, left_foot, left_toes}, kLeg}}, kLeftTint},
      {{{{left_upper_arm, left_lower_arm, left_hand}, kArm}}, kLeftTint},
      {{{{hips, spine, chest}, kTorso},
        {{chest, neck, head}, kNeck},
        {{left_upper_leg, hips, right_upper_leg}, kLeg},
        {{left_upper_arm, chest, right_upper_arm}, kLeg}},
       kMiddleTint,
       true},
      {{{{right_upper_leg, right_lower_leg, right_foot, right_toes}, kLeg}}, 0},
      {{{{right_upper_arm, right_lower_arm, right_hand}, kArm}}, 0},
  };
}

void draw_figure(Svg& svg, const Figure& figure, const std::string& colour, Point origin,
                 double scale) {
  const auto pixel = [&](const Projected& s) {
    return Point{origin.x + s.right * scale, origin.y - s.up * scale};
  };
  std::vector<Part> parts = body_parts();
  for (Part& part : parts) {
    double sum = 0;
    for (const HumanJoint j : part.lines[0].through) sum += figure.joints[index(j)].near;
    part.near = sum / static_cast<double>(part.lines[0].through.size());
  }
  std::stable_sort(parts.begin(), parts.end(),
                   [](const Part& a, const Part& b) { return a.near < b.near; });
  for (const Part& part : parts) {
    // A white outline separates a part from those behind it.
    for (const bool rim : {true, false}) {
      const std::string paint = rim ? "#ffffff" : tinted(colour, part.tint);
      const double extra = rim ? 2 * kHalo : 0;
      for (const Part::Line& line : part.lines) {
        std::vector<Point> points;
        points.reserve(line.through.size());
        for (const HumanJoint j : line.through) points.push_back(pixel(figure.joints[index(j)]));
        svg.polyline(points, {paint, (line.width + extra) * scale, 1, ""});
      }
      if (part.head) svg.circle(pixel(figure.head), (kHeadRadius + extra / 2) * scale, paint);
    }
  }
}

// The layout of a row, before it is placed on the page.
struct Layout {
  std::vector<std::vector<Figure>> rows;
  double left = 0, right = 0;  // Extent of all figures, metres.
  double top = 1, bottom = 0;  // Likewise, relative to the ground.
};

// The maximum reach of a figure to one side of its hips.
double widest_reach(const std::vector<StripRow>& rows, const std::vector<Camera>& cameras) {
  double reach = 0.3;
  for (size_t r = 0; r < rows.size(); ++r) {
    for (const HumanPositions& body : rows[r].frames) {
      if (!all_finite(body)) continue;
      for (const Projected& s : make_figure(body, cameras[r], 0).joints) {
        reach = std::max(reach, std::abs(s.right));
      }
    }
  }
  return reach;
}

// cameras: [rows].
Layout lay_out(const std::vector<StripRow>& rows, const std::vector<Camera>& cameras,
               const StripOptions& options) {
  constexpr double kGapShare = 1.7;  // Neighbours rarely reach towards each other at once.
  const double apart = widest_reach(rows, cameras) * kGapShare;
  Layout layout;
  bool first = true;
  for (size_t r = 0; r < rows.size(); ++r) {
    const StripRow& row = rows[r];
    const Camera& camera = cameras[r];
    std::vector<Figure>& figures = layout.rows.emplace_back();
    double start = 0;
    for (size_t f = 0; f < row.frames.size(); ++f) {
      const HumanPositions& body = row.frames[f];
      if (!all_finite(body)) continue;
      const double travelled = camera.see(body[index(HumanJoint::hips)].as<double>()).right;
      if (figures.empty()) start = travelled;
      const double at = options.travel ? travelled - start : apart * static_cast<double>(f);
      figures.push_back(make_figure(body, camera, at));
      figures.back().time = options.seconds_between * static_cast<double>(f);
      layout.top = std::max(layout.top, figures.back().head.up + kHeadRadius);
      for (const Projected& s : figures.back().joints) {
        layout.left = first ? s.right : std::min(layout.left, s.right);
        layout.right = first ? s.right : std::max(layout.right, s.right);
        layout.bottom = std::min(layout.bottom, s.up);
        first = false;
      }
    }
  }
  layout.left -= kHeadRadius;
  layout.right += kHeadRadius;
  return layout;
}

// "0.25 s" under each figure that has room for it.
void draw_times(Svg& svg, const std::vector<Figure>& figures, Point origin, double scale) {
  double free_from = -1e9;
  for (const Figure& figure : figures) {
    const int hundredths = static_cast<int>(std::lround(figure.time * 100));
    std::string text = std::to_string(hundredths / 100) + ".";
    text += std::to_string(hundredths % 100 / 10);
    if (hundredths % 10) text += std::to_string(hundredths % 10);
    text += " s";
    const double x = origin.x + figure.joints[index(HumanJoint::hips)].right * scale;
    const double half = text_width(text, kTimeSize) / 2;
    if (x - half < free_from) continue;
    free_from = x + half + 4;
    svg.text({x, origin.y + kTimeSize + 8}, text, {kTimeSize, kFaint, TextStyle::Anchor::middle});
  }
}

// The ground; if figures travel, with a mark every half metre ahead.
void draw_ground(Svg& svg, const Layout& layout, Point origin, const StripOptions& options) {
  const double scale = options.pixels_per_metre;
  const double left = origin.x + layout.left * scale, right = origin.x + layout.right * scale;
  svg.line({left, origin.y}, {right, origin.y}, {kGround, 1.5, 1, ""});
  if (!options.travel) return;
  const double half_metre = std::cos(options.yaw_deg * std::numbers::pi / 180) * scale / 2;
  if (half_metre < 1) return;
  for (int mark = static_cast<int>(std::ceil((left - origin.x) / half_metre));
       origin.x + mark * half_metre <= right; ++mark) {
    const double x = origin.x + mark * half_metre;
    svg.line({x, origin.y}, {x, origin.y + (mark % 2 ? 4 : 7)}, {kGround, 1.5, 1, ""});
    if (mark % 2 == 0) {
      svg.text({x, origin.y + kTimeSize + 9}, std::to_string(mark / 2) + " m",
               {kTimeSize, kFaint, TextStyle::Anchor::middle});
    }
  }
}

}  // namespace

std::string draw_strip(const std::vector<StripRow>& rows, const StripOptions& options) {
  std::vector<Camera> cameras;
  std::vector<std::vector<std::string>> labels;
  for (const StripRow& row : rows) {
    cameras.emplace_back(direction_of(row), options);
    labels.push_back(label_lines(row.label));
  }
  const Layout layout = lay_out(rows, cameras, options);
  const double scale = options.pixels_per_metre;
  double label_width = 0;
  for (const auto& lines : labels) {
    for (const std::string& line : lines) {
      label_width = std::max(label_width, text_width(line, kRowLabelSize) + 16);
    }
  }
  const double title = options.title.empty() ? 0 : kTitleHeight;
  const double marks = options.travel ? kTimeHeight : 0;
  const double row_height = (layout.top - layout.bottom) * scale + kRowGap + marks;
  const double width =
      2 * kMargin + label_width + std::max(layout.right - layout.left, 1.0) * scale;
  const double height = 2 * kMargin + title + row_height * static_cast<double>(rows.size()) +
                        (options.travel ? 0 : kTimeHeight) - kRowGap;
  Svg svg(width, std::max(height, 2 * kMargin));
  if (title > 0) svg.text({kMargin, kMargin + 14}, options.title, {17, "#222222", {}, true});
  for (size_t r = 0; r < rows.size(); ++r) {
    const std::string colour = rows[r].colour.empty() ? palette(r) : rows[r].colour;
    const Point origin = {
        kMargin + label_width - layout.left * scale,
        kMargin + title + row_height * static_cast<double>(r) + layout.top * scale};
    draw_ground(svg, layout, origin, options);
    const double middle = origin.y - layout.top * scale * 0.45;
    const double above = kLabelLine * static_cast<double>(labels[r].size() - 1) / 2;
    for (size_t i = 0; i < labels[r].size(); ++i) {
      svg.text({kMargin, middle - above + kLabelLine * static_cast<double>(i)}, labels[r][i],
               {kRowLabelSize, tinted(colour, -0.15), {}, true});
    }
    for (const Figure& figure : layout.rows[r]) {
      draw_figure(svg, figure, colour, origin, scale);
    }
    if (!options.travel && r + 1 == rows.size()) {
      draw_times(svg, layout.rows[r], {origin.x, origin.y - layout.bottom * scale}, scale);
    }
  }
  return svg.str();
}

}  // namespace panache
