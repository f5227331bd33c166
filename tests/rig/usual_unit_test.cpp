#include "rig/file_space.h"

#include <gtest/gtest.h>

#include "make_clip.h"
#include "rig/rig.h"

namespace panache {
namespace {

TEST(UsualUnit, legs_of_people_and_children_tell_it) {
  for (const double legs : {0.8, 0.96, 1.0, 1.2}) {
    EXPECT_EQ(usual_unit(1 / legs)->name, "metres");
    EXPECT_EQ(usual_unit(0.0254 / legs)->metres, 0.0254);
    EXPECT_EQ(usual_unit(0.01 / legs)->name, "centimetres");
    EXPECT_NEAR(usual_unit(0.0564 / legs)->metres, 0.056444, 1e-6);
  }
  EXPECT_FALSE(usual_unit(7));
  EXPECT_FALSE(usual_unit(0.1));
}

// A body 7 % shorter than the canonical one, in centimetres.
TEST(UsualUnit, a_short_person_stays_short) {
  Clip clip = test::walking_clip(10);
  for (Joint& joint : clip.skeleton.joints) joint.offset *= 93;
  for (Vec3& place : clip.translations) place *= 93;
  const Result<Rig> rig = Rig::create(clip);
  ASSERT_TRUE(rig.ok());
  EXPECT_EQ(rig->unit(), 0.01f);
  EXPECT_NEAR(rig->scale(), 1 / 93.0, 1e-5);
  RigOptions given;
  given.metres_per_unit = 0.0104f;
  EXPECT_EQ(Rig::create(clip, given)->unit(), 0.0104f);
}

}  // namespace
}  // namespace panache
