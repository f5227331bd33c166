#pragma once
// Where the neutral motion comes from: the walker, steered, or a clip with a play head.

#include <memory>
#include <optional>
#include <vector>

#include "base/result.h"
#include "clip/motion_file.h"
#include "rig/rig.h"
#include "style/flight_lookout.h"
#include "walker/walker.h"

namespace panache::web {

class Source {
 public:
  virtual ~Source() = default;
  // Goes on by `seconds` of the input's own time. Returns true where the motion was cut: what comes
  // has nothing to do with what was.
  virtual bool advance(double seconds, Pose out) = 0;
  // How much of a flight that pose is part of, see FlightWatch::amount(), where what comes is
  // known.
  virtual std::optional<float> flight() const { return {}; }
  virtual const Clip& clip() const = 0;  // Its skeleton, and for a file its motion.
  virtual const Rig& rig() const = 0;
  // A pose in which nothing is twisted.
  virtual ConstPose reference() const = 0;
};

// A person who walks as she is steered.
class WalkerSource final : public Source {
 public:
  explicit WalkerSource(std::shared_ptr<const WalkerModel> model);

  // As Walker::step takes them.
  void steer(float speed, float turn) { speed_ = speed, turn_ = turn; }

  bool advance(double seconds, Pose out) override;
  const Clip& clip() const override { return clip_; }
  const Rig& rig() const override { return rig_; }
  ConstPose reference() const override { return t_pose_.pose(0); }

 private:
  Walker walker_;
  Clip clip_;  // A short walk, by which the rig is known.
  Clip t_pose_;
  Rig rig_;
  float speed_ = 0, turn_ = 0;
};

// A motion of a file. Begins at its first frame that is no calibration pose.
class ClipSource final : public Source {
 public:
  // `which` is one of the file's motions (0 where it has none: its rest pose). Fails where the
  // skeleton is no humanoid.
  static Result<std::unique_ptr<ClipSource>> create(std::shared_ptr<const MotionFile> file,
                                                    int which);

  void set_loop(bool loop) { loop_ = loop; }
  // To so many seconds after the first frame; the next advance() is a cut.
  void seek(double seconds);
  double seconds() const { return head_; }
  double begin() const { return first_ * clip().frame_time; }    // Of the first frame, in the file.
  double duration() const { return last_ * clip().frame_time; }  // From first to last frame.
  int first_frame() const { return first_; }  // Of the file's frames; those before it do not play.
  const MotionFile& file() const { return *file_; }
  int which() const { return which_; }

  bool advance(double seconds, Pose out) override;
  std::optional<float> flight() const override { return flight_; }
  const Clip& clip() const override { return file_->clip(which_); }
  const Rig& rig() const override { return rig_; }
  ConstPose reference() const override { return clip().pose(first_); }

 private:
  ClipSource(std::shared_ptr<const MotionFile> file, int which, Rig rig);

  std::shared_ptr<const MotionFile> file_;
  int which_;
  Rig rig_;
  int first_;        // Frame.
  double last_;      // Frames from first to last.
  double head_ = 0;  // Seconds after the first frame.
  bool loop_ = true, cut_ = true;
  FlightLookout lookout_;
  float flight_ = 0;
};

}  // namespace panache::web
