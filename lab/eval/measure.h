#pragma once
// A measure: one number for the quality of motion, an entry of the table in measure.cpp.

#include <optional>
#include <string_view>
#include <vector>

#include "eval/metrics.h"
#include "learn/take.h"

namespace panache {

// Which values are better.
enum class Better { higher, lower, nearest_one, neither };

// The data of one take: a system's output, or a real take.
struct TakeEvidence {
  const Take* take = nullptr;
  const Take* input = nullptr;                        // Null for real takes.
  const std::vector<float>* source_frames = nullptr;  // See StyledTake; null for real takes.
  size_t windows = 0;                                 // Seen by the classifiers.
  double style_windows = 0, content_windows = 0;      // Recognised as the row's style or content.
  double style_probability = 0;                       // Of the row's style, summed over windows.
};

// The data of all takes of one style and content.
struct CellEvidence {
  size_t windows = 0;          // Of all takes together.
  std::vector<double> values;  // The measure's of_take() per take,
  std::vector<double> real;    // and per real take of the same style and content.
  // Frechet distance of the content classifier's features from those of the real takes.
  double feature_distance = kNotMeasured;
  std::optional<PoseError> aligned;  // Mean over the time-aligned instants.
};

struct Measure {
  const char* key;    // Key in report.json.
  const char* label;  // For display,
  int digits;         // with so many decimals.
  Better better;
  const char* meaning;                     // One or two sentences.
  double (*of_take)(const TakeEvidence&);  // Null if it is not defined for single takes.
  double (*of_cell)(const CellEvidence&);
};

// All measures, in the order of the report.
const std::vector<Measure>& measures();
// The measure with this key, which must exist.
const Measure& find_measure(std::string_view key);

// Common ways to combine values of takes. NaN is ignored.
double mean_of_takes(const CellEvidence& cell);
double mean_against_real(const CellEvidence& cell);  // The mean, divided by that of real takes.
double mean_of_windows(const CellEvidence& cell);    // Values are sums over windows.

}  // namespace panache
