#pragma once
// The character of panache live as shown on the page: its input, and what is sent to the avatar.

#include <array>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>

#include "clip/clip.h"
#include "rig/posed_rig.h"

namespace panache::cli {

// Shows the first sender that is recognised. The relay's thread calls start() and show(); the
// server's threads call the rest.
class LiveView {
 public:
  // Must precede show(), with poses of `rig`. `first`: one frame of its skeleton.
  void start(const Rig& rig, const Clip& first);
  bool started() const { return in_.has_value(); }
  void show(ConstPose in, ConstPose styled);

  // The bytes of a BVH file of one frame; empty until start().
  std::string body();
  // Waits for a pose newer than number `known`, and sets `known` to its number. Returns it as JSON,
  // the values of Mannequin::read() for the input and then the output; empty after a timeout.
  std::string next(uint64_t& known);

 private:
  using Parts = std::array<float, 2 * kMannequinNumbers>;  // Input, then output.

  std::optional<Mannequin> in_, styled_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::string body_;  // The mutex guards this and the following:
  Parts parts_{};
  uint64_t number_ = 0;
};

}  // namespace panache::cli
