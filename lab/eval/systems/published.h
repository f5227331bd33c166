#pragma once
// The systems of other papers, as we read them (docs/comparison-systems.md). They take minutes to
// build and to judge, so they are judged only where they are asked for.

#include <string>
#include <vector>

#include "base/result.h"
#include "eval/systems/table.h"

namespace panache {

// In the order of the report.
const std::vector<SystemEntry>& published_systems();
// Those of these names, each once and in that order; "all" stands for all. Fails where there is
// none of a name.
Result<std::vector<SystemEntry>> find_published(const std::vector<std::string>& names);

}  // namespace panache
