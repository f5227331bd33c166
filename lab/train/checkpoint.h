#pragma once
// Interrupted training goes on where it was.

#include <string>
#include <vector>

#include "base/result.h"
#include "train/fingerprint.h"
#include "train/network.h"
#include "train/trainer.h"

namespace panache {

// Saves a network beside `path` (".pose.checkpoint" and so on), whole or not at all.
Result<void> save_checkpoint(const std::string& path, const Fingerprint& training,
                             const NetworkTrainer& network, const std::vector<LossPoint>& losses);

// Restores a network and its losses where a checkpoint is there; fails where it is damaged, or of
// other data, styles or settings.
Result<void> load_checkpoint(const std::string& path, const Fingerprint& training,
                             NetworkTrainer& network, std::vector<LossPoint>& losses);

// The checkpoints that are beside `path`.
std::vector<std::string> find_checkpoints(const std::string& path);

void remove_checkpoints(const std::string& path);

}  // namespace panache
