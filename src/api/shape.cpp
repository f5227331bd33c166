#include "api/shape.h"

#include "api/sized_struct.h"

namespace panache::api {

Result<Shape> read_shape(const panache_shape* given) {
  const auto read = read_struct<panache_shape>(given, PANACHE_SHAPE, "panache_shape");
  if (!read) return read.error();
  Shape out;
  out.strength = read->strength;
  out.posture = read->posture;
  out.dynamics = read->dynamics;
  out.timing = read->timing;
  out.regions[Region::legs] = read->legs;
  out.regions[Region::torso] = read->torso;
  out.regions[Region::left_arm] = read->left_arm;
  out.regions[Region::right_arm] = read->right_arm;
  out.foot_lock = read->foot_lock;
  return out;
}

}  // namespace panache::api
