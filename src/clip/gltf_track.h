#pragma once
// The keys of one channel of a glTF animation, as a function of time. Private to the folder.

#include <optional>
#include <span>
#include <vector>

namespace panache {

struct GltfTrack {
  enum class Interpolation { step, linear, cubic };
  Interpolation interpolation = Interpolation::linear;
  bool rotates = false;        // Between keys on the sphere of rotations.
  size_t components = 0;       // Numbers in a value.
  std::vector<float> times;    // [keys], seconds, increasing.
  std::vector<float> numbers;  // [keys][3 if cubic][components]: tangent in, value, tangent out.

  // The value of a key: its own bits.
  std::span<const float> key(size_t which) const;
  // The value at `seconds`, held before the first key and after the last. A key that is at most
  // `tolerance` seconds away gives its own bits. `out` has room for the components.
  void evaluate(double seconds, double tolerance, std::span<float> out) const;
  // Whether all values are the same.
  bool is_constant() const;
};

// Where frames of a constant rate lie in time.
struct FrameGrid {
  double start = 0;       // Seconds.
  double frame_time = 0;  // Seconds, above zero.
  double frames = 1;      // A whole number, perhaps a huge one.
};

// How near, in seconds, a key has to be to a frame at `seconds` to be on it.
double key_tolerance(double seconds, double frame_time);

// The grid that `deciding` (null for none) and the span of all tracks, `first` to `last` seconds,
// give: its keys' own rate where they lie on one, and a usual rate where they do not. Keys that are
// further apart than a frame of motion should be get frames between them. `frame_time` is theirs
// where it is known, seconds.
FrameGrid find_grid(const GltfTrack* deciding, double first, double last,
                    std::optional<double> frame_time = {});

}  // namespace panache
