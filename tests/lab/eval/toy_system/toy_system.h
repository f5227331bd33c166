#pragma once
// A system as small as one can be: it bends the back forward, whatever the style.

#include "eval/systems/table.h"
#include "takes/manifest.h"

namespace panache::test {

class ToySystem : public System {
 public:
  ToySystem(std::string name, std::vector<std::string> styles)
      : System(std::move(name)), styles_(std::move(styles)) {}

  std::vector<std::string> styles() const override { return styles_; }

  Result<RunResult> run(const TestInput& input, const StyleRequest& request) const override {
    float strength = 0;
    for (const auto& [style, share] : request.strengths) strength += share;
    Clip clip = input.clip;
    const int spine = input.rig.joints()[index(HumanJoint::spine)];
    for (int f = 0; f < clip.frames; ++f) {
      Quat& rotation = clip.pose(f).rotations[spine];
      rotation = axis_angle(Vec3{1, 0, 0}, 0.5f * strength) * rotation;
    }
    RunResult run_result;
    run_result.output.take = make_take(clip, input.rig, PoseLayout::positions);
    run_result.output.take.row = input.take.row;
    run_result.output.take.row.style = request.style;
    run_result.output.take.row.neutral = false;
    for (int f = 0; f < input.take.frames(); ++f) {
      run_result.output.source_frames.push_back(static_cast<float>(f));
    }
    return run_result;
  }

 private:
  std::vector<std::string> styles_;
};

inline Result<std::unique_ptr<System>> make_toy_system(const std::string& name,
                                                       const SystemData& data) {
  std::vector<std::string> styles;
  for (const StyleName& style : data.styles) styles.push_back(style.name);
  return std::unique_ptr<System>(std::make_unique<ToySystem>(name, styles));
}

}  // namespace panache::test
