#include "style/model/gesture.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/quat.h"

namespace panache {
namespace {

using enum HumanJoint;

// Sizes from which a movement is noticed.
constexpr float kTurn = 0.25f;    // Of head and torso, radians.
constexpr float kReach = 0.4f;    // Of a hand, in lengths of the arm.
constexpr float kHeight = 0.06f;  // Of the hips, metres.
// As large as the largest movement, or to the other side, if it has this share of the size.
constexpr float kAlike = 0.6f;
constexpr float kOverShoulder = 0.9f;  // Radians.

struct Movement {
  std::string text;
  float size;  // In units of what is noticed.
};

// The turn of `joint` relative to `parent` (an ancestor, or -1).
Quat turn_beyond(const GesturePose& pose, int parent, int joint) {
  Quat turn;
  for (int j = joint; j != parent; j = kHumanParent[j]) turn = exp_rotation(pose.turns[j]) * turn;
  return turn;
}

// A vector in the course of a gesture.
struct Course {
  Vec3 peak = {};        // Where it is longest.
  float max[3], min[3];  // Extremes of each coordinate,
  bool max_first[3];     // and which comes first.
};
Course course_of(const std::vector<GesturePose>& points,
                 const std::function<Vec3(const GesturePose&)>& at) {
  Course course{};
  for (const GesturePose& point : points) {
    const Vec3 v = at(point);
    if (length(v) > length(course.peak)) course.peak = v;
    const float numbers[3] = {v.x, v.y, v.z};
    for (int i = 0; i < 3; ++i) {
      if (numbers[i] > course.max[i]) course.max[i] = numbers[i], course.max_first[i] = false;
      if (numbers[i] < course.min[i]) course.min[i] = numbers[i], course.max_first[i] = true;
    }
  }
  return course;
}

// The axis of a turn with the largest part in it, 0 to 2, and whether it goes both ways.
struct Axis {
  int index;
  bool positive, both;
};
Axis axis_of(const Course& course) {
  const float sizes[3] = {std::abs(course.peak.x), std::abs(course.peak.y),
                          std::abs(course.peak.z)};
  const int index = static_cast<int>(std::max_element(sizes, sizes + 3) - sizes);
  const float numbers[3] = {course.peak.x, course.peak.y, course.peak.z};
  const auto [small, large] = std::minmax({course.max[index], -course.min[index]});
  const bool both = small > kAlike * large;
  return {index, both ? course.max_first[index] : numbers[index] > 0, both};
}

const char* side_word(bool left) { return left ? "left" : "right"; }
std::string left_and_right(bool left_first) {
  return left_first ? "left and right" : "right and left";
}

std::string head_text(const Axis& axis, float turned) {
  switch (axis.index) {
    case 0:
      if (axis.both) return "nods";
      return axis.positive ? "looks down" : "looks up";
    case 1:
      if (axis.both) return "glances " + left_and_right(axis.positive);
      if (turned < kOverShoulder) return std::string("glances ") + side_word(axis.positive);
      return std::string("glances over the ") + side_word(axis.positive) + " shoulder";
    default:
      // A positive turn about the axis ahead takes the head to the right.
      if (axis.both) return "tilts the head " + left_and_right(!axis.positive);
      return std::string("tilts the head to the ") + side_word(!axis.positive);
  }
}

std::string torso_text(const Axis& axis) {
  switch (axis.index) {
    case 0:
      if (axis.both) return axis.positive ? "rocks forward and back" : "rocks back and forward";
      return axis.positive ? "bends forward" : "leans back";
    case 1:
      if (axis.both) return "twists " + left_and_right(axis.positive);
      return std::string("twists to the ") + side_word(axis.positive);
    default:
      if (axis.both) return "sways " + left_and_right(!axis.positive);
      return std::string("leans to the ") + side_word(!axis.positive);
  }
}

// Where a hand goes, seen from the shoulder of an arm that hangs.
enum class Direction { none, over_head, up, ahead, back, out, across };
struct Hand {
  Direction direction = Direction::none;
  float size = 0;
};
Hand hand_of(const std::vector<GesturePose>& points, HumanJoint upper, HumanJoint lower,
             bool left) {
  const auto at = [&](const GesturePose& pose) {
    constexpr Vec3 kDown = {0, -1, 0};
    const Vec3 elbow = rotate(turn_beyond(pose, index(chest), index(upper)), kDown);
    const Vec3 hand = rotate(turn_beyond(pose, index(chest), index(lower)), kDown);
    return (elbow + hand) * 0.5f - kDown;
  };
  const Vec3 v = course_of(points, at).peak;
  const float out = left ? v.x : -v.x, sideways = std::max(std::abs(out), std::abs(v.z));
  Hand hand{Direction::over_head, length(v) / kReach};
  if (v.y > 1.2f) return hand;  // Above the shoulder.
  if (v.y > sideways) {
    hand.direction = Direction::up;
  } else if (std::abs(v.z) >= std::abs(out)) {
    hand.direction = v.z > 0 ? Direction::ahead : Direction::back;
  } else {
    hand.direction = out > 0 ? Direction::out : Direction::across;
  }
  return hand;
}

std::string arm_text(Direction direction, const std::string& arm, const std::string& hand) {
  switch (direction) {
    case Direction::over_head:
      return "throws " + arm + " up";
    case Direction::up:
      return "raises " + hand;
    case Direction::ahead:
      return "swings " + arm + " forward";
    case Direction::back:
      return "swings " + arm + " back";
    case Direction::out:
      return "spreads " + arm;
    default:
      return "swings " + arm + " across";
  }
}

void add_arms(const std::vector<GesturePose>& points, std::vector<Movement>& out) {
  const Hand left = hand_of(points, left_upper_arm, left_lower_arm, true);
  const Hand right = hand_of(points, right_upper_arm, right_lower_arm, false);
  const auto [small, large] = std::minmax(left.size, right.size);
  if (small > kAlike * large) {
    const bool alike = left.direction == right.direction;
    out.push_back(
        {alike ? arm_text(left.direction, "both arms", "both hands") : "moves both arms", large});
    return;
  }
  out.push_back({arm_text(left.direction, "the left arm", "the left hand"), left.size});
  out.push_back({arm_text(right.direction, "the right arm", "the right hand"), right.size});
}

void add_torso_and_head(const std::vector<GesturePose>& points, std::vector<Movement>& out) {
  const auto turn = [&](int parent, HumanJoint joint) {
    return course_of(points, [&](const GesturePose& pose) {
      return log_rotation(turn_beyond(pose, parent, index(joint)));
    });
  };
  const Course neck_up = turn(index(chest), head), below = turn(-1, chest);
  const Axis look = axis_of(neck_up), lean = axis_of(below);
  // A torso that turns with the head is part of the glance.
  const bool follows = look.index == 1 && lean.index == 1 && !look.both && !lean.both &&
                       look.positive == lean.positive &&
                       length(neck_up.peak) > kAlike * length(below.peak);
  const float turned = std::abs(neck_up.peak.y) + (follows ? std::abs(below.peak.y) : 0);
  const float size = length(neck_up.peak) + (follows ? length(below.peak) : 0);
  out.push_back({head_text(look, turned), size / kTurn});
  if (!follows) out.push_back({torso_text(lean), length(below.peak) / kTurn});
}

void add_hips(const std::vector<GesturePose>& points, std::vector<Movement>& out) {
  float lift = 0, low = 0, high = 0;
  for (const GesturePose& pose : points) {
    lift = std::max(lift, pose.lift);
    low = std::min(low, pose.height);
    high = std::max(high, pose.height);
  }
  // A hop is what one sees first.
  if (lift > kHeight) {
    out.push_back({"hops", INFINITY});
  } else if (high > -low) {
    out.push_back({"stretches up", high / kHeight});
  }
  if (-low >= high) out.push_back({"ducks", -low / kHeight});
}

std::string joined(const std::vector<std::string>& movements, size_t count) {
  std::string text;
  for (size_t i = 0; i < std::min(count, movements.size()); ++i) {
    text += (i ? i + 1 == count || i + 1 == movements.size() ? " and " : ", " : "") + movements[i];
  }
  return text;
}

}  // namespace

std::vector<std::string> movements_of(const std::vector<GesturePose>& points) {
  std::vector<Movement> all;
  add_hips(points, all);
  add_torso_and_head(points, all);
  add_arms(points, all);
  std::stable_sort(all.begin(), all.end(),
                   [](const Movement& a, const Movement& b) { return a.size > b.size; });
  std::vector<std::string> texts;
  for (const Movement& movement : all) {
    if (texts.empty() || movement.size >= 1) texts.push_back(movement.text);
  }
  return texts;
}

std::vector<std::string> distinct_names(std::span<const std::vector<std::string>> gestures) {
  std::vector<size_t> told(gestures.size(), 1);  // How many movements each name tells.
  const auto name = [&](size_t g) { return joined(gestures[g], told[g]); };
  const auto is_taken = [&](size_t g) {
    for (size_t other = 0; other < gestures.size(); ++other) {
      if (other != g && name(other) == name(g)) return true;
    }
    return false;
  };
  for (bool changes = true; changes;) {
    std::vector<size_t> more = told;
    for (size_t g = 0; g < gestures.size(); ++g) {
      if (told[g] < gestures[g].size() && is_taken(g)) ++more[g];
    }
    changes = more != told;
    told = more;
  }
  std::vector<std::string> names;
  for (size_t g = 0; g < gestures.size(); ++g) {
    size_t before = 0;
    for (size_t other = 0; other < g; ++other) before += name(other) == name(g);
    names.push_back(name(g) + (before ? " (" + std::to_string(before + 1) + ")" : ""));
  }
  return names;
}

}  // namespace panache
