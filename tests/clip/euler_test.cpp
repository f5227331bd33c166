#include "clip/euler.h"

#include <cmath>
#include <random>
#include <vector>

#include "fixtures.h"

namespace panache {
namespace {

std::vector<EulerOrder> all_orders() {
  std::vector<EulerOrder> orders;
  for (int a = 0; a < 3; ++a) {
    orders.push_back({1, {a, 0, 0}});
    for (int b = 0; b < 3; ++b) {
      if (b == a) continue;
      orders.push_back({2, {a, b, 0}});
      orders.push_back({3, {a, b, 3 - a - b}});
    }
  }
  return orders;
}

std::string name(const EulerOrder& order) {
  std::string text;
  for (size_t i = 0; i < static_cast<size_t>(order.count); ++i) text += "XYZ"[order.axis[i]];
  return text;
}

// Angles with zeros where the order has no axis.
EulerAngles cut(const EulerOrder& order, EulerAngles angles) {
  for (size_t i = static_cast<size_t>(order.count); i < 3; ++i) angles[i] = 0;
  return angles;
}

double largest_difference(const EulerAngles& a, const EulerAngles& b) {
  return std::max({std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2])});
}

TEST(Euler, the_first_channel_turns_last) {
  // Z then X in the file is R = Rz Rx: the point is turned about x first.
  const Quatd q = euler_to_quat({2, {2, 0, 0}}, {90, 90, 0});
  const Vec3d p = rotate(q, Vec3d{0, 1, 0});  // x turns y to z; z leaves that alone.
  EXPECT_NEAR(p.x, 0, 1e-15);
  EXPECT_NEAR(p.y, 0, 1e-15);
  EXPECT_NEAR(p.z, 1, 1e-15);
}

TEST(Euler, angles_come_back_near_where_they_were) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> angle(-400, 400), shake(-20, 20);
  for (const EulerOrder& order : all_orders()) {
    for (int i = 0; i < 2000; ++i) {
      const EulerAngles angles = cut(order, {angle(random), angle(random), angle(random)});
      if (std::abs(std::cos(angles[1] / 57.29577951308232)) < 0.5) continue;  // Near gimbal lock.
      const EulerAngles near =
          cut(order, {angles[0] + shake(random), angles[1] + shake(random), angles[2]});
      const EulerAngles back = quat_to_euler(order, euler_to_quat(order, angles), near);
      // The free choice of 3e-7 radians at a cosine of one half is 1.7e-5 degrees.
      EXPECT_LT(largest_difference(back, angles), 3e-5) << name(order);
    }
  }
}

TEST(Euler, any_angles_that_come_back_are_the_same_rotation) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> angle(-400, 400);
  for (const EulerOrder& order : all_orders()) {
    for (int i = 0; i < 2000; ++i) {
      EulerAngles angles = cut(order, {angle(random), angle(random), angle(random)});
      // A third of them on the very pole, a third a little beside it.
      if (i % 3 > 0 && order.count == 3) angles[1] = (i % 2 ? 90 : -90) + (i % 3 - 1) * 1e-4;
      const Quatd rotation = euler_to_quat(order, angles);
      const EulerAngles near = {angle(random), angle(random), angle(random)};
      const Quatd back = euler_to_quat(order, quat_to_euler(order, rotation, near));
      EXPECT_LT(angle_between(rotation, back), 4e-7) << name(order) << " " << i;
    }
  }
}

TEST(Euler, both_solutions_are_tried) {
  const EulerOrder order = {3, {2, 0, 1}};
  // (170, 160, 190) turns like (-10, 20, 10); whichever is asked for comes back.
  const EulerAngles one = {-10, 20, 10}, other = {170, 160, 190};
  const Quatd rotation = euler_to_quat(order, one);
  EXPECT_LT(angle_between(rotation, euler_to_quat(order, other)), 1e-12);
  EXPECT_LT(largest_difference(quat_to_euler(order, rotation, one), one), 3e-5);
  EXPECT_LT(largest_difference(quat_to_euler(order, rotation, other), other), 3e-5);
}

TEST(Euler, gimbal_lock_keeps_the_first_angle) {
  const EulerOrder order = {3, {2, 1, 0}};
  const Quatd rotation = euler_to_quat(order, {30, 90, 40});
  const EulerAngles near = {71, 88, 80};
  const EulerAngles back = quat_to_euler(order, rotation, near);
  EXPECT_NEAR(back[0], 71, 1e-9);
  EXPECT_LT(angle_between(rotation, euler_to_quat(order, back)), 4e-7);
}

// Where x, y and z change places, no rounding hides the pole.
TEST(Euler, the_very_pole_keeps_the_first_angle_far_from_the_last_pose_too) {
  const EulerAngles back = quat_to_euler({3, {0, 1, 2}}, Quatd{0.5, 0.5, 0.5, 0.5}, {20, 80, 130});
  EXPECT_NEAR(back[0], 20, 1e-9);
  EXPECT_NEAR(back[1], 90, 1e-9);
}

TEST(Euler, a_steady_pose_at_the_pole_is_steady_in_spite_of_rounding) {
  const EulerOrder order = {3, {2, 1, 0}};
  EulerAngles angles = {30, 90, 40};
  std::mt19937 random(4);
  std::uniform_real_distribution<double> noise(-6e-8, 6e-8);  // A float's last bit.
  for (int i = 0; i < 1000; ++i) {
    Quatd q = euler_to_quat(order, {30, 90, 40});
    q = {q.x + noise(random), q.y + noise(random), q.z + noise(random), q.w + noise(random)};
    const EulerAngles next = quat_to_euler(order, q, angles);
    EXPECT_LT(largest_difference(next, angles), 0.01) << i;
    angles = next;
  }
}

TEST(Euler, a_rotation_that_few_axes_cannot_reach_comes_as_near_as_it_gets) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> angle(-180, 180);
  const EulerOrder full = {3, {0, 1, 2}};
  for (const EulerOrder& order : all_orders()) {
    if (order.count == 3) continue;
    for (int i = 0; i < 50; ++i) {
      const Quatd rotation = euler_to_quat(full, {angle(random), angle(random), angle(random)});
      const EulerAngles found = quat_to_euler(order, rotation, {0, 0, 0});
      const double distance = angle_between(rotation, euler_to_quat(order, found));
      for (int k = 0; k < 200; ++k) {
        const EulerAngles guess = cut(order, {angle(random), angle(random), 0});
        EXPECT_GE(angle_between(rotation, euler_to_quat(order, guess)), distance - 1e-9)
            << name(order);
      }
    }
  }
}

}  // namespace
}  // namespace panache
