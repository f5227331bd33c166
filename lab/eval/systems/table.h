#pragma once
// The systems that models are compared with, each a file or folder of eval/systems.

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "eval/system.h"
#include "learn/pairing.h"

namespace panache {

// What a system may learn from.
struct SystemData {
  const std::vector<Take>& takes;        // Of the training split, neutral and styled.
  const std::vector<Pairing>& pairings;  // Of them.
  const std::vector<StyleName>& styles;
  uint64_t seed = 1;
  std::span<const Take> unlabelled = {};  // Motion without styles, where there is some.
};

struct SystemEntry {
  const char* name;  // In the report.
  Result<std::unique_ptr<System>> (*make)(const std::string& name, const SystemData& data);
};

// Those that stand in every report, in its order.
const std::vector<SystemEntry>& comparison_systems();

}  // namespace panache
