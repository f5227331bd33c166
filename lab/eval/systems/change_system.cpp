#include "eval/systems/change_system.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <ctime>
#include <map>

#include "eval/system.h"
#include "learn/samples.h"
#include "pose/loop.h"
#include "style/play/play_clip.h"

namespace panache {
namespace {

// Changes of a source for the given strengths, scaled by EasedStrengths::amount().
class WithAmount final : public ChangeSource {
 public:
  WithAmount(std::unique_ptr<ChangeSource> source, const ChangeSystem::Strengths& strengths)
      : source_(std::move(source)) {
    float total = 0;
    for (const auto& [style, strength] : strengths) total += std::abs(strength);
    amount_ = std::min(1.0f, 4 * total);
  }

  AskedChange ask(const SourceInput& input) override {
    AskedChange asked = source_->ask(input);
    asked.amount = amount_;
    return asked;
  }

 private:
  std::unique_ptr<ChangeSource> source_;
  float amount_;
};

// Instants further apart, in frames, are separate motions.
constexpr float kMaxGap = 4;

class SourceInstants : public InstantAnswers {
 public:
  SourceInstants(const ChangeSystem& system, double strength)
      : system_(system), styles_(system.styles()), strength_(static_cast<float>(strength)) {}

  std::optional<StyleDelta> change(const std::string& style, const Take& seen, float seen_at,
                                   const Take& neutral, float at) override {
    const auto found = std::find(styles_.begin(), styles_.end(), style);
    if (found == styles_.end()) return std::nullopt;
    const int index = static_cast<int>(found - styles_.begin());
    std::unique_ptr<ChangeSource>& source = sources_[{index, &seen}];
    if (!source) source = system_.make_source(seen, 0, {{index, strength_}});
    const float gap = seen_at - last_at_;
    const bool goes_on = source.get() == last_ && gap >= 0 && gap <= kMaxGap;
    last_ = source.get();
    last_at_ = seen_at;
    take_window(seen, seen_at, kNumbers, window_);
    const HumanPositions body = body_at(neutral, at);
    // Evaluation requests output frames consecutively.
    constexpr double kStep = 1 / kTakeRate;
    return source
        ->ask({window_,
               &body,
               {kStep, static_cast<float>(kStep), !goes_on, nullptr, seen_at * kStep}})
        .delta;
  }

 private:
  static constexpr int kNumbers = pose_feature_count(PoseLayout::positions);

  const ChangeSystem& system_;
  const std::vector<std::string> styles_;
  const float strength_;
  std::map<std::pair<int, const Take*>, std::unique_ptr<ChangeSource>> sources_;
  const ChangeSource* last_ = nullptr;
  float last_at_ = 0;
  std::vector<float> window_ = std::vector<float>(size_t(kWindowPoses) * kNumbers);
};

}  // namespace

ChangeSystem::Strengths ChangeSystem::strengths_of(const StyleRequest& request) const {
  Strengths strengths;
  for (const auto& [style, strength] : request.strengths) {
    const auto found = std::find(styles_.begin(), styles_.end(), style);
    assert(found != styles_.end());  // Guaranteed by can_run().
    if (strength != 0) strengths.emplace_back(found - styles_.begin(), strength);
  }
  return strengths;
}

Restyled ChangeSystem::play(const TestInput& input, const Strengths& strengths, bool loop,
                            bool timing) const {
  const double begin = input.rig.first_frame() * input.clip.frame_time;
  const auto make = [&] {
    return std::make_unique<WithAmount>(make_source(input.take, begin, strengths), strengths);
  };
  RestyleOptions options;
  options.timing = timing;
  return play_clip(input.clip, input.rig, make, loop, options);
}

Result<RunResult> ChangeSystem::run(const TestInput& input, const StyleRequest& request) const {
  const bool loop = is_loop(measure_seam(input.clip, input.rig), input.clip.frame_time);
  return styled_result(input, request.style,
                       play(input, strengths_of(request), loop, request.timing));
}

std::unique_ptr<InstantAnswers> ChangeSystem::instants(double strength) const {
  return std::make_unique<SourceInstants>(*this, strength);
}

double ChangeSystem::step_us(const TestInput& input) const {
  constexpr int kMinFrames = 1000;
  const std::clock_t begin = std::clock();
  int frames = 0;
  while (frames < kMinFrames) {
    frames += play(input, {{0, 1.0f}}, false, false).clip.frames;
  }
  return 1e6 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC / frames;
}

}  // namespace panache
