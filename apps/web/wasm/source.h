#pragma once
// Where the neutral motion comes from: the walker, steered, or a clip with a play head.

#include <memory>
#include <optional>

#include "base/result.h"
#include "clip/motion_file.h"
#include "rig/rig.h"
#include "style/flight_lookout.h"
#include "walker/walker.h"

namespace panache::web {

class Source {
 public:
  // The walker, steered.
  explicit Source(std::shared_ptr<const WalkerModel> model);
  // A motion of a file, which begins at its first frame that is no calibration pose. `which` is one
  // of the file's motions (0 where it has none: its rest pose). Fails where the skeleton is no
  // humanoid.
  static Result<Source> create(std::shared_ptr<const MotionFile> file, int which);

  // Goes on by `seconds` of the input's own time. Returns true where the motion was cut: what comes
  // has nothing to do with what was.
  bool advance(double seconds, Pose out);
  // How much of a flight that pose is part of, see FlightWatch::amount(), where what comes is
  // known.
  std::optional<float> flight() const { return flight_; }
  const Clip& clip() const { return *clip_; }  // Its skeleton, and for a file its motion.
  const Rig& rig() const { return rig_; }
  // A pose in which nothing is twisted.
  ConstPose reference() const { return reference_.pose(0); }
  // Null for the walker.
  const MotionFile* file() const { return file_.get(); }

  // Of the walker, as Walker::step takes them.
  void steer(float speed, float turn) { speed_ = speed, turn_ = turn; }

  // Of a motion of a file. All times are 0 for the walker.
  void set_loop(bool loop) { loop_ = loop; }
  // To so many seconds after the first frame; the next advance() is a cut.
  void seek(double seconds);
  double seconds() const { return head_; }
  double begin() const { return first_ * clip().frame_time; }  // Of the first frame, in the file.
  int first_frame() const { return first_; }  // Of the file's frames; those before it do not play.
  int which() const { return which_; }

 private:
  Source(std::shared_ptr<const MotionFile> file, int which, Rig rig);
  double duration() const { return last_ * clip().frame_time; }  // From first to last frame.

  std::optional<Walker> walker_;
  std::shared_ptr<const MotionFile> file_;
  int which_ = 0;
  std::shared_ptr<const Clip> clip_;  // Of the walker a short walk, by which the rig is known.
  Rig rig_;
  Clip reference_;  // One frame.
  float speed_ = 0, turn_ = 0;
  int first_ = 0;    // Frame.
  double last_ = 0;  // Frames from first to last.
  double head_ = 0;  // Seconds after the first frame.
  bool loop_ = true, cut_ = true;
  std::optional<FlightLookout> lookout_;
  std::optional<float> flight_;
};

}  // namespace panache::web
