#pragma once
// The numbers of one line of the report, for a system or for real motion.

#include <array>
#include <cstddef>
#include <limits>
#include <map>
#include <string>

namespace panache {

inline constexpr double kNotMeasured = std::numeric_limits<double>::quiet_NaN();

// Means over takes of each style and content, then over styles and contents; NaN where a number was
// not measured. docs/evaluation.md defines each.
struct Quality {
  size_t takes = 0, windows = 0;
  double style_accuracy = kNotMeasured;     // Share of windows recognised as the asked style.
  double content_accuracy = kNotMeasured;   // Share of windows recognised as the input's content.
  double style_probability = kNotMeasured;  // Mean probability of the asked style, 0 to 1.
  double jerk_ratio = kNotMeasured;         // Against real takes of the style and content.
  double skating_ratio = kNotMeasured;      // Share of frames with a sliding foot, 0 to 1.
  double skating_cm_s = kNotMeasured;       // Height-weighted slide of ankles and toes, cm/s.
  double pose_error_deg = kNotMeasured;     // Against the time-aligned real styled take.
  double pose_error_cm = kNotMeasured;
  double fmd = kNotMeasured;            // Frechet distance of content features; with itself only.
  double cadence_ratio = kNotMeasured;  // Steps a second against real takes, walks and runs.
  double distance_cm = kNotMeasured;    // Mean distance of the joints from the input's.
};

// How each number is called and printed.
struct QualityField {
  const char* key;    // In report.json.
  const char* label;  // For people.
  double Quality::*value;
  int digits;
};
inline constexpr std::array kQualityFields = {
    QualityField{"style_accuracy", "style", &Quality::style_accuracy, 3},
    QualityField{"content_accuracy", "content", &Quality::content_accuracy, 3},
    QualityField{"style_probability", "style probability", &Quality::style_probability, 3},
    QualityField{"jerk_ratio", "jerk / real", &Quality::jerk_ratio, 2},
    QualityField{"skating_ratio", "skating", &Quality::skating_ratio, 3},
    QualityField{"skating_cm_s", "slide cm/s", &Quality::skating_cm_s, 2},
    QualityField{"pose_error_deg", "error deg", &Quality::pose_error_deg, 2},
    QualityField{"pose_error_cm", "error cm", &Quality::pose_error_cm, 2},
    QualityField{"fmd", "FMD", &Quality::fmd, 2},
    QualityField{"cadence_ratio", "cadence / real", &Quality::cadence_ratio, 2},
    QualityField{"distance_cm", "moved cm", &Quality::distance_cm, 2},
};

using QualityTable = std::map<std::string, Quality>;  // By content, style or strength.

}  // namespace panache
