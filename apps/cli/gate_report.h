#pragma once
// How much of the styles' answers to this very motion a clip got, see Stylizer::gate().

#include <span>
#include <string>

#include "messages.h"

namespace panache::cli {

struct GateReport {
  double mean = 0, least = 1;
  double eased = 0;  // The share of frames that got more of the mean posture than of that.
};

// gates: [frames], at least one.
GateReport report_gate(std::span<const float> gates);
std::string describe(const GateReport& gate);
// A warning if most of a clip was eased.
std::string describe_eased(const GateReport& gate);
Json to_json(const GateReport& gate);

}  // namespace panache::cli
