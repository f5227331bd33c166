#pragma once
// One sender's character in the relay: collects its messages into frames, styles the frames, and
// patches the values in the received datagrams.

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "live_view.h"
#include "style/live_stylizer.h"
#include "vmc_bones.h"
#include "vmc_filter.h"
#include "vmc_messages.h"
#include "vmc_recording.h"
#include "vmc_socket.h"

namespace panache::cli {

// Settings shared by all characters of a relay.
struct VmcStyling {
  std::shared_ptr<const Model> model;
  LiveOptions options;
  int removed = -1;     // See LiveStylizer::set_removed().
  bool mirror = false;  // See VmcFilter, also for the next.
  double smooth = 0;
  // The first character that is recognised is recorded and shown. Either may be null; both must
  // outlive the characters.
  VmcRecording* recording = nullptr;
  LiveView* view = nullptr;
};

// The first second passes through unchanged, and determines the skeleton and rig. After that a
// frame is complete when all bones of that second have been received, when the sender ends it, when
// a bone is repeated, or after a timeout; datagrams are held until their frame is complete.
class VmcCharacter {
 public:
  explicit VmcCharacter(VmcStyling styling) : styling_(std::move(styling)) {}

  // Takes the sender's next datagram and its messages. strengths: one per style of the model.
  void take(Datagram datagram, std::span<const VmcMessage> messages,
            std::span<const float> strengths);
  // Ends the current frame if it has timed out.
  void end_late_frame(double now, std::span<const float> strengths);
  // Ends the current frame, even if it is incomplete.
  void end_frame(std::span<const float> strengths);
  // See Stylizer::set_side().
  void set_side(int style, float side);
  // Forgets the motion so far, and with it the style's changes to the root motion.
  void reset() noexcept;

  // The datagrams that can be sent, in the order received; returns each once.
  std::vector<Datagram> take_ready() { return std::exchange(ready_, {}); }
  // The number of frames that ended since the last call.
  int take_frames() { return std::exchange(frames_, 0); }
  // Why the sender's motion cannot be styled, returned once; else empty.
  std::string take_note() { return std::exchange(note_, {}); }

 private:
  // The last received state of all bones; `known` tells which have been received.
  struct Bones {
    double seconds = 0;
    VmcBoneSet known;
    std::array<Vec3, kVmcBones> positions{};
    std::array<Quat, kVmcBones> rotations{};
  };
  // The position of a bone's values in a held datagram.
  struct BoneSlot {
    size_t datagram;
    size_t at;
    size_t joint;
  };

  void finish_frame(std::span<const float> strengths);
  void take_bone(const VmcMessage& bone, std::span<const float> strengths);
  void learn();
  Result<void> stand();
  // A bone's position in this frame, metres; see usual_positions_.
  Vec3 position_of(const Bones& frame, int bone) const;
  void style(std::span<const float> strengths);
  void release();

  VmcStyling styling_;
  bool records_ = false, shown_ = false;  // Is recorded; is shown.

  Bones now_;
  VmcBoneSet seen_;            // Received in this frame.
  std::vector<Bones> learnt_;  // Frames of the first second.

  std::optional<LiveStylizer> stylizer_;  // Set once the rig is made, like the next.
  std::optional<VmcFilter> filter_;
  VmcBoneSet whole_;        // Complete frame; has the root only if sent.
  std::vector<int> bones_;  // [joints]
  // Of a sender whose positions are all 0: what is added to them. [bones]
  std::optional<std::array<Vec3, kVmcBones>> usual_positions_;
  std::array<size_t, kVmcBones> joint_of_{};  // Joint of each bone.
  Clip pose_, styled_;                        // Single frames.
  double last_frame_ = 0;

  std::vector<Datagram> held_, ready_;
  std::vector<BoneSlot> open_;  // In the current frame, by datagram.
  int frames_ = 0;
  std::string note_;
};

}  // namespace panache::cli
