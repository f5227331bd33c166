#pragma once
// A base: a model without styles, trained on motion that nobody captured in any. Styles are learnt
// on its trunk (learn_style()) as on any other, and nothing in it comes from styled motion.

#include <vector>

#include "base/result.h"
#include "learn/manifest.h"
#include "train/trainer.h"

namespace panache {

// Trains the trunk of the pose network to tell, from a disturbed window, what the body does now,
// did before and will do next; and the contact network. Uses the training split of `rows`, whatever
// their styles; of the options the recipe (whose settings have base steps), those steps, its
// optimiser, the steps of the predictor, the seed, and what the data is. It takes about a minute
// and keeps no checkpoint.
Result<Trained> train_base(const std::vector<ManifestRow>& rows, const TrainOptions& options);
// The same on takes that have been read, all of them.
Result<Trained> train_base(std::vector<Take> takes, const TrainOptions& options);

}  // namespace panache
