#pragma once
// The data that the stages of one step read and write, and what they report of it.

#include <algorithm>
#include <array>
#include <cmath>

#include "pose/contacts.h"
#include "pose/observer.h"
#include "pose/changed_joints.h"
#include "pose/style_delta.h"
#include "style/model/gesture.h"
#include "style/stages/arms_clear.h"
#include "style/stages/root_motion.h"
#include "style/stages/shape.h"
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

// What a step begins with: no stage changes it.
struct StageInput {
  const AskedChange& asked;
  const StageOptions& options;
  const float flight;  // Share, 0 to 1, see FlightWatch::amount().
  const Observer& observer;
  const InputWindow& window;
  const StepTime& time;

  const Observation& now = observer.now();
  const HeadingBody body = now.world;  // The input, heading frame, metres.
};

// A step on its way through the row. Each field is written by the one stage that is named, and read
// by those after it; `change` and `joints` by every stage from there on. Shares are 0 to 1.
struct StageWork : StageInput {
  BodyChange& change;                  // Shaping: the change of the input.
  float stepping = 0;                  // StepWatch: share, see amount().
  float seated = 0;                    // SeatWatch: share, see amount().
  const StyleDelta* delta = nullptr;   // OutputFilter: filtered;
  float log_rate = 0;                  // see AskedChange; 0 in a flight or without steps.
  RootOffset root = {};                // RootMotion: the style's change of the path; Shaping takes
                                       // away what the shape holds back.
  float above_floor = 1;               // Shaping: share, see share_above_floor();
  Shape shape = {};                    // as requested, reduced where it does not suit the body.
  float lift = 0;                      // Gestures: how far one lifts both feet, metres.
  HumanPositions joints = {};          // Balance: changed_joints() of body and change.
  float raised = 0;                    // FloorClearance: how far it raises the hips, not eased;
                                       // metres.
  std::array<float, kFeet> resting{};  // FootStance: how much feet keep their height, shares.
  ArmRotations free_arms = {};         // HandContacts: before it and the body correct them;
  HandHolds holds = {};                // contacts that the hands keep.

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

// What the stages did at one instant, for reports.
struct StageFacts {
  // 1 if something besides the feet supports the body, and hips and legs stay unchanged; see
  // SeatWatch.
  float seated = 0;
  float touching = 0;  // 1 if a hand keeps a contact, see HandContacts.
};

}  // namespace panache
