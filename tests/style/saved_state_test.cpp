// Characters with the same history save the same bytes, whatever their memory held before: programs
// that play a moment again (rollback) compare them.
#include <malloc.h>

#include <algorithm>
#include <cstring>

#include <gtest/gtest.h>

#include "make_clip.h"
#include "style/live_stylizer.h"
#include "style/model/person.h"
#include "style_checks.h"

namespace panache {
namespace {

constexpr double kFrameSeconds = 1.0 / 60;

// Fills what the stack will be of functions called next.
[[gnu::noinline]] void fill_stack(int garbage) {
  char room[256 * 1024];
  std::memset(room, garbage, sizeof room);
  asm volatile("" : : "r"(room) : "memory");  // Or the compiler leaves it out.
}

class SavedState : public testing::Test {
 protected:
  SavedState() { strengths_[static_cast<size_t>(*model_->find_style("old"))] = 1; }
  static std::vector<LiveOptions> option_sets() {
    LiveOptions late;
    late.max_lag = 1.2, late.max_lead = 0.2, late.skip_cycles = true;
    return {LiveOptions{}, late};
  }
  LiveStylizer character(const LiveOptions& options) const {
    return *LiveStylizer::create(model_, *Rig::create(walk_), options);
  }
  Clip play(LiveStylizer& character, int from, int to, int garbage = 0) const {
    Clip out = walk_;
    for (int f = from; f < to; ++f) {
      if (garbage) fill_stack(garbage);
      character.step(walk_.pose(f), strengths_, kFrameSeconds, out.pose(f));
    }
    return out;
  }
  static std::vector<std::byte> saved(const LiveStylizer& character) {
    std::vector<std::byte> out(character.state_size());
    character.save(out);
    return out;
  }
  // Where they differ first, or -1.
  static long differ(const std::vector<std::byte>& a, const std::vector<std::byte>& b) {
    const auto at = std::mismatch(a.begin(), a.end(), b.begin(), b.end()).first;
    return at == a.end() ? -1 : at - a.begin();
  }

  Clip walk_ = walker_walk(400);
  std::shared_ptr<const Model> model_ = shipped_model();
  std::vector<float> strengths_ = std::vector<float>(model_->styles().size());
};

TEST_F(SavedState, has_nothing_of_what_its_memory_held_before) {
  for (const LiveOptions& options : option_sets()) {
    // From the first step to a ring that has gone round.
    for (const int frames : {0, 1, 2, 20, 100, 399}) {
      std::vector<std::byte> states[2];
      for (const int garbage : {0x5a, 0xc3}) {
        mallopt(M_PERTURB, garbage);
        fill_stack(garbage);
        LiveStylizer one = character(options);
        play(one, 0, frames, garbage);
        states[garbage == 0xc3] = saved(one);
        mallopt(M_PERTURB, 0);
      }
      EXPECT_EQ(differ(states[0], states[1]), -1)
          << frames << " frames; of " << states[0].size() << " bytes";
    }
  }
}

TEST_F(SavedState, after_a_reset_or_a_pause_has_nothing_of_the_past) {
  for (const LiveOptions& options : option_sets()) {
    for (const int frames : {1, 2, 20, 150}) {
      LiveStylizer fresh = character(options), reset = character(options),
                   paused = character(options);
      play(reset, 0, 220);
      reset.reset();
      play(paused, 0, 220);
      for (LiveStylizer* one : {&fresh, &reset, &paused}) {
        Clip out = walk_;
        one->step(walk_.pose(220), strengths_, one == &reset ? kFrameSeconds : 2, out.pose(0));
        play(*one, 221, 220 + frames);
      }
      EXPECT_EQ(differ(saved(fresh), saved(paused)), -1) << frames << " frames";
      LiveStylizer again = character(options);
      play(again, 220, 220 + frames);
      EXPECT_EQ(differ(saved(again), saved(reset)), -1) << frames << " frames";
    }
  }
}

// A person's, in the middle of a gesture and of a change of sides.
TEST_F(SavedState, goes_on_bit_for_bit_after_it_was_restored) {
  const int old = *model_->find_style("old"), scared = *model_->find_style("scared");
  strengths_[static_cast<size_t>(scared)] = 1;
  for (const LiveOptions& options : option_sets()) {
    LiveStylizer one = character(options), other = character(options);
    for (LiveStylizer* each : {&one, &other}) {
      each->stylizer().set_person(person_of_seed(*model_, 3, 1));
    }
    play(one, 0, 110);
    play(other, 200, 390);
    ASSERT_TRUE(one.stylizer().trigger(scared, 0));
    play(one, 110, 136);
    for (LiveStylizer* each : {&one, &other}) each->stylizer().set_side(old, -1);
    play(one, 136, 140);
    ASSERT_TRUE(one.stylizer().gesture());
    const std::vector<std::byte> then = saved(one);
    const int skipped = one.skipped_cycles();
    const Clip expected = play(one, 140, 300);
    ASSERT_TRUE(other.restore(then));
    EXPECT_EQ(differ(saved(other), then), -1);
    EXPECT_EQ(other.skipped_cycles(), skipped);
    EXPECT_TRUE(test::same_bits(play(other, 140, 300), expected));
    EXPECT_EQ(differ(saved(other), saved(one)), -1);
  }
}

}  // namespace
}  // namespace panache
