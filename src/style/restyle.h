#pragma once
// A whole clip restyled, with the tempo of the style: the play head runs through the input as fast
// or as slowly as the style asks. A loop becomes a loop.

#include <functional>
#include <string>
#include <vector>

#include "base/result.h"
#include "clip/clip.h"
#include "style/stylizer.h"

namespace panache {

// The strength of one style along the input: straight lines between points, held before the first
// and after the last.
struct StrengthTrack {
  struct Point {
    double seconds;  // Of the input.
    float strength;
  };
  int style = 0;
  std::vector<Point> points;  // In order of time, at least one.

  float at(double seconds) const;
};

// Whether a clip is restyled as a loop, so that its last pose is its first, travel aside.
enum class LoopMode {
  off,
  // Where it is one, see is_loop(), no strength differs between its ends, and there are no gestures
  // at random.
  detect,
  force,  // Or restyle() fails and says why that cannot be.
};

struct RestyleOptions {
  StylizerOptions stylizer;
  bool timing = true;  // Change the tempo too; off, the result has the input's frames.
  LoopMode loop = LoopMode::detect;
};

// How a clip was made a loop.
struct LoopFacts {
  bool closed = false;   // The last pose is the first, travel aside; otherwise all else is 0.
  int rounds = 0;        // How often it was played, the round before the result included,
  bool settled = false;  // until one repeated the one before it; false: until the rounds ran out.
  float input_gap = 0;   // See LoopSeam::gap: of the input, metres,
  float spread = 0;      // and what was left of it in the result, to be spread over the cycle.
};

struct Restyled {
  Clip clip;                           // At the input's rate.
  std::vector<double> source_frames;   // Per frame of it, the input's frame (fractional).
  std::vector<FootContacts> contacts;  // Per frame of it.
  std::vector<float> gates;            // Per frame of it, see Stylizer::gate().
  std::vector<StageFacts> stages;      // Per frame of it.
  LoopFacts loop;

  // Of the frames of `clip` before `first` as they are: a calibration pose is no motion.
  static Restyled begin(const Clip& clip, int first);
  void append(ConstPose pose, double source_frame, FootContacts planted, float gate,
              StageFacts facts);
};

// Whether `result` is the clip, bit for bit.
bool is_unchanged(const Clip& clip, const Restyled& result);

// `progress` is called with 0 to 1 now and then; may be empty. With all strengths at 0, model and
// recipe permitting, the result is the input. Fails where `rig` or the options do not suit.
Result<Restyled> restyle(const Clip& clip, const Rig& rig,
                         const std::shared_ptr<const Model>& model,
                         const std::vector<StrengthTrack>& tracks,
                         const RestyleOptions& options = {},
                         const std::function<void(double)>& progress = {});

}  // namespace panache
