#pragma once
// A motion file as a whole: its clips, and everything else that must survive a round trip.

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/quat.h"
#include "base/result.h"
#include "clip/clip.h"

namespace panache {

// Value of ClipEdit::clip for a new motion.
inline constexpr int kNewClip = -1;

// New frames for one clip of a file, or a new clip.
struct ClipEdit {
  int clip = 0;  // Which of the file's clips, or kNewClip.
  // Has that clip's skeleton and frame time, and at least one frame. A new clip has the skeleton of
  // MotionFile::rest() and any frame time.
  const Clip* changed = nullptr;
  // [frames]: the frame of the file's clip (fractional) that each one came from. Empty for a new
  // clip.
  std::span<const double> source_frames;
  // Name of the new clip, if the format has names; made unique if it is taken.
  std::string name;
};

// A user's overrides for what a file states.
struct ReadOptions {
  // Frames a second, for a file whose rate is wrong or missing. The file is read as if it had that
  // rate, and encode() writes it. glTF has key times instead of a rate; there, every clip that
  // moves joints gets this many frames a second, and all its keys follow.
  std::optional<double> fps;
};
inline constexpr double kMinFps = 0.01, kMaxFps = 10'000;
// Ends messages about a missing or wrong rate.
inline constexpr const char* kGiveRate = "give its rate";
// Rejects a rate outside these bounds, and NaN.
Result<void> check_fps(double fps);

// What happens to the source clip of an edit: it is replaced, or it stays, with the edits at the
// end or at the beginning of the list of motions, where viewers look first. In `replace` a new clip
// replaces all motions of the file.
enum class EditMode { replace, add_beside, add_first };

class MotionFile {
 public:
  virtual ~MotionFile() = default;

  // The names of the motions in the file, "" if the format has none (BVH). Empty if the file has a
  // skeleton but no motion; clip(0) is then its rest pose in one frame.
  virtual std::vector<std::string> clip_names() const = 0;
  // A motion, with the file's own joints, order, units and rate. All clips of a file have the same
  // joints; which of them are animated may differ.
  virtual const Clip& clip(int which = 0) const = 0;
  // The skeleton at rest in one frame; its joints can move as a new motion of the file may move
  // them.
  virtual Clip rest() const = 0;
  // What is wrong with a readable file, and how it was read: one sentence each, starting with the
  // file's name as error messages do.
  virtual std::vector<std::string> notes() const { return {}; }
  // Whether encode() without edits returns other bytes than were read, even without options,
  // because faults in them are repaired.
  virtual bool is_mended() const { return false; }

  // The bytes of the file with the edited clips in it; each edit has another clip. A joint that
  // equals its pose in the source frame keeps the exact numbers of the file; everything else is
  // written with the file's precision. A format with a single clip replaces it in any mode.
  virtual std::string encode(std::span<const ClipEdit> edits, EditMode mode) const = 0;
  // The same for a single clip that replaces the file's first.
  std::string encode(const Clip& changed, std::span<const double> source_frames) const {
    const ClipEdit edit = {0, &changed, source_frames, ""};
    return encode({&edit, 1}, EditMode::replace);
  }
};

// Reads the motion file at `path`, whose extension determines its format: one of motion_formats(),
// or of those that a program has set (clip/motion_format.h). A .gltf may have its data in files
// next to it or below.
Result<std::unique_ptr<MotionFile>> read_motion(const std::string& path,
                                                const ReadOptions& options = {});

// Taken names, each with the number of requests for it.
using TakenNames = std::map<std::string, int>;
// `name`, or if it is taken, the same with the next free " (2)", " (3)", ...; marks it as taken.
inline std::string unique_name(const std::string& name, TakenNames& taken) {
  int& asked = taken[name];  // Insertions do not move the elements of a map.
  std::string result = name;
  while (++asked > 1) {
    result = name + " (" + std::to_string(asked) + ")";
    if (taken.emplace(result, 1).second) break;
  }
  return result;
}

// A skinned mesh that shows the motion of a new GLB file.

struct SkinnedBody {
  // The position of a point of the mesh relative to a joint of the clip: scale * rotate(rotation,
  // point) + translation, in the joint's axes and the clip's units.
  struct Bind {
    size_t joint;
    float scale;
    Quat rotation;
    Vec3 translation;
  };
  std::vector<Bind> binds;  // At most 256, each of another joint.

  std::vector<Vec3> positions;                  // [vertices] metres
  std::vector<Vec3> normals;                    // [vertices] unit
  std::vector<std::array<uint8_t, 4>> joints;   // [vertices] indices in `binds`
  std::vector<std::array<uint8_t, 4>> weights;  // [vertices] sum to 255
  std::vector<std::array<uint8_t, 4>> colours;  // [vertices] red, green, blue, alpha; linear
  std::vector<uint16_t> triangles;              // Three vertices each, counterclockwise.
};

}  // namespace panache
