#include "bench/steps.h"

#include <algorithm>
#include <array>
#include <cassert>

#include <sys/resource.h>

#include "style/stylizer.h"

namespace panache::bench {
namespace {

constexpr int kParts = 10;
constexpr int64_t kStageShare = 5;  // One in so many steps is timed by stage.
constexpr int kMaxColdSteps = 500;
constexpr int64_t kUnseenSteps = 200;

std::vector<float> first_style(const Model& model) {
  std::vector<float> strengths(model.styles().size());
  strengths.front() = 1;
  return strengths;
}

// How often this thread has been preempted so far.
int64_t interruptions() noexcept {
  rusage usage{};
  ::getrusage(RUSAGE_THREAD, &usage);
  return usage.ru_nivcsw;
}

// A Stylizer and the motion that it steps through.
class Character {
 public:
  Character(const std::shared_ptr<const Model>& model, const Clip& walk, const Rig& rig)
      : walk_(walk),
        out_rotations_(walk.joints()),
        out_translations_(walk.joints()),
        strengths_(first_style(*model)),
        stylizer_(*Stylizer::create(model, rig)) {}

  void step() noexcept { stylizer_.step(in(), strengths_, walk_.frame_time, out()); }
  int64_t timed_step() noexcept {
    const int64_t begin = now_ns();
    step();
    return now_ns() - begin;
  }
  void step(StageClock& clock) noexcept {
    stylizer_.step(in(), strengths_, walk_.frame_time, out(), &clock);
  }

 private:
  ConstPose in() noexcept {
    const ConstPose pose = walk_.pose(frame_);
    frame_ = (frame_ + 1) % walk_.frames;
    return pose;
  }
  Pose out() noexcept { return {out_rotations_, out_translations_}; }

  const Clip& walk_;
  std::vector<Quat> out_rotations_;
  std::vector<Vec3> out_translations_;
  std::vector<float> strengths_;
  Stylizer stylizer_;
  int frame_ = 0;
};

// Times each stage of a step.
class StageTimes final : public StageClock {
 public:
  void begin() noexcept { begin_ = now_ns(); }
  void done(Stage stage) noexcept override {
    const int64_t now = now_ns();
    times_[static_cast<size_t>(stage)].add(now - begin_);
    begin_ = now_ns();
  }
  // Without the cost of the clock.
  double median(Stage stage) const {
    return std::max(0.0, times_[static_cast<size_t>(stage)].quantile(0.5) - clock_cost_ns());
  }

 private:
  int64_t begin_ = 0;
  std::array<Histogram, kStageNames.size()> times_;
};

}  // namespace

StepTimes time_steps(const std::shared_ptr<const Model>& model, const Clip& walk, int64_t steps,
                     const ProgressCall& progress) {
  const Result<Rig> rig = Rig::create(walk);
  assert(rig);
  Character character(model, walk, *rig), beside(model, walk, *rig), cold(model, walk, *rig);
  Character staged(model, walk, *rig);
  auto stages = std::make_unique<StageTimes>();
  auto whole = std::make_unique<Histogram>();
  StepTimes times;
  for (int part = 0; part < kParts; ++part) {
    for (int64_t i = 0; i < kUnseenSteps; ++i) character.step();
    const int64_t now = steps * (part + 1) / kParts - steps * part / kParts;
    const int64_t before = interruptions();
    for (int64_t i = 0; i < now; ++i) times.steps.add(character.timed_step());
    times.interruptions += interruptions() - before;
    for (int64_t i = 0; i < std::max<int64_t>(1, now / kStageShare); ++i) {
      stages->begin();
      staged.step(*stages);
      whole->add(beside.timed_step());
    }
    if (progress) progress((part + 1.0) / kParts);
  }
  std::vector<double> single;
  for (int64_t i = 0; i < std::clamp<int64_t>(steps / 100, 1, kMaxColdSteps); ++i) {
    evict_caches();
    single.push_back(static_cast<double>(cold.timed_step()));
  }
  for (size_t s = 0; s < kStageNames.size(); ++s) {
    times.stages.push_back({kStageNames[s], stages->median(static_cast<Stage>(s))});
  }
  times.networks = stages->median(Stage::networks);
  times.whole = std::max(0.0, whole->quantile(0.5) - clock_cost_ns());
  times.cold = std::max(0.0, quantile(single, 0.5) - clock_cost_ns());
  return times;
}

}  // namespace panache::bench
