#pragma once
// The report as a JSON tree, the source of report.json and the text tables.

#include <nlohmann/json.hpp>

#include "eval/report.h"

namespace panache {

nlohmann::ordered_json report_tree(const Report& report);

}  // namespace panache
