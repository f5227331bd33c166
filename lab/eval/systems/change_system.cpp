#include "eval/systems/change_system.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <ctime>
#include <map>

#include "eval/systems/change_stepper.h"
#include "eval/systems/styled_clip.h"
#include "learn/samples.h"

namespace panache {
namespace {

// As EasedStrengths::amount() has it.
float amount_of(const ChangeSystem::Strengths& strengths) {
  float total = 0;
  for (const auto& [style, strength] : strengths) total += std::abs(strength);
  return std::min(1.0f, 4 * total);
}

// Instants further apart than this, in frames, are not one motion.
constexpr float kMaxGap = 4;

class SourceInstants : public InstantAnswers {
 public:
  SourceInstants(const ChangeSystem& system, double strength)
      : system_(system), styles_(system.styles()), strength_(static_cast<float>(strength)) {}

  std::optional<StyleDelta> change(const std::string& style, const Take& seen, float seen_at,
                                   const Take&, float) override {
    const auto found = std::find(styles_.begin(), styles_.end(), style);
    if (found == styles_.end()) return std::nullopt;
    const int index = static_cast<int>(found - styles_.begin());
    std::unique_ptr<ChangeSource>& source = sources_[{index, &seen}];
    if (!source) source = system_.make_source(seen, {{index, strength_}});
    const float gap = seen_at - last_at_;
    const bool goes_on = source.get() == last_ && gap >= 0 && gap <= kMaxGap;
    if (!goes_on) source->reset();
    last_ = source.get();
    last_at_ = seen_at;
    take_window(seen, seen_at, kNumbers, window_);
    // An output frame follows each other one: that is how the judge goes through them.
    return source->answer(window_, seen_at, 1 / static_cast<float>(kTakeRate)).delta;
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
    assert(found != styles_.end());  // As can_run() tells.
    if (strength != 0) strengths.emplace_back(found - styles_.begin(), strength);
  }
  return strengths;
}

Result<RunResult> ChangeSystem::run(const TestInput& input, const StyleRequest& request) const {
  const Strengths strengths = strengths_of(request);
  const std::unique_ptr<ChangeSource> source = make_source(input.take, strengths);
  const ChangedClip changed = change_clip(input, *source, amount_of(strengths), request.timing);
  return styled_result(input, request.style, changed.clip, changed.source_frames);
}

std::unique_ptr<InstantAnswers> ChangeSystem::instants(double strength) const {
  return std::make_unique<SourceInstants>(*this, strength);
}

double ChangeSystem::step_us(const TestInput& input) const {
  constexpr int kMinFrames = 1000;
  const std::clock_t begin = std::clock();
  int frames = 0;
  while (frames < kMinFrames) {
    const std::unique_ptr<ChangeSource> source = make_source(input.take, {{0, 1.0f}});
    frames += change_clip(input, *source, 1, false).clip.frames;
  }
  return 1e6 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC / frames;
}

}  // namespace panache
