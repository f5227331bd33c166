#pragma once
// The stages of a step by name, and who times them.

#include <array>

namespace panache {

// The parts of a step, in this order. Each is a type of its own, in style/stages or where it is
// named here.
enum class Stage {
  observe,    // Observer
  window,     // InputWindow
  strengths,  // EasedStrengths
  networks,   // StyleNetworks
  filter,     // OutputFilter
  root,       // RootMotion
  shape,      // Shaping
  anatomy,    // Anatomy
  balance,    // keep_balance()
  legs,       // LegsApart
  floor,      // FloorClearance
  fall,       // FreeFall
  stance,     // FootStance
  feet,       // FootLock and LegsApart
  hands,      // HandContacts
  arms,       // ArmsClear
  write,      // PosedRig
};
inline constexpr std::array<const char*, 17> kStageNames = {"observe the pose",
                                                            "history and window",
                                                            "ease strengths and shape",
                                                            "networks, heads and gate",
                                                            "filter",
                                                            "root motion",
                                                            "shape",
                                                            "keep joints in range",
                                                            "keep the balance",
                                                            "keep the legs apart",
                                                            "keep above the floor",
                                                            "fall as the input does",
                                                            "keep resting feet level",
                                                            "hold the feet",
                                                            "keep hands in contact",
                                                            "keep arms outside",
                                                            "write the pose (rig)"};

// Told when each stage of a step is done, to time them.
class StageClock {
 public:
  virtual ~StageClock() = default;
  virtual void done(Stage stage) noexcept = 0;
};

// `clock` may be null.
inline void tell(StageClock* clock, Stage stage) noexcept {
  if (clock) clock->done(stage);
}

}  // namespace panache
