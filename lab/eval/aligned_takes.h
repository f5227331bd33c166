#pragma once
// Real styled test takes laid over neutral ones in time, and how near a system comes to them.

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "eval/system.h"
#include "learn/pose_error.h"
#include "learn/take.h"
#include "style/model.h"

namespace panache {

// A styled frame and the neutral instant that corresponds to it.
struct AlignedInstant {
  int styled = 0, frame = 0;  // Take, and frame of it.
  int neutral = 0;            // Take,
  float at = 0;               // and fractional frame of it.
};

// What a system is shown in place of the neutral takes, while its answer is still put on the takes
// themselves. takes[i] stands for take i, in the system's layout, and shows the instant of its
// frame f at frame f / speed.
struct SeenTakes {
  std::vector<Take> takes;
  float speed = 1;
};

// Mean errors per style and content.
using PoseErrors = std::map<std::pair<std::string, std::string>, PoseError>;

// The test takes of one evaluation, aligned once for any number of systems. Alignment is that of
// training: pair_takes() lays windows of 1.5 s of each styled take, 0.5 s apart, over the neutral
// takes of the same set and content by dynamic time warping; kTrimFrames frames at both ends of a
// window are left out. Frames that lie in several windows count once for each.
class AlignedTakes {
 public:
  // Neutral and styled takes that no model was trained on, with their numbers in layout positions.
  // Styled takes whose content no neutral take has are left out.
  explicit AlignedTakes(std::vector<Take> takes);

  // Of a system's answers at one strength of each take's own style; styles that it does not know
  // are left out. Empty where it has no answers for single instants.
  PoseErrors errors(const System& system, double strength = 1) const;
  // The same where the windows are cut from `seen`, and nothing else is.
  PoseErrors errors(const System& system, double strength, const SeenTakes& seen) const;
  // Of the neutral takes themselves: no transfer.
  PoseErrors untouched_errors() const;

  // All takes as they were given, with the numbers of this layout.
  const std::vector<Take>& takes(PoseLayout layout = PoseLayout::positions) const {
    return layout == PoseLayout::positions ? positions_ : rotations_;
  }
  const std::vector<AlignedInstant>& instants() const { return instants_; }

 private:
  // The change that a system makes of an instant; nothing where it does not know the style.
  using Answer = std::function<std::optional<StyleDelta>(const AlignedInstant&)>;
  // Asks over all cores. Instants are shared out in parts, and each part has an answer of its own,
  // so that answers may keep buffers.
  PoseErrors mean_errors(const std::function<Answer()>& make_answer) const;
  PoseErrors system_errors(const System& system, double strength, const std::vector<Take>& seen,
                           float speed) const;

  std::vector<Take> positions_, rotations_;
  std::vector<AlignedInstant> instants_;
};

}  // namespace panache
