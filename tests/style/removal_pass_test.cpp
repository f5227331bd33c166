#include "style/play/removal.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "make_clip.h"
#include "make_model.h"
#include "style/model/model.h"

namespace panache {
namespace {

// Takes "old" off, whatever that is.
std::shared_ptr<const Model> remover_of_old() {
  TensorFile file = test::make_model({"old", kAnyStyle}, 5);
  file.metadata[kDirection] = kRemove;
  return Model::parse(format_safetensors(file), "test model").value();
}

class RemovalPassTest : public testing::Test {
 protected:
  RemovalPass pass(StylizerOptions options = {}) const {
    return RemovalPass::create(remover_, rig_, options).value();
  }
  std::vector<Quat> step(RemovalPass& pass, int frame) const {
    const ConstPose out = pass.step(clip_.pose(frame), kSeconds, kSeconds);
    return {out.rotations.begin(), out.rotations.end()};
  }
  // Of frames 0 to `frames` - 1, the last.
  std::vector<Quat> play(RemovalPass& pass, int frames) const {
    std::vector<Quat> last;
    for (int f = 0; f < frames; ++f) last = step(pass, f);
    return last;
  }
  std::vector<Quat> input(int frame) const {
    const ConstPose in = clip_.pose(frame);
    return {in.rotations.begin(), in.rotations.end()};
  }

  static constexpr double kSeconds = 1.0 / 30;
  const Clip clip_ = test::walking_clip(90);
  const Rig rig_ = *Rig::create(clip_);
  const std::shared_ptr<const Model> remover_ = remover_of_old();
};

TEST_F(RemovalPassTest, takes_nothing_off_until_it_is_told_to) {
  RemovalPass none = pass();
  EXPECT_EQ(play(none, 30), input(29));
  none.set_removed(-1);
  none.set_removed(2);  // The remover has two styles.
  none.set_removed(-2);
  EXPECT_EQ(step(none, 30), input(30));
}

TEST_F(RemovalPassTest, is_the_stylizer_of_the_remover_at_strength_one) {
  RemovalPass removal = pass();
  Stylizer alone = Stylizer::create(remover_, rig_, {}).value();
  std::vector<Quat> rotations(clip_.joints());
  std::vector<Vec3> translations(clip_.joints());
  for (const int style : {0, 1, -1}) {
    removal.set_removed(style);
    std::vector<float> strengths(2);
    if (style >= 0) strengths[static_cast<size_t>(style)] = 1;
    for (int f = 0; f < 60; ++f) {
      // A second pass that plays at half the speed takes twice as long.
      alone.step(clip_.pose(f), strengths, {kSeconds, 2 * kSeconds}, {rotations, translations});
      const ConstPose out = removal.step(clip_.pose(f), kSeconds, 2 * kSeconds);
      ASSERT_TRUE(std::ranges::equal(out.rotations, rotations)) << style << " " << f;
      ASSERT_TRUE(std::ranges::equal(out.translations, translations)) << style << " " << f;
    }
    EXPECT_EQ(rotations == input(59), style < 0);
  }
}

TEST_F(RemovalPassTest, leaves_the_shape_to_the_styles_that_are_put_on) {
  StylizerOptions none;
  none.shape.strength = none.shape.foot_lock = 0;
  RemovalPass shaped = pass(none), whole = pass();
  shaped.set_removed(0), whole.set_removed(0);
  EXPECT_EQ(play(shaped, 30), play(whole, 30));
}

TEST_F(RemovalPassTest, goes_on_from_a_saved_state_and_begins_anew_after_a_reset) {
  RemovalPass removal = pass(), other = pass();
  removal.set_removed(0), other.set_removed(0);
  const std::vector<Quat> first = play(removal, 40);
  std::vector<std::byte> state(removal.state_size());
  removal.save(state);
  ASSERT_TRUE(other.restore(state));
  EXPECT_EQ(step(other, 40), step(removal, 40));
  removal.reset();
  EXPECT_EQ(play(removal, 40), first);
}

TEST_F(RemovalPassTest, takes_no_model_that_puts_styles_on) {
  const auto model = Model::parse(format_safetensors(test::make_model({"old"}, 3)), "m").value();
  const Result<RemovalPass> pass = RemovalPass::create(model, rig_, {});
  ASSERT_FALSE(pass.ok());
  EXPECT_EQ(pass.error().message, "the model puts styles on; expected one that takes them off");
}

}  // namespace
}  // namespace panache
