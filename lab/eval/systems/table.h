#pragma once
// The systems that models are compared with; each has its own file or folder in eval/systems.

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "eval/system.h"
#include "learn/pairing.h"
#include "takes/manifest.h"

namespace panache {

// The training data of a system.
struct SystemData {
  const std::vector<Take>& takes;        // The training split, neutral and styled.
  const std::vector<Pairing>& pairings;  // Of these takes.
  const std::vector<StyleName>& styles;
  uint64_t seed = 1;
  std::span<const Take> unlabelled = {};  // Motion without styles, if available.
};

struct SystemEntry {
  const char* name;  // As in the report.
  Result<std::unique_ptr<System>> (*make)(const std::string& name, const SystemData& data);
};

// The systems in every report, in its order.
const std::vector<SystemEntry>& comparison_systems();

// published.cpp: the systems of other papers as we implemented them (docs/comparison-systems.md),
// in the order of the report. Building and evaluating them takes minutes, so this happens only on
// request.
const std::vector<SystemEntry>& published_systems();
// Those with these names, each once, in that order; "all" means all. Fails if a name is unknown.
Result<std::vector<SystemEntry>> find_published(const std::vector<std::string>& names);

}  // namespace panache
