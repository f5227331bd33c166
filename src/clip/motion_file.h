#pragma once
// A motion file as a whole: the clips in it, and all else that must survive a round trip.

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "clip/clip.h"

namespace panache {

// In ClipEdit::clip: a new motion.
inline constexpr int kNewClip = -1;

// New frames for one clip of a file, or a new clip.
struct ClipEdit {
  int clip = 0;  // Which of the file's clips, or kNewClip.
  // With that clip's skeleton and frame time, and any number of frames above zero. A new clip has
  // the skeleton of MotionFile::rest() and any frame time.
  const Clip* changed = nullptr;
  // [frames]: which frame of the file's clip (fractional) each one came from. None of a new clip.
  std::span<const double> source_frames;
  // Name of the new clip, in formats whose clips have names; made unique where it is taken.
  std::string name;
};

// A user's overrides for what a file states.
struct ReadOptions {
  // Frames a second, for a file whose rate is wrong or missing. The file is as if it had that rate:
  // what encode() gives has it, too. The keys of glTF have times in place of a rate; there the
  // frames of every clip that moves joints are set so many a second, and all keys with them.
  std::optional<double> fps;
};
inline constexpr double kMinFps = 0.01, kMaxFps = 10'000;
// At the end of messages about a rate that is missing or wrong.
inline constexpr const char* kGiveRate = "give its rate";
// Rejects a rate beyond these bounds, or none.
Result<void> check_fps(double fps);

// What becomes of the clip that an edit came from: it goes, or stays, with the edits at the end or
// at the beginning of the list of motions, where viewers look first. In `replace` a new clip takes
// the place of all motions of the file.
enum class EditMode { replace, add_beside, add_first };

class MotionFile {
 public:
  virtual ~MotionFile() = default;

  // The names of the motions in the file, "" where the format has none (BVH). Empty where the file
  // has a skeleton and no motion; clip(0) is then its rest pose in one frame.
  virtual std::vector<std::string> clip_names() const = 0;
  // A motion, with the file's own joints, order, units and rate. The clips of one file have the
  // same joints; what the file animates of them may differ.
  virtual const Clip& clip(int which = 0) const = 0;
  // The skeleton at rest in one frame, its joints as free as a new motion of the file may have
  // them.
  virtual Clip rest() const = 0;
  // What is wrong with the file although it could be read, and how it was read: one sentence each,
  // that begins with the file's name as the message of a failure does.
  virtual std::vector<std::string> notes() const { return {}; }
  // Whether encode() without edits gives other bytes than were read although nothing was asked for:
  // what was wrong in them is mended.
  virtual bool is_mended() const { return false; }

  // The bytes of the same file with the edited clips in it; those of different edits differ. A
  // joint that equals the pose of the frame that it came from keeps the very numbers of the file;
  // everything else is written as exactly as the file's own numbers are. A format that holds a
  // single clip replaces it in either mode.
  virtual std::string encode(std::span<const ClipEdit> edits, EditMode mode) const = 0;
  // The same for a single clip that takes the place of the file's first.
  std::string encode(const Clip& changed, std::span<const double> source_frames) const {
    const ClipEdit edit = {0, &changed, source_frames, ""};
    return encode({&edit, 1}, EditMode::replace);
  }
};

// Reads the motion file at `path`, whose extension decides which format it has: one of
// motion_formats(), or of those that a program has set (clip/motion_format.h). A .gltf may have its
// data in files beside and below it.
Result<std::unique_ptr<MotionFile>> read_motion(const std::string& path,
                                                const ReadOptions& options = {});

}  // namespace panache
