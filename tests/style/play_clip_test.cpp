#include "style/play/play_clip.h"

#include <cmath>

#include <gtest/gtest.h>

#include "make_jump.h"

namespace panache {
namespace {

// Asks for nothing but a tempo.
class Tempo final : public ChangeSource {
 public:
  explicit Tempo(double rate) { asked_.log_rate = static_cast<float>(std::log(rate)); }
  AskedChange ask(const SourceInput&) override { return asked_; }

 private:
  AskedChange asked_;
};

// The impact of a landing between two frames would be a mean of both.
TEST(PlayClip, with_any_source_a_body_lands_on_whole_frames) {
  const test::Jump jump;
  Clip clip = jump.clip(60);
  // Carried ahead, because a body that stands keeps its input's time.
  for (int f = 0; f < clip.frames; ++f) {
    clip.pose(f).translations[0].z += static_cast<float>(f * clip.frame_time);
  }
  for (const double rate : {0.8, 1.3}) {
    const auto make = [&] { return std::make_unique<Tempo>(rate); };
    const Restyled out = play_clip(clip, *Rig::create(clip), make, false, {});
    EXPECT_NE(out.clip.frames, clip.frames);
    int in_the_air = 0;
    for (const double frame : out.source_frames) {
      const double seconds = frame * clip.frame_time;
      if (seconds < jump.take_off() + 0.2 || seconds > jump.landing() + 0.05) continue;
      EXPECT_NEAR(frame, std::round(frame), 0.05) << "at " << seconds << " s, rate " << rate;
      ++in_the_air;
    }
    EXPECT_GT(in_the_air, 10);
  }
}

// Asks for nothing, and remembers when.
class Witness final : public ChangeSource {
 public:
  explicit Witness(std::vector<StepTime>& times) : times_(times) {}
  AskedChange ask(const SourceInput& seen) override {
    times_.push_back(seen.time);
    AskedChange nothing;
    nothing.amount = 0;
    return nothing;
  }

 private:
  std::vector<StepTime>& times_;
};

TEST(PlayClip, a_source_is_told_the_time_of_the_clip_and_where_motion_begins) {
  const Clip clip = test::Jump().clip(60);
  std::vector<StepTime> times;
  const auto make = [&] { return std::make_unique<Witness>(times); };
  EXPECT_TRUE(is_unchanged(clip, play_clip(clip, *Rig::create(clip), make, false, {})));
  ASSERT_EQ(times.size(), static_cast<size_t>(clip.frames));
  for (size_t f = 0; f < times.size(); ++f) {
    EXPECT_EQ(times[f].first, f == 0);
    EXPECT_EQ(times[f].clip, static_cast<double>(f) * clip.frame_time);
  }
}

}  // namespace
}  // namespace panache
