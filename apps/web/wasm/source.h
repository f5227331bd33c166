#pragma once
// The source of the neutral motion: the steered walker, or a clip with a play head.

#include <memory>
#include <optional>

#include "base/result.h"
#include "clip/motion_file.h"
#include "rig/rig.h"
#include "style/play/play_clip.h"
#include "walker/walker.h"

namespace panache::web {

class Source {
 public:
  // The steered walker.
  explicit Source(std::shared_ptr<const WalkerModel> model);
  // A motion of a file, from the first frame after any reference pose. `which` is the index of the
  // motion (0 is the rest pose if the file has no motion). Fails if the skeleton is not a humanoid.
  static Result<Source> create(std::shared_ptr<const MotionFile> file, int which);

  // Advances by `seconds` of the input's time. Returns true if the motion was cut, so the next pose
  // does not continue the last one.
  bool advance(double seconds, Pose out);
  // FlightWatch::amount() for the last pose; set only if the motion ahead is known.
  std::optional<float> flight() const { return flight_; }
  const Clip& clip() const { return *clip_; }  // The skeleton, and for a file the motion.
  const Rig& rig() const { return rig_; }
  // A reference pose, without twist in any joint.
  ConstPose reference() const { return reference_.pose(0); }
  // Null for the walker.
  const MotionFile* file() const { return file_.get(); }

  // For the walker; see Walker::step.
  void steer(float speed, float turn) { speed_ = speed, turn_ = turn; }

  // For a motion of a file. All times are 0 for the walker.
  void set_loop(bool loop) { loop_ = loop; }
  // Jumps to `seconds` after the first frame; the next advance() is a cut.
  void seek(double seconds);
  double seconds() const { return head_; }
  double begin() const { return first_ * clip().frame_time; }  // In the file.
  int first_frame() const { return first_; }  // Index in the file; earlier frames do not play.
  int which() const { return which_; }

 private:
  Source(std::shared_ptr<const MotionFile> file, int which, Rig rig);
  double duration() const { return last_ * clip().frame_time; }  // From first to last frame.

  std::optional<Walker> walker_;
  std::shared_ptr<const MotionFile> file_;
  int which_ = 0;
  std::shared_ptr<const Clip> clip_;  // For the walker: a short walk, to set up the rig.
  Rig rig_;
  Clip reference_;  // One frame.
  float speed_ = 0, turn_ = 0;
  int first_ = 0;    // Frame.
  double last_ = 0;  // Frames from first to last.
  double head_ = 0;  // Seconds after the first frame.
  bool loop_ = true, cut_ = true;
  std::optional<ClipHead> clip_head_;
  std::optional<float> flight_;
};

}  // namespace panache::web
