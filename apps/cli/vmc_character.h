#pragma once
// One sender's character in the relay: its messages are gathered into frames, the frames styled,
// and the numbers changed in the very datagrams that they came in.

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
#include "vmc_messages.h"
#include "vmc_recording.h"
#include "vmc_socket.h"

namespace panache::cli {

// What all characters of a relay have in common.
struct VmcStyling {
  std::shared_ptr<const Model> model;
  LiveOptions options;
  int removed = -1;  // See LiveStylizer::set_removed().
  // The first character that is recognised fills the recording and is shown by the view. Either may
  // be null, and both must outlive the characters.
  VmcRecording* recording = nullptr;
  LiveView* view = nullptr;
};

// The first second goes through as it is: skeleton and rig are made of it. From then on a frame is
// whole when all bones of that second have come again, when the sender says that it ends, when a
// bone comes a second time, or when it has waited too long; datagrams wait for their frame.
class VmcCharacter {
 public:
  explicit VmcCharacter(VmcStyling how) : how_(std::move(how)) {}

  // Takes the sender's next datagram with its messages. strengths: one per style of the model.
  void take(Datagram datagram, std::span<const VmcMessage> messages,
            std::span<const float> strengths);
  // Ends a frame that has waited too long for its rest.
  void end_late_frame(double now, std::span<const float> strengths);
  // Ends the frame that waits, whatever is missing.
  void end_frame(std::span<const float> strengths);
  // Forgets the motion so far: what the style added to the way is undone.
  void reset() noexcept;

  // Datagrams that are done, in the order in which they came; each is handed out once.
  std::vector<Datagram> take_ready() { return std::exchange(ready_, {}); }
  // Frames that ended since this was asked.
  int take_frames() { return std::exchange(frames_, 0); }
  // Why the sender's motion cannot be styled, once; else empty.
  std::string take_note() { return std::exchange(note_, {}); }

 private:
  // The bones as last heard of, whether they have been heard of or not.
  struct Bones {
    double seconds = 0;
    VmcBoneSet known;
    std::array<Vec3, kVmcBones> positions{};
    std::array<Quat, kVmcBones> rotations{};
  };
  // A bone's numbers in a datagram that waits.
  struct Place {
    size_t datagram;
    size_t at;
    size_t joint;
  };

  void finish_frame(std::span<const float> strengths);
  void take_bone(const VmcMessage& bone, std::span<const float> strengths);
  void learn();
  Result<void> stand();
  void style(std::span<const float> strengths);
  void release();

  VmcStyling how_;
  bool records_ = false, shown_ = false;  // Fills the recording, is in view.

  Bones now_;
  VmcBoneSet seen_;            // In this frame.
  std::vector<Bones> learnt_;  // The first second.

  std::optional<LiveStylizer> stylizer_;  // Once the rig stands.
  VmcBoneSet whole_;                      // What makes a frame whole: the root only if it is sent.
  std::vector<int> bones_;                // [joints]
  std::array<size_t, kVmcBones> joint_of_{};  // Of the bones of the skeleton.
  Clip pose_, styled_;                        // One frame each.
  double last_frame_ = 0;

  std::vector<Datagram> held_, ready_;
  std::vector<Place> open_;  // Of this frame, in the order of the datagrams.
  int frames_ = 0;
  std::string note_;
};

}  // namespace panache::cli
