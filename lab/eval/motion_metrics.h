#pragma once
// Metrics of single motions, such as jerk, foot sliding and step frequency, and of pairs.

#include <vector>

#include "clip/clip.h"
#include "learn/take.h"

namespace panache {

// Mean over frames and joints of the third difference of world positions, m/s^3. 0 below 4 frames.
double mean_jerk(const Take& take);

// Share of frames with a sliding foot, 0 to 1, at 20 frames a second: the toe is below 5 cm in this
// frame and the last, and its horizontal speed and the mean of that over 5 frames exceed 0.5 m/s.
double skating_ratio(const Take& take);

// Mean over frames, ankles and toes of horizontal speed times clamp(2 - 2^(height / 2.5 cm), 0, 1),
// in m/s.
double weighted_skating(const Take& take);

// Steps a second of a body that travels: how often the feet pass each other. NaN where it does not
// travel (below 0.5 m/s) or takes fewer than two steps.
double cadence(const Take& take);

// Mean distance of the joints of two bodies in one space, centimetres.
double distance_cm(const HumanPositions& a, const HumanPositions& b);

// Mean distance of the joints between frame i of `take` and frame source_frames[i] of `from`, both
// in the body frame, metres.
double mean_distance(const Take& take, const Take& from, const std::vector<float>& source_frames);

// Sum of the joint distances, averaged over the common frames: frame by frame in the body frame, as
// in the measures CC and SC++; metres.
double summed_distance(const Take& a, const Take& b);

// Mean summed_distance() between each of `takes` and every take of `real` (given in two parts) that
// has the same style and content and comes from another file. NaN if there is no such take.
double distance_to_real(const std::vector<Take>& takes, const std::vector<Take>& real,
                        const std::vector<Take>& more_real);

// Largest difference of a bone's length between frame i of `clip` and frame source_frames[i] of
// `from`, in units of the file. The segment that leads to the joint `hips` (-1: none) is root
// motion, not a bone.
double bone_length_error(const Clip& clip, const Clip& from,
                         const std::vector<double>& source_frames, int hips = -1);

// Rank correlation; ties share a rank. NaN if one side is constant.
double rank_correlation(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace panache
