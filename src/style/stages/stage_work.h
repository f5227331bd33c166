#pragma once
// The data that the stages of one step read and write.

#include <algorithm>
#include <array>
#include <cmath>

#include "pose/changed_joints.h"
#include "pose/contacts.h"
#include "pose/hand_contacts.h"
#include "pose/observer.h"
#include "pose/style_delta.h"
#include "style/model/gesture.h"
#include "style/model/stance.h"
#include "style/stages/root_motion.h"
#include "style/stages/shape.h"
#include "style/stages/steady_arms.h"
#include "style/stages/step_time.h"
#include "style/stages/window.h"

namespace panache {

// The requested change at one step.
struct AskedChange {
  StyleDelta delta;
  float log_rate = 0;                    // Logarithm of input seconds per output second.
  std::array<float, kFeet> contacts{};   // Probability that each foot is planted.
  float gate = 1;                        // How well the motion is known, 0 to 1.
  Stance stance = {};                    // For a standing foot.
  const GesturePose* gesture = nullptr;  // In addition; null for none.
  const Shape* shape = &kPlainShape;     // The amounts of its parts.
  float amount = 1;                      // How active any style is, see EasedStrengths::amount().
};

// How changes are carried out, see StylizerOptions.
struct StageOptions {
  bool root = true, foot_lock = true;
  bool tempo_everywhere = false;  // Otherwise only while the feet step.
};

// One step. The first part is input; the rest is computed by one stage of the row for later ones.
// Shares are 0 to 1.
struct StageWork {
  const AskedChange& asked;
  const StageOptions& options;
  float flight;  // Share, see FlightWatch::amount().
  const Observer& observer;
  const InputWindow& window;
  const StepTime& time;
  BodyChange& change;  // From the shape stage on, the change of the input.

  const Observation& now = observer.now();
  HeadingBody body = now.world;       // The input, heading frame, metres.
  float stepping = 0;                 // Share, see StepWatch::amount().
  float seated = 0;                   // Share, see SeatWatch::amount().
  float above_floor = 1;              // Share, see share_above_floor().
  float log_rate = 0;                 // See AskedChange; 0 in a flight or without steps.
  const StyleDelta* delta = nullptr;  // Filtered; set by the filter.
  RootOffset root = {};               // The style's change of the way; from the shape
                                      // stage on, without what that holds back.
  Shape shape = {};                   // As requested, reduced where it does not suit the body.
  float raised = 0;                   // How far the floor raises the hips, not eased; metres.
  float lift = 0;                     // How far a gesture lifts both feet, metres.
  HumanPositions joints = {};  // changed_joints() of body and change, from the balance stage on.
  std::array<float, kFeet> resting{};  // How much feet keep their height, shares.
  ArmRotations free_arms = {};         // Before contacts and the body correct them.
  HandHolds holds = {};                // Contacts that the hands keep.

  // How active any style, or energy, is for each arm. Otherwise an arm keeps its input.
  std::array<float, 2> arms() const noexcept {
    const float moved = std::min(1.0f, 4 * std::abs(asked.shape->energy - 1));
    const auto arm = [&](Region region) {
      const float styled =
          asked.amount * std::min(1.0f, asked.shape->regions[static_cast<size_t>(region)]);
      return std::max(styled, moved);
    };
    return {arm(Region::left_arm), arm(Region::right_arm)};
  }
};

}  // namespace panache
