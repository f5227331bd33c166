#include "eval/measure.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "eval/measures/table.h"

namespace panache {
namespace {

double mean_of(const std::vector<double>& values) {
  double sum = 0;
  int count = 0;
  for (const double value : values) {
    if (std::isnan(value)) continue;
    sum += value;
    ++count;
  }
  return count > 0 ? sum / count : kNotMeasured;
}

}  // namespace

const std::vector<Measure>& measures() {
#define MEASURE(key) measure::key,
  static const std::vector<Measure> table = {
#include "eval/measures/table.inc"
  };
#undef MEASURE
  return table;
}

const Measure& find_measure(std::string_view key) {
  const auto found = std::find_if(measures().begin(), measures().end(),
                                  [&](const Measure& measure) { return measure.key == key; });
  assert(found != measures().end());
  return *found;
}

double mean_of_takes(const CellEvidence& cell) { return mean_of(cell.values); }

double mean_against_real(const CellEvidence& cell) {
  return mean_of(cell.values) / mean_of(cell.real);
}

double mean_of_windows(const CellEvidence& cell) {
  return std::accumulate(cell.values.begin(), cell.values.end(), 0.0) /
         static_cast<double>(cell.windows);
}

}  // namespace panache
