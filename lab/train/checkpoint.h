#pragma once
// Checkpoints: interrupted training resumes where it stopped.

#include <string>
#include <vector>

#include "base/result.h"
#include "train/fingerprint.h"
#include "train/network.h"
#include "train/trainer.h"

namespace panache {

// Saves a network next to `path` (".pose.checkpoint" and so on), atomically.
Result<void> save_checkpoint(const std::string& path, const Fingerprint& training,
                             const NetworkTrainer& network, const std::vector<LossPoint>& losses);

// Restores a network and its losses if there is a checkpoint; fails if it is damaged, or belongs to
// other data, styles or settings.
Result<void> load_checkpoint(const std::string& path, const Fingerprint& training,
                             NetworkTrainer& network, std::vector<LossPoint>& losses);

// The existing checkpoints of `path`.
std::vector<std::string> find_checkpoints(const std::string& path);

void remove_checkpoints(const std::string& path);

}  // namespace panache
