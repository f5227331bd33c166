#pragma once
// The character of panache live, for the page: its input and what is sent to the avatar.

#include <array>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>

#include "clip/clip.h"
#include "rig/mannequin.h"

namespace panache::cli {

// Shows the first sender that is recognised. The relay's thread calls start() and show(), those of
// the server the rest.
class LiveView {
 public:
  // Poses of `rig` follow. `first`: one frame of its skeleton.
  void start(const Rig& rig, const Clip& first);
  bool started() const { return in_.has_value(); }
  void show(ConstPose in, ConstPose styled);

  // The bytes of a BVH file of one frame; empty until start().
  std::string body();
  // The newest pose as JSON, the numbers of Mannequin::read() of the input and then of the output,
  // once its number is not `known`, which then is its number; empty after a while.
  std::string next(uint64_t& known);

 private:
  using Parts = std::array<float, 2 * kMannequinNumbers>;  // The input's, and the output's.

  std::optional<Mannequin> in_, styled_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::string body_;  // Guarded by the mutex, and so is:
  Parts parts_{};
  uint64_t number_ = 0;
};

}  // namespace panache::cli
