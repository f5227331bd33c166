// Names of gestures: words for what one sees, different for all of a style.

#include "style/model/gesture.h"

#include <cmath>

#include <gtest/gtest.h>

namespace panache {
namespace {

using enum HumanJoint;
using Points = std::vector<GesturePose>;
using Texts = std::vector<std::string>;

// A gesture that comes and goes; `peak` may turn several joints.
Points once(const GesturePose& peak) {
  Points points;
  for (int k = 1; k < 16; ++k) {
    points.push_back(scaled(std::sin(3.14159265f * static_cast<float>(k) / 16), peak));
  }
  return points;
}
// One that goes there and then to the other side.
Points to_both_sides(const GesturePose& peak) {
  Points points = once(peak);
  for (const GesturePose& back : once(scaled(-1, peak))) points.push_back(back);
  return points;
}
GesturePose turning(HumanJoint joint, Vec3 turn, GesturePose pose = {}) {
  pose.turns[static_cast<size_t>(index(joint))] = turn;
  return pose;
}
GesturePose hips_by(float height, float lift = 0) {
  GesturePose pose;
  pose.height = height;
  pose.lift = lift;
  return pose;
}
std::string first_of(const Points& points) { return movements_of(points).front(); }

TEST(GestureName, tells_where_the_head_goes) {
  EXPECT_EQ(first_of(once(turning(head, {0, 0.6f, 0}))), "glances left");
  EXPECT_EQ(first_of(once(turning(neck, {0, -0.6f, 0}))), "glances right");
  EXPECT_EQ(first_of(once(turning(head, {0, 1.1f, 0}))), "glances over the left shoulder");
  EXPECT_EQ(first_of(once(turning(head, {0, -0.7f, 0}, turning(spine, {0, -0.5f, 0})))),
            "glances over the right shoulder");
  EXPECT_EQ(first_of(to_both_sides(turning(head, {0, 0.6f, 0}))), "glances left and right");
  EXPECT_EQ(first_of(to_both_sides(turning(head, {0, -0.6f, 0}))), "glances right and left");
  EXPECT_EQ(first_of(once(turning(head, {0.6f, 0, 0}))), "looks down");
  EXPECT_EQ(first_of(once(turning(head, {-0.6f, 0, 0}))), "looks up");
  EXPECT_EQ(first_of(to_both_sides(turning(head, {0.6f, 0, 0}))), "nods");
  EXPECT_EQ(first_of(once(turning(head, {0, 0, 0.6f}))), "tilts the head to the right");
}

TEST(GestureName, tells_where_the_torso_goes) {
  EXPECT_EQ(first_of(once(turning(spine, {0.6f, 0, 0}))), "bends forward");
  EXPECT_EQ(first_of(once(turning(spine, {-0.6f, 0, 0}))), "leans back");
  EXPECT_EQ(first_of(once(turning(chest, {0, 0.6f, 0}))), "twists to the left");
  EXPECT_EQ(first_of(once(turning(hips, {0, 0, 0.6f}))), "leans to the right");
  EXPECT_EQ(first_of(to_both_sides(turning(hips, {0, 0, 0.6f}))), "sways right and left");
}

TEST(GestureName, tells_where_the_arms_go) {
  EXPECT_EQ(first_of(once(turning(left_upper_arm, {0, 0, 2.6f}))), "throws the left arm up");
  EXPECT_EQ(first_of(once(turning(right_upper_arm, {-0.8f, 0, 0}))),
            "swings the right arm forward");
  EXPECT_EQ(first_of(once(turning(right_upper_arm, {0.8f, 0, 0}))), "swings the right arm back");
  EXPECT_EQ(first_of(once(turning(left_upper_arm, {0, 0, 0.8f}))), "spreads the left arm");
  EXPECT_EQ(first_of(once(turning(left_upper_arm, {0, 0, -0.8f}))), "swings the left arm across");
  EXPECT_EQ(first_of(once(turning(right_lower_arm, {-2.2f, 0, 0}))), "raises the right hand");
  const auto both = [](float left, float right) {
    return once(turning(left_upper_arm, {0, 0, left}, turning(right_upper_arm, {0, 0, right})));
  };
  EXPECT_EQ(first_of(both(2.6f, -2.6f)), "throws both arms up");
  EXPECT_EQ(first_of(both(0.9f, -0.8f)), "spreads both arms");
  EXPECT_EQ(first_of(both(0.9f, 0.8f)), "moves both arms");
}

TEST(GestureName, tells_where_the_hips_go) {
  EXPECT_EQ(first_of(once(hips_by(-0.2f))), "ducks");
  EXPECT_EQ(first_of(once(hips_by(0.1f))), "stretches up");
  EXPECT_EQ(first_of(once(hips_by(0.2f, 0.2f))), "hops");
  EXPECT_EQ(movements_of(once(GesturePose{})).size(), 1u) << "never without a word";
}

TEST(GestureName, lists_what_is_noticed_by_its_size) {
  const GesturePose pose =
      turning(head, {0, 0.5f, 0}, turning(right_upper_arm, {-1.2f, 0, 0}, hips_by(-0.02f)));
  EXPECT_EQ(movements_of(once(pose)), (Texts{"swings the right arm forward", "glances left"}));
}

TEST(GestureName, tells_more_where_two_would_be_equal_and_numbers_what_is) {
  const std::vector<Texts> gestures = {{"glances left", "ducks", "leans back"},
                                       {"glances left", "ducks"},
                                       {"hops"},
                                       {"glances left", "nods"},
                                       {"hops"}};
  EXPECT_EQ(distinct_names(gestures),
            (Texts{"glances left, ducks and leans back", "glances left and ducks", "hops",
                   "glances left and nods", "hops (2)"}));
}

}  // namespace
}  // namespace panache
