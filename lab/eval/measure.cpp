#include "eval/measure.h"

#include <algorithm>
#include <cassert>
#include <numeric>

#include "eval/motion_metrics.h"
#include "eval/report_numbers.h"

namespace panache {

const std::vector<Measure>& measures() {
  static const std::vector<Measure> table = {
      {
          "style_accuracy",
          "style",
          3,
          Better::higher,
          "Share of windows of about one second that a classifier, trained on real motion, "
          "recognises as the asked style.",
          [](const TakeEvidence& of) { return of.style_windows; },
          mean_of_windows,
      },
      {
          "content_accuracy",
          "content",
          3,
          Better::higher,
          "Share of windows that a second classifier recognises as the input's content.",
          [](const TakeEvidence& of) { return of.content_windows; },
          mean_of_windows,
      },
      {
          "style_probability",
          "style probability",
          3,
          Better::higher,
          "Mean probability that the style classifier gives to the asked style.",
          [](const TakeEvidence& of) { return of.style_probability; },
          mean_of_windows,
      },
      {
          "jerk_ratio",
          "jerk / real",
          2,
          Better::nearest_one,
          "Mean magnitude of the third difference of the joints' positions, as a ratio "
          "to real takes of the same style and content; 1 is as smooth as real motion.",
          [](const TakeEvidence& of) { return mean_jerk(*of.take); },
          mean_against_real,
      },
      {
          "skating_ratio",
          "skating",
          3,
          Better::lower,
          "Share of frames in which a toe is below 5 cm in two neighbouring frames and "
          "slides faster than 0.5 m/s, at 20 frames a second.",
          [](const TakeEvidence& of) { return skating_ratio(*of.take); },
          mean_of_takes,
      },
      {
          "skating_cm_s",
          "slide cm/s",
          2,
          Better::lower,
          "Mean horizontal speed of ankles and toes, weighted from 1 at the floor to 0 at "
          "2.5 cm above it.",
          [](const TakeEvidence& of) { return 100 * weighted_skating(*of.take); },
          mean_of_takes,
      },
      {
          "pose_error_deg",
          "error deg",
          2,
          Better::lower,
          "Mean angle between the local rotations of the joints and those of the "
          "time-aligned real styled take.",
          nullptr,
          [](const CellEvidence& of) { return of.aligned ? of.aligned->degrees : kNotMeasured; },
      },
      {
          "pose_error_cm",
          "error cm",
          2,
          Better::lower,
          "Mean distance of the joints from those of the time-aligned real styled take, on "
          "the canonical body.",
          nullptr,
          [](const CellEvidence& of) { return of.aligned ? of.aligned->cm : kNotMeasured; },
      },
      {
          "fmd",
          "FMD",
          2,
          Better::lower,
          "Fr\xc3\xa9"
          "chet distance of the content classifier's features, output against real takes of the "
          "asked style and content; comparable only within this page.",
          nullptr,
          [](const CellEvidence& of) { return of.feature_distance; },
      },
      {
          "cadence_ratio",
          "cadence / real",
          2,
          Better::nearest_one,
          "Steps a second of walks and runs, as a ratio to real takes of the style.",
          [](const TakeEvidence& of) { return cadence(*of.take); },
          mean_against_real,
      },
      {
          "distance_cm",
          "moved cm",
          2,
          Better::neither,
          "Mean distance of the joints from the input's: how much was changed, not how "
          "well.",
          [](const TakeEvidence& of) {
            // Not defined if the source frames are unknown.
            if (!of.input || of.source_frames->empty()) return kNotMeasured;
            return 100 * mean_distance(*of.take, *of.input, *of.source_frames);
          },
          mean_of_takes,
      },
  };
  return table;
}

const Measure& find_measure(std::string_view key) {
  const auto found = std::find_if(measures().begin(), measures().end(),
                                  [&](const Measure& measure) { return measure.key == key; });
  assert(found != measures().end());
  return *found;
}

double mean_of_takes(const CellEvidence& cell) { return finite_mean(cell.values); }

double mean_against_real(const CellEvidence& cell) {
  return finite_mean(cell.values) / finite_mean(cell.real);
}

double mean_of_windows(const CellEvidence& cell) {
  return std::accumulate(cell.values.begin(), cell.values.end(), 0.0) /
         static_cast<double>(cell.windows);
}

}  // namespace panache
