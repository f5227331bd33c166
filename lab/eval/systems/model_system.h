#pragma once
// A model of ours, run as users run it: a whole clip through restyle().

#include "eval/system.h"

namespace panache {

class ModelSystem : public System {
 public:
  // `bytes`: file size, or 0 without a file.
  ModelSystem(std::string name, std::shared_ptr<const Model> model, size_t bytes = 0);

  SystemFacts facts() const override;
  std::vector<std::string> styles() const override;
  Result<RunResult> run(const TestInput& input, const StyleRequest& request) const override;
  // The networks alone: no filter, root motion or foot lock.
  std::unique_ptr<InstantAnswers> instants(double strength) const override;
  PoseLayout layout() const override { return model_->layout(); }
  double step_us(const TestInput& input) const override;
  std::shared_ptr<const Model> model() const override { return model_; }

 private:
  std::shared_ptr<const Model> model_;
  size_t bytes_;
};

}  // namespace panache
