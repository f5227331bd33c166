#pragma once
// The keys of one channel of a glTF animation, as a function of time. Private to the folder.

#include <optional>
#include <span>
#include <vector>

namespace panache {

struct GltfTrack {
  enum class Interpolation { step, linear, cubic };
  Interpolation interpolation = Interpolation::linear;
  bool rotates = false;        // Values are rotations, interpolated on the sphere.
  size_t components = 0;       // Numbers in a value.
  std::vector<float> times;    // [keys], seconds, increasing.
  std::vector<float> numbers;  // [keys][3 if cubic][components]: tangent in, value, tangent out.

  // The value of a key, bit for bit.
  std::span<const float> key(size_t which) const;
  // The value at `seconds`, constant before the first key and after the last. A key at most
  // `tolerance` seconds away gives its exact bits. `out` has room for the components.
  void evaluate(double seconds, double tolerance, std::span<float> out) const;
  // Whether all values are the same.
  bool is_constant() const;
};

// The times of frames at a constant rate.
struct FrameGrid {
  double start = 0;       // Seconds.
  double frame_time = 0;  // Seconds, above zero.
  double frames = 1;      // An integer, possibly huge.
};

// How near, in seconds, a key must be to a frame at `seconds` to count as on it.
double key_tolerance(double seconds, double frame_time);

// The grid for `deciding` (null for none) and the span of all tracks, `first` to `last` seconds:
// the rate of its keys if they have one, otherwise a usual rate. Keys too far apart to be frames of
// a motion get frames between them. `frame_time` is the time between frames if it is known,
// seconds.
FrameGrid find_grid(const GltfTrack* deciding, double first, double last,
                    std::optional<double> frame_time = {});

}  // namespace panache
