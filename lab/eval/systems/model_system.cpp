#include "eval/systems/model_system.h"

#include <algorithm>
#include <ctime>

#include "eval/system.h"
#include "learn/samples.h"
#include "style/networks/networks.h"
#include "style/restyle.h"

namespace panache {
namespace {

class ModelInstants : public InstantAnswers {
 public:
  ModelInstants(std::shared_ptr<const Model> model, double strength)
      : networks_(std::move(model)),
        strength_(static_cast<float>(strength)),
        strengths_(networks_.model().styles().size()),
        numbers_(pose_feature_count(networks_.model().layout())),
        window_(size_t(kWindowPoses) * numbers_) {}

  std::optional<StyleDelta> change(const std::string& style, const Take& seen, float seen_at,
                                   const Take& neutral, float at) override {
    const std::vector<StyleInfo>& styles = networks_.model().styles();
    const auto found = std::find_if(styles.begin(), styles.end(),
                                    [&](const StyleInfo& s) { return s.name == style; });
    if (found == styles.end()) return std::nullopt;
    std::fill(strengths_.begin(), strengths_.end(), 0.0f);
    strengths_[found - styles.begin()] = strength_;
    networks_.set_strengths(strengths_);
    take_window(seen, seen_at, numbers_, window_);
    networks_.forward(window_);
    const auto root = std::span(window_).subspan(numbers_ - kRootFeatures).first<kRootFeatures>();
    return networks_.model().recipe().to_change(networks_.pose(), body_at(neutral, at), root);
  }

 private:
  StyleNetworks networks_;
  float strength_;
  std::vector<float> strengths_;
  int numbers_;
  std::vector<float> window_;
};

}  // namespace

ModelSystem::ModelSystem(std::string name, std::shared_ptr<const Model> model, size_t bytes)
    : System(std::move(name)), model_(std::move(model)), bytes_(bytes) {}

SystemFacts ModelSystem::facts() const {
  return {model_->recipe().name, bytes_, model_->parameter_count(), std::nullopt};
}

std::vector<std::string> ModelSystem::styles() const {
  std::vector<std::string> names;
  for (const StyleInfo& style : model_->styles()) names.push_back(style.name);
  return names;
}

Result<RunResult> ModelSystem::run(const TestInput& input, const StyleRequest& request) const {
  std::vector<StrengthTrack> tracks;
  for (const auto& [style, strength] : request.strengths) {
    Result<int> found = model_->find_style(style);
    if (!found) return found.error();
    tracks.push_back({*found, {{0, strength}}});
  }
  RestyleOptions options;
  options.timing = request.timing;
  Result<Restyled> restyled = restyle(input.clip, input.rig, model_, tracks, options);
  if (!restyled) return located(input.take.row.path, restyled.error());
  return styled_result(input, request.style, *restyled);
}

std::unique_ptr<InstantAnswers> ModelSystem::instants(double strength) const {
  return std::make_unique<ModelInstants>(model_, strength);
}

double ModelSystem::step_us(const TestInput& input) const {
  Result<Stylizer> stylizer = Stylizer::create(model_, input.rig);
  if (!stylizer) return kNotMeasured;
  std::vector<float> strengths(model_->styles().size());
  strengths.front() = 1;
  std::vector<Quat> rotations(input.clip.joints());
  std::vector<Vec3> translations(input.clip.joints());
  constexpr int kSteps = 3000;
  const std::clock_t begin = std::clock();
  for (int i = 0; i < kSteps; ++i) {
    stylizer->step(input.clip.pose(i % input.clip.frames), strengths, input.clip.frame_time,
                   {rotations, translations});
  }
  return 1e6 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC / kSteps;
}

}  // namespace panache
