// panache.hpp: what the C interface gives, by objects and exceptions.
#include <type_traits>
#include <utility>

#include <panache/panache.hpp>

#include "stick_api.h"

namespace {

using panache::test::model_bytes;
using panache::test::Walk;
using panache::test::walk_bvh;

static_assert(!std::is_copy_constructible_v<panache::Character>);
static_assert(std::is_nothrow_move_constructible_v<panache::Character>);
static_assert(noexcept(std::declval<panache::Character&>().step({}, 0, {})));

class CppHeader : public panache::test::StickApi {
 protected:
  // The status and message that `work` throws.
  template <class Work>
  static std::pair<panache_status, std::string> error_of(Work work) {
    try {
      work();
    } catch (const panache::Error& error) {
      return {error.status(), error.what()};
    }
    return {PANACHE_OK, "nothing was thrown"};
  }

  const std::string bytes_ = model_bytes();
  const panache::Model model{bytes_.data(), bytes_.size()};
  const panache::Skeleton skeleton{stick_figure, STICK_JOINTS};
};

TEST_F(CppHeader, a_character_steps_and_returns_to_a_state_with_the_bits_of_the_c_interface) {
  panache_character* expected = StickApi::character("old");
  const std::vector<stick_pose> steps = walk(expected, 90);
  panache::Character made(model, skeleton);
  panache::Character moved(std::move(made));
  moved.set_strength(model.find_style("old"), 1);
  std::vector<stick_pose> half = walk(moved.get(), 45);
  const auto state = moved.save();
  for (int again = 0; again < 2; ++again) {
    std::vector<stick_pose> all = half;
    for (int f = 45; f < 90; ++f) {
      stick_pose in;
      stick_walk(f / 60.0, 0, &in);
      moved.step(stick_input(&in), 1 / 60.0, stick_output(&all.emplace_back()));
    }
    EXPECT_TRUE(same(all, steps));
    EXPECT_EQ(moved.report().gate, panache::test::report_of(expected).gate);
    moved.restore(state);
  }
}

TEST_F(CppHeader, characters_step_together) {
  panache::Character one(model, skeleton), two(model, skeleton);
  one.set_strength(model.find_style("proud"), 1);
  stick_pose in, alone, out[2];
  stick_walk(0, 0, &in);
  panache::Character other(model, skeleton);
  other.set_strength(model.find_style("proud"), 1);
  other.step(stick_input(&in), 1 / 60.0, stick_output(&alone));
  panache_character* const both[] = {one.get(), two.get()};
  const panache_input_pose ins[] = {stick_input(&in), stick_input(&in)};
  const panache_output_pose outs[] = {stick_output(&out[0]), stick_output(&out[1])};
  panache::step_many(both, 2, ins, 1 / 60.0, outs);
  EXPECT_EQ(std::memcmp(&out[0], &alone, sizeof alone), 0);
  EXPECT_EQ(std::memcmp(&out[1], &in, sizeof in), 0);  // Without a style.
}

TEST_F(CppHeader, a_file_is_read_styled_and_written) {
  const std::string bvh = walk_bvh(60);
  const panache::MotionFile file(bvh.data(), bvh.size(), "walk.bvh");
  EXPECT_EQ(file.joint_count(), STICK_JOINTS);
  ASSERT_EQ(file.clip_count(), 1);
  EXPECT_STREQ(file.clip_name(0), "");
  const panache::Skeleton found = file.skeleton(0);
  EXPECT_EQ(found.joint_count(), STICK_JOINTS);
  EXPECT_EQ(found.find("leftToes"), 14);
  const panache_strength_key key = {0, 0};
  const panache_strength_track track = {model.find_style("old"), 1, &key};
  const panache::StyledClip same = panache::stylize(model, file.clip(0, found), &track, 1);
  ASSERT_EQ(same.frame_count(), 60);
  EXPECT_EQ(same.source_frames()[59], 59);
  EXPECT_FALSE(same.is_loop());
  const panache_clip frames = {found.get(), 60, 0.016667, same.rotations(), same.translations()};
  const panache_clip_edit edit = {0, nullptr, frames, nullptr};
  const panache::Bytes written = file.write(&edit, 1, PANACHE_REPLACE);
  EXPECT_EQ(std::string(static_cast<const char*>(written.data()), written.size()), bvh);

  const panache::StyledClip put_on = panache::retarget(file.clip(0, found), skeleton);
  EXPECT_EQ(put_on.frame_count(), 60);
  EXPECT_EQ(put_on.gates()[0], 1);
}

TEST_F(CppHeader, a_learnt_style_is_in_the_model) {
  const Walk neutral(skeleton.get(), 180, false), bent(skeleton.get(), 180, true);
  const panache_pair pair = {neutral.clip, bent.clip};
  const panache::Learnt learnt(bytes_.data(), bytes_.size(), &pair, 1, "bent");
  size_t size = 0;
  const void* model_with_it = learnt.model(size);
  const panache::Model with_it(model_with_it, size);
  EXPECT_EQ(with_it.style_count(), model.style_count() + 1);
  EXPECT_STREQ(with_it.style_name(with_it.find_style("bent")), "bent");
  EXPECT_EQ(with_it.style_info(with_it.find_style("bent")).is_learnt, 1);
  EXPECT_EQ(learnt.report().was_tested, 1);
  EXPECT_STRNE(learnt.verdict(), "");
  EXPECT_EQ(error_of([&] { panache::Learnt(model_with_it, size, &pair, 1, "bent"); }).first,
            PANACHE_BAD_ARGUMENT);
  EXPECT_NO_THROW(panache::Learnt(model_with_it, size, &pair, 1, "bent", true));
}

TEST_F(CppHeader, failures_are_exceptions_with_the_message_of_the_library) {
  const auto [bad_model, model_text] = error_of([] { panache::Model("none", 4); });
  EXPECT_EQ(bad_model, PANACHE_BAD_MODEL);
  EXPECT_EQ(model_text, panache_last_error());
  EXPECT_EQ(error_of([] { panache::Skeleton(stick_figure, 3); }).first, PANACHE_BAD_SKELETON);
  EXPECT_EQ(error_of([] { panache::MotionFile("x", 1, "x.bvh"); }).first, PANACHE_BAD_FILE);
  const auto [bad_style, style_text] = error_of([this] { model.find_style("odl"); });
  EXPECT_EQ(bad_style, PANACHE_BAD_ARGUMENT);
  EXPECT_EQ(style_text, "unknown style 'odl'; the nearest is old");
  panache::Character character(model, skeleton);
  EXPECT_EQ(error_of([&] { character.restore({1, 2, 3}); }).first, PANACHE_BAD_STATE);
  panache_shape shape = PANACHE_SHAPE;
  shape.struct_size = 0;
  EXPECT_EQ(error_of([&] { character.set_shape(shape); }).first, PANACHE_BAD_ARGUMENT);
}

}  // namespace
