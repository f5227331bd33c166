#pragma once
// What is reported of the persons of a model.

#include <cstddef>

#include "eval/metrics.h"

namespace panache {

// How far people are apart: distances between the mean poses of pairs of them, the mean over the
// joints, cm.
struct PersonSpread {
  double median_cm = kNotMeasured, p90_cm = kNotMeasured;
};

struct RealPeople {
  size_t people = 0;
  PersonSpread spread;
  double own_cm = kNotMeasured;  // The same between two takes of one person, median.
  // A classifier trained on all but the last walk of each person tells the person on that.
  size_t told_of = 0;
  double told = kNotMeasured;
  double kept = kNotMeasured;  // Share of the variance of mean poses that six numbers carry.
};

struct SeedPersons {
  size_t seeds = 0, walks = 0;
  PersonSpread spread;  // On one walk.
  // A classifier trained on the seeds' other walks tells the seed on each.
  double told = kNotMeasured;
  // Share outside the ellipsoid that has 95 % of real people, by the six numbers that carry most of
  // what differs between their mean poses.
  double outside = kNotMeasured;
};

// Motion against its input, frame by frame, over many clips.
struct ChangeSummary {
  size_t clips = 0;
  double jerk_median = kNotMeasured, jerk_p90 = kNotMeasured;  // Relative to the input's.
  double beyond_limits = kNotMeasured;                         // Share of frames.
  double jumps = kNotMeasured;                                 // Frames of a clip.
  double more_sliding = kNotMeasured;                          // Share of frames.
  double cm = kNotMeasured;                                    // From the input.
};

// Styled neutral takes before the classifiers of their performers, with a person each and without.
struct StyledPersons {
  size_t clips = 0;
  double told = kNotMeasured, told_without = kNotMeasured;
};

struct PersonsReport {
  RealPeople real;
  SeedPersons seeds;
  StyledPersons styled;
  ChangeSummary others;  // Seeds on other motion.
};

}  // namespace panache
