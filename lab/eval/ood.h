#pragma once
// Out-of-distribution motion: is its content preserved, and is the style recognised?

#include <functional>
#include <string>
#include <vector>

#include "base/result.h"
#include "eval/metrics.h"
#include "eval/shot.h"
#include "takes/signature.h"
#include "eval/system.h"
#include "learn/take.h"

namespace panache {

// Style recognition of an output; NaN and empty if the style is unknown.
struct OodVerdict {
  // Share of windows recognised as the requested style, by an ensemble of networks trained on
  // disturbed takes, and by linear discriminant analysis.
  double style_robust = kNotMeasured, style_lda = kNotMeasured;
  // Mean score of each style over the windows, in the order of the classifier's styles: used to
  // choose among the outputs of one clip in all styles.
  std::vector<double> robust_scores, lda_scores;
  int style = -1;  // Index of the requested style in the scores.
  SignatureMatch signature;
};

// Style classifiers trained on real takes. Thread-safe.
class OodJudge {
 public:
  virtual ~OodJudge() = default;
  // `output`: in the style's own tempo; `log_rate`: mean logarithm of its rate.
  virtual OodVerdict judge(const Take& input, const Take& output, double log_rate,
                           const std::string& style) const = 0;
};

// Legs of frames whose input is within the limits: how many there are, and how many of them have a
// thigh, or a knee, more than 5 degrees beyond, see leg_beyond().
struct LegRange {
  int legs = 0, thighs = 0, knees = 0;
  float worst_deg = 0;  // The largest excess.
};

// One clip in one style, frame by frame in the input's own time. Speeds, heights and
// joints are those of the canonical body as read from the character's own skeleton.
struct OodRow {
  std::string clip;   // File name without folder and extension.
  std::string style;  // Name in the model.
  // Mean jerk of the joints in world space, relative to the input's; NaN if the input has none.
  double jerk_ratio = 0;
  // Velocity correlation of hands and feet with the input, body frame: mean over the coordinates
  // that move by more than 1 cm/s in the input. NaN if there are none.
  double velocity_correlation = 0;
  double distance_cm = 0;  // Mean joint distance from the input, body frame.
  // Share of frames with a joint 5 degrees beyond human limits (see beyond_limits()) that is within
  // them in the input.
  double beyond_limits = 0;
  LegRange upright, crouching;  // By the input's hips, over or under 70 cm.
  double under_floor = 0;       // Share of frames with a toe 3 cm below floor and lowest input toe.
  // Frames where a joint jumps by more than 6 cm, and twice as far as in the input then.
  int jumps = 0;
  double skating_ratio = 0, input_skating_ratio = 0;
  double turned_deg = 0;  // Mean angle between the headings of the two bodies.
  double drift_m = 0;     // Horizontal distance of the hips from the input's at the end.
  double gate = 1;        // Mean of the stylizer's gate.
  ShotValues shot;
  OodVerdict verdict;  // Of the same clip and style in the style's own tempo.
};

// Compares `output` with `input` frame by frame; both have the same frames, and features in layout
// positions. The caller sets clip, style and gate.
OodRow compare_ood(const Take& input, const Take& output);

// Runs every clip of `files` (any motion file) in every style of the system, at `strength` and the
// input's tempo, and compares the output with the input, both read at 30 frames a second from the
// first frame of motion. If there are style classifiers, also runs the style's own tempo and
// classifies that. Rows are ordered by files, then styles; unsupported requests are skipped. Fails
// if a file cannot be read or mapped. `progress` gets 0 to 1, from any thread.
Result<std::vector<OodRow>> measure_ood(const std::vector<std::string>& files, const System& system,
                                        const OodJudge* judge = nullptr,
                                        const std::function<void(double)>& progress = {},
                                        float strength = 1);

// The motion files of a file, a folder (recursively) or a manifest (.csv: contents that occur only
// as neutral; only those marked test if some are), sorted by name. Fails if no file is found.
Result<std::vector<std::string>> list_ood(const std::string& path);

}  // namespace panache
