// Ground that is not flat: a style that shortens the path shortens the climb alike.

#include "style/stages/root_motion.h"

#include <cmath>

#include "odd_files.h"
#include "rig/posed_rig.h"
#include "style/restyle.h"
#include "style_checks.h"

namespace panache {
namespace {

using namespace test;

constexpr float kSlope = 0.3f;

// The fixture, or the same walk down or on the level.
Clip walk_on(float slope) {
  Clip clip = odd_clip("slope-up.bvh");
  for (int f = 0; f < clip.frames; ++f) {
    Vec3& at = clip.pose(f).translations[0];
    at.y += (slope - kSlope) * at.z;
  }
  return clip;
}

struct Path {
  float along = 0, climb = 0;
  float above = 0;  // Of the lower toe over the ground, the mean of the last second.
};
Path path_of(const Clip& clip, float slope) {
  const auto at = world_positions(clip);
  const int left = find_joint_named(clip, "leftToes"), right = find_joint_named(clip, "rightToes");
  Path path;
  path.along = at.back()[0].z - at.front()[0].z;
  path.climb = at.back()[0].y - at.front()[0].y;
  const size_t last = 20;
  for (size_t f = at.size() - last; f < at.size(); ++f) {
    const auto over = [&](int toe) { return at[f][toe].y - slope * at[f][toe].z; };
    path.above += std::min(over(left), over(right)) / static_cast<float>(last);
  }
  return path;
}

TEST(Climb, path_and_climb_change_together) {
  const int old = *shipped_model()->find_style("old");
  for (const float slope : {kSlope, -kSlope}) {
    const Clip clip = walk_on(slope);
    const Rig rig = *Rig::create(clip);
    const auto styled = restyle(clip, rig, shipped_model(), {{old, {{0, 1}}}});
    ASSERT_TRUE(styled.ok()) << styled.error().message;
    const Path before = path_of(clip, slope), after = path_of(styled->clip, slope);
    // The style shortens this walk by a quarter; without its climb the slope would be a third off.
    EXPECT_LT(after.along, 0.9f * before.along);
    EXPECT_NEAR(after.climb / after.along, slope, 0.07f);
    EXPECT_NEAR(after.above, before.above, 0.06f);
  }
}

TEST(Climb, a_path_that_is_held_back_keeps_the_ground_of_the_input) {
  const Clip clip = walk_on(kSlope);
  const Rig rig = *Rig::create(clip);
  RestyleOptions options;
  options.timing = false;
  options.stylizer.shape.regions[static_cast<size_t>(Region::legs)] = 0;
  const auto styled = restyle(clip, rig, shipped_model(),
                              {{*shipped_model()->find_style("old"), {{0, 1}}}}, options);
  ASSERT_TRUE(styled.ok()) << styled.error().message;
  const Path before = path_of(clip, kSlope), after = path_of(styled->clip, kSlope);
  EXPECT_NEAR(after.along, before.along, 0.05f);
  EXPECT_NEAR(after.above, before.above, 0.06f);
}

// Steps of 0.6 m to these heights, 0.5 s each, while a style takes back a fifth of the way: the
// height of the ground under the changed path at the end.
float height_after(const std::vector<float>& heights) {
  Climb climb;
  StepTime time{1 / 30.0, 1 / 30.0f, true};
  BodyPose body;
  float distance = 0;
  for (size_t i = 0; i < heights.size(); ++i) {
    const int toe = index(kToes[i % 2]);
    for (int f = 0; f < 15; ++f) {
      distance += 0.6f / 15;
      body.joints[toe] = {0, heights[i], 0.6f * static_cast<float>(i + 1)};
      body.joints[index(kToes[1 - i % 2])].z += 0.1f;  // Swings.
      climb.step(body, {0, 0, -distance / 5}, time);
      time.first = false;
    }
  }
  return climb.height();
}

TEST(Climb, a_foot_on_something_is_no_slope) {
  EXPECT_EQ(height_after({0, 0, 0.15f, 0, 0.15f, 0, 0}), 0);
  EXPECT_EQ(height_after({0, 0.02f, 0.04f, 0.06f, 0.08f, 0.1f}), 0);
}

TEST(Climb, stairs_are_climbed_as_far_as_the_path_goes) {
  // A fifth less of the way, from the first stair on.
  EXPECT_NEAR(height_after({0, 0, 0.15f, 0.3f, 0.45f, 0.6f}), -0.6f / 5, 0.02f);
  EXPECT_NEAR(height_after({0.6f, 0.6f, 0.45f, 0.3f, 0.15f, 0}), 0.6f / 5, 0.02f);
}

}  // namespace
}  // namespace panache
