#pragma once
// Real styled test takes aligned with neutral ones in time, and the pose error of systems on them.

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "eval/system.h"
#include "learn/take.h"
#include "style/model/model.h"

namespace panache {

// A styled frame and the corresponding neutral instant.
struct AlignedInstant {
  int styled = 0, frame = 0;  // Take and its frame.
  int neutral = 0;            // Take,
  float at = 0;               // and its fractional frame.
};

// Replaces the neutral takes as a system's input, while the output is still applied to the takes
// themselves. takes[i] replaces take i, in the system's layout; its frame f / speed shows the same
// instant as the take's frame f.
struct SeenTakes {
  std::vector<Take> takes;
  float speed = 1;
};

// Mean errors per style and content.
using PoseErrors = std::map<std::pair<std::string, std::string>, PoseError>;

// The test takes of one evaluation, aligned once for any number of systems, as in training:
// pair_takes() aligns windows of 1.5 s of each styled take, 0.5 s apart, with the neutral takes of
// the same set and content by dynamic time warping; kTrimFrames frames at both ends of a window are
// left out. Frames in several windows count once for each.
class AlignedTakes {
 public:
  // Neutral and styled takes that no model was trained on, with features in layout positions. Skips
  // styled takes whose content has no neutral take.
  explicit AlignedTakes(std::vector<Take> takes);

  // Errors of a system's changes at one strength of each take's own style; skips unknown styles.
  // Empty if the system has none for single instants.
  PoseErrors errors(const System& system, double strength = 1) const;
  // The same, but with the input windows taken from `seen`.
  PoseErrors errors(const System& system, double strength, const SeenTakes& seen) const;
  // Errors of the neutral takes themselves, without a style.
  PoseErrors untouched_errors() const;

  // All given takes, with features of this layout.
  const std::vector<Take>& takes(PoseLayout layout = PoseLayout::positions) const {
    return layout == PoseLayout::positions ? positions_ : rotations_;
  }
  const std::vector<AlignedInstant>& instants() const { return instants_; }

 private:
  // The change of a system for an instant; empty if it does not know the style.
  using Answer = std::function<std::optional<StyleDelta>(const AlignedInstant&)>;
  // Evaluates on all cores. Each thread processes parts of the instants with its own instance, so
  // that instances may keep buffers.
  PoseErrors mean_errors(const std::function<Answer()>& make_answer) const;
  PoseErrors system_errors(const System& system, double strength, const std::vector<Take>& seen,
                           float speed) const;

  std::vector<Take> positions_, rotations_;
  std::vector<AlignedInstant> instants_;
};

}  // namespace panache
