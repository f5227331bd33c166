#pragma once
// A source of changes for a body, pose by pose: a model's networks (NetworkSource), or a system to
// compare them with. A Stepper carries out the change.

#include <span>

#include "pose/features.h"
#include "pose/history.h"
#include "style/stages/change_stages.h"
#include "style/stages/gesture_player.h"

namespace panache {

// One instant of the input, valid for one call.
struct SourceInput {
  // As PoseHistory::window() gives it, in the source's layout.
  std::span<const float> window;
  const HumanPositions* body = nullptr;  // Canonical joints in the body frame, metres.
  StepTime time;                         // `first`: this does not continue the motion before it.
  GesturePlayer::Ground ground = {};
  StageClock* clock = nullptr;  // May be null.

  // The root features of the window's newest pose.
  std::span<const float, kRootFeatures> root() const noexcept {
    return window.first(window.size() / kWindowPoses).last<kRootFeatures>();
  }
};

// A source for one character; it may have state.
class ChangeSource {
 public:
  virtual ~ChangeSource() = default;
  // The layout of its windows.
  virtual PoseLayout layout() const { return PoseLayout::positions; }
  // The change at the next instant. Its pointers are valid until the next call.
  virtual AskedChange ask(const SourceInput& input) = 0;
};

}  // namespace panache
