#pragma once
// The simplest system that is one: each style's mean posture, whatever the motion.

#include <memory>
#include <string>
#include <vector>

#include "base/result.h"
#include "style/model.h"
#include "train/trainer.h"

namespace panache {

// A model of the default recipe whose change is each style's mean over the pairs of `data`: mean
// posture, mean tempo, no foot ever planted. Pairs of the contents in `without` are left out.
Result<std::shared_ptr<const Model>> mean_posture_model(const TrainingData& data,
                                                        const std::vector<StyleName>& styles,
                                                        const std::vector<std::string>& without);

}  // namespace panache
