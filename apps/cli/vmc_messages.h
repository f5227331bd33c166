#pragma once
// Finds, reads and patches VMC messages in OSC datagrams; all other bytes are unchanged.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/quat.h"
#include "base/vec.h"

namespace panache::cli {

// Converts between Unity's coordinates, used by VMC (left-handed, Y up, facing +z, left hand at
// -x), and Panache's (right-handed, Y up, facing +z, left hand at +x): mirror images in the plane x
// = 0. Only signs change, so a round trip is exact to the bit. Both directions, metres.
constexpr Vec3 mirrored_position(Vec3 p) { return {-p.x, p.y, p.z}; }
// Both directions. A mirrored rotation turns about the mirrored axis in the opposite sense.
constexpr Quat mirrored_rotation(Quat q) { return {q.x, -q.y, -q.z, q.w}; }

// One message of a datagram.
struct VmcMessage {
  enum Kind {
    bone,       // The transform of a bone or the root.
    frame_end,  // /VMC/Ext/OK and /VMC/Ext/T.
    style,      // /panache/style NAME STRENGTH
    side,       // /panache/side NAME SIDE
    reset,      // /panache/reset
    other,      // Anything else, and messages with these names but other arguments.
  };
  Kind kind = other;
  int bone_index = -1;    // See vmc_bones.h.
  Vec3 position;          // Relative to the parent, metres, Panache's axes.
  Quat rotation;          // Relative to the parent, Panache's axes.
  size_t offset = 0;      // Byte offset of a bone's seven floats in the datagram.
  std::string name;       // Style name.
  double strength = 0;    // Style strength, not range-checked.
  std::string side_text;  // A style's side, a word or a number, not checked.
};

// The messages of a datagram in order, with bundles unpacked; nullopt if it is not OSC.
std::optional<std::vector<VmcMessage>> read_vmc(std::span<const char> datagram);

// Overwrite a bone's position or rotation.
void put_position(std::span<char> datagram, size_t offset, Vec3 position);
void put_rotation(std::span<char> datagram, size_t offset, Quat rotation);

// A frame as sent by `panache live send`.
struct VmcFrame {
  double seconds = 0;  // Since the start.
  struct Bone {
    int index;  // See vmc_bones.h; may be the root.
    Vec3 position;
    Quat rotation;
  };
  std::vector<Bone> bones;
};
// Formats a frame as bundles, each small enough for one network packet.
std::vector<std::vector<char>> format_vmc(const VmcFrame& frame);

}  // namespace panache::cli
