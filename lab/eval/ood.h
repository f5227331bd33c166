#pragma once
// Motion that no system was trained on: does it stay the motion it was?

#include <functional>
#include <string>
#include <vector>

#include "base/result.h"
#include "eval/metrics.h"
#include "eval/shot.h"
#include "learn/signature.h"
#include "eval/system.h"
#include "learn/take.h"

namespace panache {

// What judges of the styles say of an output; NaN and empty where they do not know the style.
struct OodVerdict {
  // Share of the windows recognised as the style asked for: by an ensemble of networks that learnt
  // from disturbed takes, and by linear discriminant analysis.
  double style_robust = kNotMeasured, style_lda = kNotMeasured;
  // What speaks for each style, mean over the windows, in the order of the judge's styles: choices
  // among the outputs of one clip in all styles are made from it.
  std::vector<double> robust_scores, lda_scores;
  int style = -1;  // The place of the style asked for in the scores.
  SignatureMatch signature;
};

// Knows the styles from real takes. May be asked by several threads at once.
class OodJudge {
 public:
  virtual ~OodJudge() = default;
  // `output`: with the style's own tempo, `log_rate` of which is the mean logarithm.
  virtual OodVerdict judge(const Take& input, const Take& output, double log_rate,
                           const std::string& style) const = 0;
};

// One clip in one style at strength 1, frame by frame in the input's own time. Speeds, heights and
// joints are those of the canonical body as read from the character's own skeleton.
struct OodRow {
  std::string clip;   // The file's name without folder and extension.
  std::string style;  // As the model calls it.
  // Mean jerk of the joints, world, against the input's; NaN where the input has none.
  double jerk_ratio = 0;
  // Of hands and feet with the input's, body frame: mean over the coordinates that move in the
  // input by more than 1 cm/s. NaN where none does.
  double velocity_correlation = 0;
  double distance_cm = 0;  // Mean distance of the joints from the input's, body frame.
  // Share of frames with a joint 5 degrees beyond human limits (see beyond_limits()) that the input
  // keeps at that frame.
  double beyond_limits = 0;
  double under_floor = 0;  // Share of frames with a toe 3 cm lower than floor and lowest input toe.
  // Frames in which a joint jumps by more than 6 cm, and twice as far as in the input at that time.
  int jumps = 0;
  double skating_ratio = 0, input_skating_ratio = 0;
  double turned_deg = 0;  // Mean angle between where the two bodies face.
  double drift_m = 0;     // How far the hips end from where the input's do, along the ground.
  double gate = 1;        // Mean of the stylizer's gate.
  ShotValues shot;
  OodVerdict verdict;  // Of the same clip and style with the style's own tempo.
};

// What became of `input` in `output`, frame by frame; both have the same frames and numbers in
// layout positions. Clip, style and gate are the caller's.
OodRow compare_ood(const Take& input, const Take& output);

// Asks for every clip of `files` (any motion file) in every style that the system has, at strength
// 1 and the input's tempo, and compares what comes out with the input, both read at 30 frames a
// second from the first frame that is motion. With a judge, asks for the style's own tempo as well,
// and has that judged. Rows are in order of files, then styles; what the
// system cannot be asked for is left out. Files that cannot be read or mapped fail it with their
// message. `progress` gets the share done, from any thread.
Result<std::vector<OodRow>> measure_ood(const std::vector<std::string>& files, const System& system,
                                        const OodJudge* judge = nullptr,
                                        const std::function<void(double)>& progress = {});

// The motion files of a file, a folder (with its subfolders) or a manifest (.csv; those of contents
// that it holds in no style but neutral; of these, where some are marked test, only they), in order
// of the alphabet. Fails where there is none.
Result<std::vector<std::string>> list_ood(const std::string& path);

}  // namespace panache
