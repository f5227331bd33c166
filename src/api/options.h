#pragma once
// Converts options of the C interface to those of the library.

#include <algorithm>
#include <cmath>
#include <limits>

#include "api/sized_struct.h"
#include "panache/panache.h"
#include "rig/rig.h"
#include "style/model/model.h"
#include "style/stages/shape.h"

namespace panache::api {

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

}  // namespace panache::api
