#pragma once
// What the stages of one step read and write.

#include <algorithm>
#include <array>

#include "pose/changed_joints.h"
#include "pose/contacts.h"
#include "pose/hand_contacts.h"
#include "pose/observer.h"
#include "pose/style_delta.h"
#include "style/gesture.h"
#include "style/shape.h"
#include "style/stages/root_motion.h"
#include "style/stages/step_time.h"
#include "style/stages/window.h"
#include "style/stance.h"

namespace panache {

// The requested change at one step.
struct AskedChange {
  StyleDelta delta;
  float log_rate = 0;                    // Logarithm of input seconds per output second.
  std::array<float, kFeet> contacts{};   // Probability that each foot is planted.
  float gate = 1;                        // How well the motion is known, 0 to 1.
  Stance stance = {};                    // Of a foot that stands.
  const GesturePose* gesture = nullptr;  // On top of it; null for none.
  const Shape* shape = &kPlainShape;     // How it is given.
  float amount = 1;  // How much of any style is in force, see EasedStrengths::amount().
};

// How changes are carried out; as StylizerOptions has it.
struct StageOptions {
  bool root = true, foot_lock = true, hold_hands = true;
  bool tempo_everywhere = false;  // Otherwise only where the feet step.
};

// One step. The first part is given; the rest is what one stage of the row finds for those after
// it. Shares go from 0 to 1.
struct StageWork {
  const AskedChange& asked;
  const StageOptions& options;
  float flight;  // Share, see FlightWatch::amount().
  const Observer& observer;
  const InputWindow& window;
  const StepTime& time;
  BodyChange& change;  // From the shape on, what is to be done to the input.
  Vec3 pull;           // Of a planted foot at the last step, see FootLock::pull().

  const Observation& now = observer.now();
  HeadingBody body = now.world;  // The input, heading frame, metres.
  float stepping = 0;            // Share, see StepWatch::amount().
  float seated = 0;              // Share, see SeatWatch::amount().
  float above_floor = 1;         // Share, see share_above_floor().
  float log_rate = 0;            // As AskedChange has it: of the steps, and never in a flight.
  StyleDelta delta = {};         // Filtered.
  RootOffset root = {};          // What the style adds to the way.
  Shape shape = {};              // As asked, less where the body may not take it.
  float lifted = 0;              // How much a gesture has the feet off the floor, share.
  HumanPositions joints = {};    // changed_joints() of body and change, from the balance on.
  std::array<float, kFeet> resting{};  // How much feet are held at their height, shares.
  HandHolds holds = {};                // What the hands keep hold of.

  // How much of a style is in force for an arm. One that keeps none of it keeps its input, too.
  std::array<float, 2> arms() const noexcept {
    const auto arm = [&](Region region) {
      return asked.amount * std::min(1.0f, asked.shape->regions[static_cast<size_t>(region)]);
    };
    return {arm(Region::left_arm), arm(Region::right_arm)};
  }
};

}  // namespace panache
