#pragma once
// VMC messages in OSC datagrams: found, read and changed in place, so that all else in a datagram
// stays what it is.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/quat.h"
#include "base/vec.h"

namespace panache::cli {

// One message of a datagram.
struct VmcMessage {
  enum Kind {
    bone,       // Where a bone or the root is.
    frame_end,  // /VMC/Ext/OK and /VMC/Ext/T.
    style,      // /panache/style NAME STRENGTH
    reset,      // /panache/reset
    other,      // Anything else, and messages of the names above with other arguments.
  };
  Kind kind = other;
  int bone_index = -1;  // Of vmc_bones.h.
  Vec3 position;        // Relative to the parent, metres, Panache's axes.
  Quat rotation;        // Likewise.
  size_t place = 0;     // Of the seven floats of a bone in the datagram, bytes.
  std::string name;     // Of a style.
  double strength = 0;  // Of a style, any number at all.
};

// The messages of a datagram in their order, bundles opened; nothing where the datagram is no OSC.
std::optional<std::vector<VmcMessage>> read_vmc(std::span<const char> datagram);

// Puts a position or a rotation in the place of a bone's numbers.
void put_position(std::span<char> datagram, size_t place, Vec3 position);
void put_rotation(std::span<char> datagram, size_t place, Quat rotation);

// What `panache live send` says of one frame.
struct VmcFrame {
  double seconds = 0;  // Since the start.
  struct Bone {
    int index;  // Of vmc_bones.h, the root included.
    Vec3 position;
    Quat rotation;
  };
  std::vector<Bone> bones;
};
// As the bundles that it is sent in, none of which exceeds a packet of the network.
std::vector<std::vector<char>> format_vmc(const VmcFrame& frame);

}  // namespace panache::cli
