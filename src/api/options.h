#pragma once
// Converts options of the C interface to those of the library.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>

#include "base/result.h"
#include "panache/panache.h"
#include "rig/rig.h"
#include "style/model/model.h"
#include "style/stages/shape.h"
#include "style/stylizer_options.h"

namespace panache::api {

// No struct will ever be larger; a larger size was never initialised.
inline constexpr uint32_t kMaxStructBytes = 4096;

// Checks that the struct's size is possible and that all bytes after the `known` ones are 0. `name`
// is its type.
inline Result<void> check_struct(const void* given, size_t known, const std::string& name) {
  uint32_t size;
  std::memcpy(&size, given, sizeof size);
  if (size < sizeof size || size > kMaxStructBytes || size % sizeof size != 0) {
    return Error{name + ": its struct_size is " + std::to_string(size) + ", expected sizeof(" +
                 name + ")"};
  }
  const auto* bytes = static_cast<const unsigned char*>(given);
  if (std::any_of(bytes + std::min<size_t>(known, size), bytes + size,
                  [](unsigned char byte) { return byte != 0; })) {
    return Error{name + ": has fields that this library is too old for; leave them at 0"};
  }
  return {};
}

// The given fields, and `defaults` for missing ones; `given` may be null.
template <class T>
Result<T> read_struct(const T* given, const T& defaults, const std::string& name) {
  T out = defaults;
  if (!given) return out;
  if (auto good = check_struct(given, sizeof(T), name); !good) return good.error();
  std::memcpy(&out, given, std::min<size_t>(given->struct_size, sizeof(T)));
  return out;
}

// Copies `from` into the caller's struct, as far as it fits.
template <class T>
Result<void> write_struct(T from, T* out, const std::string& name) {
  if (auto good = check_struct(out, sizeof(T), name); !good) return good.error();
  from.struct_size = out->struct_size;
  std::memcpy(out, &from, std::min<size_t>(out->struct_size, sizeof(T)));
  return {};
}

// The checked units, axes and human joints of the options, without their poses.
Result<RigOptions> read_rig_options(const panache_skeleton_options& options, int32_t joint_count);

// Null means 1 for every field.
inline Result<Shape> read_shape(const panache_shape* given) {
  const auto read = read_struct<panache_shape>(given, PANACHE_SHAPE, "panache_shape");
  if (!read) return read.error();
  Shape out;
  out.strength = read->strength;
  out.posture = read->posture;
  out.dynamics = read->dynamics;
  out.timing = read->timing;
  out.regions[size_t(Region::legs)] = read->legs;
  out.regions[size_t(Region::torso)] = read->torso;
  out.regions[size_t(Region::left_arm)] = read->left_arm;
  out.regions[size_t(Region::right_arm)] = read->right_arm;
  out.foot_lock = read->foot_lock;
  out.hand_contacts = read->hand_contacts;
  out.energy = read->energy;
  return out;
}

// Fails if a model has another number of axes of persons, or none.
inline Result<void> check_person_count(const Model& model, int32_t count) {
  if (Result<void> good = check_has_persons(model); !good) return good.error();
  if (static_cast<size_t>(count) == model.persons()->axes()) return {};
  return Error{std::to_string(count) + " numbers of a person; expected " +
               std::to_string(model.persons()->axes()) + ", one for each axis of the model"};
}

// The numbers of a person; fails if they are not finite, or as check_person_count().
inline Result<PersonNumbers> read_person(const Model& model, const float* numbers, int32_t count) {
  if (Result<void> good = check_person_count(model, count); !good) return good.error();
  PersonNumbers out{};
  for (int32_t a = 0; a < count; ++a) {
    if (!std::isfinite(numbers[a])) {
      return Error{"number " + std::to_string(a) + " of a person is not finite"};
    }
    out[a] = std::clamp(numbers[a], -kMaxPerson, kMaxPerson);
  }
  return out;
}

// Metres per second; 0 means no limit.
inline float read_max_speed(double given) {
  return given == 0 ? std::numeric_limits<float>::infinity() : static_cast<float>(given);
}

// The options that clips and characters share.
template <class T>
StylizerOptions read_stylizer_options(const T& given) {
  StylizerOptions out;
  out.ease_seconds = given.ease_seconds;
  out.smoothing_seconds = given.smoothing_seconds;
  out.foot_lock = given.hold_feet != 0;
  out.root = given.style_root != 0;
  out.max_speed = read_max_speed(given.max_speed);
  out.gesture_rate = given.gesture_rate;
  out.gesture_seed = given.gesture_seed;
  return out;
}

}  // namespace panache::api
