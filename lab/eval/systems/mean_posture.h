#pragma once
// The baseline: each style's mean change over its training pairs, whatever the motion. Mean posture
// and tempo; feet are never planted.

#include "eval/systems/change_system.h"
#include "eval/systems/table.h"

namespace panache {

class MeanPosture final : public ChangeSystem {
 public:
  MeanPosture(std::string name, const SystemData& data);

  SystemFacts facts() const override;
  std::unique_ptr<ChangeSource> make_source(const Take& take, double begin,
                                            const Strengths& strengths) const override;

 private:
  struct Mean {
    StyleDelta change;
    float log_rate = 0;  // Logarithm of input seconds per output second.
  };
  std::vector<Mean> means_;  // [styles]
};

Result<std::unique_ptr<System>> make_mean_posture(const std::string& name, const SystemData& data);

}  // namespace panache
