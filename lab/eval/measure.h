#pragma once
// A measure: one number that says how good motion is. Each is an entry of the table in measure.cpp.

#include <optional>
#include <string_view>
#include <vector>

#include "eval/metrics.h"
#include "learn/pose_error.h"
#include "learn/take.h"

namespace panache {

// Which of two values is the better one.
enum class Better { higher, lower, nearest_one, neither };

// What is known of one take: of a system's output, or of a real take.
struct TakeEvidence {
  const Take* take = nullptr;
  const Take* input = nullptr;                        // What it was made from; null for real takes.
  const std::vector<float>* source_frames = nullptr;  // See Output; null for real takes.
  size_t windows = 0;                                 // That the classifiers saw.
  double style_windows = 0, content_windows = 0;      // Recognised as what the take's row says.
  double style_probability = 0;                       // Of the row's style, summed over windows.
};

// What is known of all takes of one style and content.
struct CellEvidence {
  size_t windows = 0;          // Of all takes together.
  std::vector<double> values;  // Per take, what the measure's of_take() gave,
  std::vector<double> real;    // and what it gives per real take of the same style and content.
  // Frechet distance of the content classifier's features from those of the real takes.
  double feature_distance = kNotMeasured;
  std::optional<PoseError> aligned;  // Mean over the time-aligned instants.
};

struct Measure {
  const char* key;    // In report.json.
  const char* label;  // For people,
  int digits;         // with so many decimals.
  Better better;
  const char* meaning;                     // One or two messages.
  double (*of_take)(const TakeEvidence&);  // Null where it is no number of single takes.
  double (*of_cell)(const CellEvidence&);
};

// All of them, in the order of the report.
const std::vector<Measure>& measures();
// The measure of that key, which exists.
const Measure& find_measure(std::string_view key);

// What most measures make of their takes. NaN counts nowhere.
double mean_of_takes(const CellEvidence& cell);
double mean_against_real(const CellEvidence& cell);  // That mean, divided by that of real takes.
double mean_of_windows(const CellEvidence& cell);    // Values are sums over windows.

}  // namespace panache
