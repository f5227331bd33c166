#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "make_clip.h"
#include "make_model.h"
#include "style/live_stylizer.h"
#include "style/model/model.h"
#include "style/play/removal.h"
#include "style_checks.h"

namespace panache {
namespace {

// Takes "old" off, whatever that is, and plays at this rate.
std::shared_ptr<const Model> remover(double rate = 1) {
  TensorFile file = test::make_model({"old", kAnyStyle}, 5);
  file.metadata[kDirection] = kRemove;
  test::set_rate(file, rate);
  return read(file);
}

class RemovalTest : public testing::Test {
 protected:
  static Restyled must(Result<Restyled> result) {
    EXPECT_TRUE(result.ok()) << (result ? "" : result.error().message);
    return *std::move(result);
  }
  const Clip clip_ = test::walking_clip(120);
  const Rig rig_ = *Rig::create(clip_);
  const std::shared_ptr<const Model> model_ = read(test::make_model({"old", "proud"}, 3));
};

TEST_F(RemovalTest, a_model_that_puts_styles_on_removes_none) {
  EXPECT_FALSE(is_remover(*model_));
  const Result<int> found = find_removal(*model_, "old");
  ASSERT_FALSE(found.ok());
  EXPECT_EQ(found.error().message, "the model puts styles on; expected one that takes them off");
  EXPECT_EQ(*find_removal(*remover(), "old"), 0);
  EXPECT_EQ(*find_removal(*remover(), ""), 1);
  EXPECT_FALSE(find_removal(*remover(), "oldd").ok());
}

// As it is taken off: the style may be what puts hands where they are.
RestyleOptions loose_hands() {
  RestyleOptions options;
  options.stylizer.shape.hand_contacts = 0;
  return options;
}

TEST_F(RemovalTest, without_a_style_the_result_is_that_of_the_remover_alone_with_loose_hands) {
  const auto off = remover();
  Clip phoning = clip_;  // The left hand at the head.
  for (int f = 0; f < phoning.frames; ++f) {
    phoning.pose(f).rotations[index(HumanJoint::left_lower_arm)] = axis_angle({0, 1, 0}, -2.6f);
  }
  const Restyled once = must(restyle(phoning, rig_, off, {{0, {{0, 1}}}}, loose_hands()));
  EXPECT_NE(must(restyle(phoning, rig_, off, {{0, {{0, 1}}}})).clip.rotations, once.clip.rotations);
  const Restyled removed = must(restyle_without(phoning, rig_, {off, 0}, model_, {{1, {{0, 0}}}}));
  EXPECT_EQ(removed.clip.rotations, once.clip.rotations);
  EXPECT_EQ(removed.source_frames, once.source_frames);
}

TEST_F(RemovalTest, a_style_is_put_on_what_is_left) {
  const auto off = remover();
  const Restyled once = must(restyle(clip_, rig_, off, {{0, {{0, 1}}}}));
  const Restyled twice = must(restyle(once.clip, rig_, model_, {{1, {{0, 1}}}}));
  const Restyled both = must(restyle_without(clip_, rig_, {off, 0}, model_, {{1, {{0, 1}}}}));
  EXPECT_EQ(both.clip.rotations, twice.clip.rotations);
  EXPECT_EQ(both.clip.translations, twice.clip.translations);
}

// Every tempo is played, from end to end.
const RestyleOptions kOwnTempo = [] {
  RestyleOptions options;
  options.stylizer.tempo_everywhere = true;
  options.loop = LoopMode::off;
  return options;
}();

TEST_F(RemovalTest, the_tempo_is_undone_and_source_frames_are_those_of_the_clip) {
  const auto off = remover(0.5);
  const Restyled once = must(restyle(clip_, rig_, off, {{0, {{0, 1}}}}, kOwnTempo));
  const Restyled both =
      must(restyle_without(clip_, rig_, {off, 0}, model_, {{1, {{0, 1}}}}, kOwnTempo));
  EXPECT_GT(once.clip.frames, clip_.frames * 3 / 2);
  for (const double source : both.source_frames) {
    EXPECT_GE(source, 0);
    EXPECT_LE(source, clip_.frames - 1 + 1e-6);
  }
  EXPECT_TRUE(std::is_sorted(both.source_frames.begin(), both.source_frames.end()));
}

TEST_F(RemovalTest, a_strength_keeps_its_place_in_the_clip) {
  const double end = (clip_.frames - 1) * clip_.frame_time;
  const auto off = remover(0.5);
  const Restyled once = must(restyle(clip_, rig_, off, {{0, {{0, 1}}}}, kOwnTempo));
  // The style begins in the last quarter of the clip: nothing changes before.
  const Restyled both = must(restyle_without(clip_, rig_, {off, 0}, model_,
                                             {{1, {{0.75 * end, 0}, {0.8 * end, 1}}}}, kOwnTempo));
  const int quiet = once.clip.frames / 2;
  for (int f = 0; f < quiet; ++f) {
    for (size_t j = 0; j < clip_.joints(); ++j) {
      ASSERT_EQ(both.clip.pose(f).rotations[j], once.clip.pose(f).rotations[j]) << f;
    }
  }
}

TEST_F(RemovalTest, live_what_is_removed_can_be_switched_and_is_part_of_the_state) {
  LiveOptions options;
  options.remover = remover();
  Result<LiveStylizer> live = LiveStylizer::create(model_, rig_, options);
  ASSERT_TRUE(live.ok()) << live.error().message;
  EXPECT_FALSE(live->is_pass_through());
  Clip out = clip_;
  const std::vector<float> none(2);
  const auto step = [&](LiveStylizer& one, int f) {
    one.step(clip_.pose(f), none, clip_.frame_time, out.pose(f));
  };
  for (int f = 0; f < 10; ++f) step(*live, f);
  EXPECT_EQ(out.rotations, clip_.rotations);  // Nothing is removed yet.
  live->set_removed(0);
  live->set_removed(7);  // Ignored.
  for (int f = 10; f < 30; ++f) step(*live, f);
  EXPECT_NE(out.rotations, clip_.rotations);

  std::vector<std::byte> state(live->state_size());
  live->save(state);
  Result<LiveStylizer> other = LiveStylizer::create(model_, rig_, options);
  other->set_removed(0);
  ASSERT_TRUE(other->restore(state));
  step(*live, 30);
  const Clip first = out;
  step(*other, 30);
  EXPECT_EQ(out.rotations, first.rotations);
  state.back() ^= std::byte{1};
  EXPECT_FALSE(other->restore(state));
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
  const std::shared_ptr<const Model> remover_ = remover();
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
  LiveOptions options;
  options.remover = read(test::make_model({"old"}, 3));
  const auto live = LiveStylizer::create(options.remover, rig_, options);
  ASSERT_FALSE(live.ok());
  EXPECT_EQ(live.error().message, "the model puts styles on; expected one that takes them off");
}

}  // namespace
}  // namespace panache
