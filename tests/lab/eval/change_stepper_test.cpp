#include "eval/systems/change_stepper.h"

#include <cmath>

#include <gtest/gtest.h>

#include "make_jump.h"

namespace panache {
namespace {

// Asks for nothing but a tempo.
class Tempo final : public ChangeSource {
 public:
  explicit Tempo(double rate) { asked_.log_rate = static_cast<float>(std::log(rate)); }
  void reset() override {}
  AskedChange answer(std::span<const float>, float, float) override { return asked_; }

 private:
  AskedChange asked_;
};

// The impact of a landing between two frames would be a mean of both, for these systems and not for
// ours.
TEST(ChangeStepper, a_body_lands_on_whole_frames_as_with_the_model) {
  const test::Jump jump;
  Clip clip = jump.clip(60);
  // Carried ahead, because a body that stands keeps its input's time.
  for (int f = 0; f < clip.frames; ++f) {
    clip.pose(f).translations[0].z += static_cast<float>(f * clip.frame_time);
  }
  const TestInput input{clip, *Rig::create(clip), {}};
  for (const double rate : {0.8, 1.3}) {
    Tempo source(rate);
    const ChangedClip out = change_clip(input, source, 1, true);
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

}  // namespace
}  // namespace panache
