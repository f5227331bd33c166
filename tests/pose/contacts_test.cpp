#include "pose/contacts.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace panache {
namespace {

// A left foot that stands, lifts and swings ahead, and lands; half a second each.
std::vector<HumanPositions> stepping(double fps) {
  std::vector<HumanPositions> world;
  for (int f = 0; f < 3 * fps / 2; ++f) {
    const double swing = std::clamp(f / fps / 0.5 - 1, 0.0, 1.0);
    HumanPositions body{};
    body[index(HumanJoint::left_toes)] = {0, static_cast<float>(0.15 * std::sin(M_PI * swing)),
                                          static_cast<float>(0.6 * swing)};
    world.push_back(body);
  }
  return world;
}

TEST(Contacts, a_standing_foot_is_planted_and_a_swinging_one_is_not) {
  for (const double fps : {30.0, 60.0, 120.0}) {
    const std::vector<FootContacts> contacts = detect_contacts(stepping(fps), fps);
    const auto at = [&](double seconds) { return contacts[static_cast<int>(seconds * fps)][0]; };
    EXPECT_TRUE(at(0.2)) << fps;
    EXPECT_FALSE(at(0.75)) << fps;
    EXPECT_TRUE(at(1.3)) << fps;
  }
}

TEST(Contacts, a_tenth_of_the_frames_may_show_a_toe_under_the_floor) {
  std::vector<HumanPositions> world(100);
  for (int f = 0; f < 100; ++f) {
    world[f] = {};
    if (f % 10 == 0) world[f][index(HumanJoint::left_toes)].y = -0.1f;
  }
  const std::vector<FootContacts> contacts = detect_contacts(world, 30);
  for (int f = 5; f < 100; f += 10) EXPECT_TRUE(contacts[f][0]) << f;
}

TEST(Contacts, a_foot_dragged_over_the_ground_is_not_planted) {
  std::vector<HumanPositions> world(30);
  for (int f = 0; f < 30; ++f) {
    world[f] = {};
    world[f][index(HumanJoint::left_toes)].z = static_cast<float>(f) * 1.2f / 30;
  }
  for (const FootContacts& planted : detect_contacts(world, 30)) EXPECT_FALSE(planted[0]);
}

TEST(Contacts, too_short_a_motion_shows_none) {
  EXPECT_TRUE(detect_contacts({}, 30).empty());
  EXPECT_FALSE(detect_contacts(std::vector<HumanPositions>(1), 30)[0][0]);
}

TEST(Contacts, a_foot_in_the_air_is_not_planted_whatever_its_probability) {
  EXPECT_EQ(planted_near_floor(0.9f, 0), 0.9f);
  EXPECT_EQ(planted_near_floor(0.9f, -0.05f), 0.9f);
  EXPECT_EQ(planted_near_floor(0.9f, 0.06f), 0.9f);
  EXPECT_LT(planted_near_floor(1, 0.1f), 0.5f);
  EXPECT_EQ(planted_near_floor(1, 0.12f), 0);
  EXPECT_EQ(planted_near_floor(1, 1), 0);
}

}  // namespace
}  // namespace panache
