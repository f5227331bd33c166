#pragma once
// Restyles a whole clip at the style's tempo: the play head runs through the input as fast or as
// slowly as the style requests. Loops stay loops. And facts about the result.

#include <functional>
#include <string>
#include <vector>

#include "base/result.h"
#include "clip/clip.h"
#include "style/stylizer.h"

namespace panache {

// The strength of one style over input time: linear between points, constant before the first and
// after the last.
struct StrengthTrack {
  struct Point {
    double seconds;  // Of the input.
    float strength;
  };
  int style = 0;
  std::vector<Point> points;  // Sorted by time, at least one.

  float at(double seconds) const;
};

// Whether a clip is restyled as a loop, so that its last pose equals its first, except for travel.
// A loop has no gestures at random.
enum class LoopMode {
  off,
  // If it is a loop (is_loop()) and strengths are equal at both ends.
  detect,
  force,  // Otherwise restyle() fails and says why.
};

struct RestyleOptions {
  StylizerOptions stylizer;
  bool timing = true;  // Change the tempo too; otherwise keep the input's frames.
  LoopMode loop = LoopMode::detect;
};

// How a clip was closed into a loop.
struct LoopFacts {
  bool closed = false;   // The last pose is the first, except travel; if not, all else is 0.
  int rounds = 0;        // Rounds played, including the one before the result,
  bool settled = false;  // until one repeated the one before; false: up to the limit.
  float input_gap = 0;   // See LoopSeam::gap: in the input, metres,
  float spread = 0;      // and the rest in the result, spread over the cycle.
};

struct Restyled {
  Clip clip;                           // At the input's rate.
  std::vector<double> source_frames;   // Per output frame, the input's frame (fractional).
  std::vector<FootContacts> contacts;  // Per frame of it.
  std::vector<float> gates;            // Per frame of it, see Stylizer::gate().
  std::vector<StageFacts> stages;      // Per frame of it.
  LoopFacts loop;

  // Starts with the frames of `clip` before `first`, unchanged, such as a calibration pose.
  static Restyled begin(const Clip& clip, int first);
  void append(ConstPose pose, double source_frame, FootContacts planted, float gate,
              StageFacts facts);
};

// Whether `result` is the clip, bit for bit.
bool is_unchanged(const Clip& clip, const Restyled& result);

// `progress` is called with 0 to 1 occasionally; may be empty. With all strengths at 0, the result
// is the input if the model's recipe allows. Fails if `rig` or the options do not fit.
Result<Restyled> restyle(const Clip& clip, const Rig& rig,
                         const std::shared_ptr<const Model>& model,
                         const std::vector<StrengthTrack>& tracks,
                         const RestyleOptions& options = {},
                         const std::function<void(double)>& progress = {});

struct RestyleFacts {
  bool unchanged = false;  // The result is the clip, bit for bit.
  LoopFacts loop;
  // Shares, 0 to 1: the mean of Stylizer::gate(), frames in which something besides the feet held
  // the body, and frames in which hands kept what they touch.
  float known = 1, seated = 0, touching = 0;
  // The share of frames with a planted foot that stands in the input, 0 to 1, and the mean sliding
  // speed of such feet's toes in the result and in the input, m/s.
  float planted = 0, slide = 0, input_slide = 0;
};

// `clip`: the input of `result`, with the joints of `rig`.
RestyleFacts restyle_facts(const Clip& clip, const Rig& rig, const Restyled& result);

}  // namespace panache
