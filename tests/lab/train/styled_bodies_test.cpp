#include "train/styled_bodies.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "body_tensor.h"
#include "make_styled_takes.h"
#include "style/stages/pose_change.h"

namespace panache {
namespace {

using test::as_tensor;

TEST(StyledBodies, are_those_of_the_live_step) {
  const Take take = test::styled_take("neutral", "walk", 0);
  Random random(7);
  for (int f = 0; f < take.frames(); f += 10) {
    StyleDelta delta;
    for (Vec3& r : delta.rotations) r = {random.normal(), random.normal(), random.normal()};
    delta.rotations[3] = {};  // The formula has no angle to divide by.
    delta.hips_height = 0.1f;
    std::array<float, StyleDelta::kSize> packed;
    pack(delta, packed);
    const HumanPositions expected = change_body(take.body[f], delta);
    const torch::Tensor made =
        styled_bodies(as_tensor(take.body[f]).unsqueeze(0),
                      torch::from_blob(packed.data(), {1, StyleDelta::kSize}));
    EXPECT_LT((made[0] - as_tensor(expected)).abs().max().item<float>(), 1e-5f) << f;
  }
}

}  // namespace
}  // namespace panache
