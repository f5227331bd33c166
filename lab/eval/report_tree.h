#pragma once
// The report as JSON in memory: what report.json and the tables for a terminal are written from.

#include <nlohmann/json.hpp>

#include "eval/report.h"

namespace panache {

nlohmann::ordered_json report_tree(const Report& report);

}  // namespace panache
