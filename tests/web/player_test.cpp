#include "player.h"

#include <cmath>

#include <gtest/gtest.h>

#include "clip/bvh.h"
#include "clip/motion_format.h"
#include "make_clip.h"
#include "make_jump.h"
#include "make_model.h"
#include "style/model/model.h"

namespace panache::web {
namespace {

// Knows motion whose features are within `limit` of their mean.
std::shared_ptr<const Model> model_of(float limit, bool removes) {
  TensorFile file = test::make_model({"old", kAnyStyle}, 3);
  if (removes) file.metadata[kDirection] = kRemove;
  test::add_gate(file, limit);
  return Model::parse(format_safetensors(file), "test model").value();
}

// The gate after a second of a walk. `removed`: the style of the remover to take off, or -1.
float gate(float limit, float limit_of_remover, int removed) {
  std::shared_ptr<const MotionFile> file =
      parse_motion(format_bvh(test::walking_clip(90)), "walk.bvh").value();
  auto player =
      Player::create(model_of(limit, false), Source::create(std::move(file), 0).value()).value();
  EXPECT_TRUE(player->use_remover(model_of(limit_of_remover, true)).ok());
  player->set_removed(removed);
  player->character()->strengths[0] = 1;
  for (int f = 0; f < 30; ++f) player->step(1.0 / 30);
  return player->gate();
}

TEST(PlayerTest, a_motion_is_as_familiar_as_to_the_less_familiar_of_two_passes) {
  constexpr float kOpen = 1e6f, kClosed = 1e-3f;
  EXPECT_EQ(gate(kOpen, kOpen, 0), 1);
  EXPECT_LT(gate(kClosed, kOpen, 0), 0.5f);
  EXPECT_LT(gate(kOpen, kClosed, 0), 0.5f);
  EXPECT_EQ(gate(kOpen, kClosed, -1), 1);  // Nothing is removed.
}

// There are more jumps than are remembered.
TEST(PlayerTest, jumps_of_a_clip_are_seen_before_they_begin_in_each_round) {
  const test::Jump jump;
  const Clip one = jump.clip(60);
  const double seconds = one.frames / 60.0;
  Clip many = one;
  for (int k = 1; k < 15; ++k) {
    for (int f = 0; f < one.frames; ++f) many.append(one.pose(f));
  }
  std::shared_ptr<const MotionFile> file = parse_motion(format_bvh(many), "jumps.bvh").value();
  Source source = Source::create(std::move(file), 0).value();
  std::vector<Quat> rotations(many.joints());
  std::vector<Vec3> translations(rotations.size());
  for (int rounds = 0; rounds < 3;) {
    if (source.advance(1.0 / 60, {rotations, translations})) ++rounds;
    const double at = std::fmod(source.seconds(), seconds);
    if (at > jump.take_off() && at < jump.landing()) {
      EXPECT_GT(*source.flight(), 0.99f) << rounds << ", " << source.seconds();
    }
    if (at > jump.landing() + 0.5) {
      EXPECT_EQ(*source.flight(), 0) << rounds << ", " << source.seconds();
    }
  }
}

}  // namespace
}  // namespace panache::web
