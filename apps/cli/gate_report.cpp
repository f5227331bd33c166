#include "gate_report.h"

#include <algorithm>

namespace panache::cli {

GateReport report_gate(std::span<const float> gates) {
  GateReport report;
  for (const float open : gates) {
    const double gate = static_cast<double>(open);
    report.mean += gate;
    report.least = std::min(report.least, gate);
    report.eased += gate < 0.5;
  }
  report.mean /= static_cast<double>(gates.size());
  report.eased /= static_cast<double>(gates.size());
  return report;
}

std::string describe(const GateReport& gate) {
  return "gate " + fixed(gate.mean, 2) + " (least " + fixed(gate.least, 2) + "; " +
         fixed(100 * gate.eased, 0) + " % of frames eased to the mean posture)";
}

std::string describe_eased(const GateReport& gate) {
  return fixed(100 * gate.eased, 0) +
         " % of its frames are unlike the motion that the styles were trained on; those were eased "
         "towards the mean posture of the style";
}

Json to_json(const GateReport& gate) {
  return {
      {"mean", rounded(gate.mean)}, {"least", rounded(gate.least)}, {"eased", rounded(gate.eased)}};
}

}  // namespace panache::cli
