#pragma once
// What stylize did to a motion, in text and as JSON.

#include <span>
#include <string>

#include "messages.h"
#include "style/restyle.h"

namespace panache::cli {

// "loop closed; feet held; 96% known motion".
std::string describe(const RestyleFacts& facts);
Json to_json(const RestyleFacts& facts);

// How far a clip's style was reduced to the mean posture; see Stylizer::gate().
struct GateReport {
  double mean = 0, min = 1;
  double eased = 0;  // The share of frames that got mostly the mean posture.
};

// gates: [frames], at least one.
GateReport report_gate(std::span<const float> gates);
std::string describe(const GateReport& gate);
// A warning if most of a clip was reduced.
std::string describe_eased(const GateReport& gate);
Json to_json(const GateReport& gate);

}  // namespace panache::cli
