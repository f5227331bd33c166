#pragma once
// The systems of other papers as we implemented them (docs/comparison-systems.md). Building and
// evaluating them takes minutes, so this happens only on request.

#include <string>
#include <vector>

#include "base/result.h"
#include "eval/systems/table.h"

namespace panache {

// All of them, in the order of the report.
const std::vector<SystemEntry>& published_systems();
// Those with these names, each once, in that order; "all" means all. Fails if a name is unknown.
Result<std::vector<SystemEntry>> find_published(const std::vector<std::string>& names);

}  // namespace panache
