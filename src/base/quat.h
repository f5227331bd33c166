#pragma once
// Rotations as unit quaternions, stored x y z w.

#include <algorithm>
#include <cmath>

#include "base/elementary.h"
#include "base/vec.h"

namespace panache {

template <class T>
struct BasicQuat {
  T x = 0, y = 0, z = 0, w = 1;

  constexpr BasicVec3<T> xyz() const { return {x, y, z}; }
  friend constexpr bool operator==(BasicQuat, BasicQuat) = default;

  // The Hamilton product: (a * b) rotates by b first, then by a.
  friend constexpr BasicQuat operator*(BasicQuat a, BasicQuat b) {
    return {a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
            a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
            a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w,
            a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
  }

  template <class U>
  constexpr BasicQuat<U> as() const {
    return {static_cast<U>(x), static_cast<U>(y), static_cast<U>(z), static_cast<U>(w)};
  }
};

using Quat = BasicQuat<float>;
using Quatd = BasicQuat<double>;

// The inverse of a unit quaternion.
template <class T>
constexpr BasicQuat<T> conjugate(BasicQuat<T> q) {
  return {-q.x, -q.y, -q.z, q.w};
}
template <class T>
constexpr T dot(BasicQuat<T> a, BasicQuat<T> b) {
  return a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w;
}
// `q` normalised; the identity if its length is 0.
template <class T>
BasicQuat<T> normalized(BasicQuat<T> q) {
  const T n = std::sqrt(dot(q, q));
  return n > T(1e-9) ? BasicQuat<T>{q.x / n, q.y / n, q.z / n, q.w / n} : BasicQuat<T>{};
}
// `v` rotated by the unit quaternion `q`.
template <class T>
constexpr BasicVec3<T> rotate(BasicQuat<T> q, BasicVec3<T> v) {
  const BasicVec3<T> t = cross(q.xyz(), v) * T(2);
  return v + t * q.w + cross(q.xyz(), t);
}
// rotate(q, v) - v, which is exactly zero for the identity.
template <class T>
constexpr BasicVec3<T> rotate_offset(BasicQuat<T> q, BasicVec3<T> v) {
  const BasicVec3<T> t = cross(q.xyz(), v) * T(2);
  return t * q.w + cross(q.xyz(), t);
}
// The rotation `q` expressed in other axes, to which `axes` turns its own. The scalar part does not
// change, so the identity stays bit-exact.
template <class T>
constexpr BasicQuat<T> in_axes(BasicQuat<T> axes, BasicQuat<T> q) {
  const BasicVec3<T> v = rotate(axes, q.xyz());
  return {v.x, v.y, v.z, q.w};
}
// The rotation by `angle` radians about the unit `axis`.
template <class T>
BasicQuat<T> axis_angle(BasicVec3<T> axis, T angle) {
  const T s = sine(angle / 2);
  return {axis.x * s, axis.y * s, axis.z * s, cosine(angle / 2)};
}
// The rotation by `angle` radians about +y.
template <class T>
BasicQuat<T> rotation_y(T angle) {
  return {0, sine(angle / 2), 0, cosine(angle / 2)};
}
// The rotation whose axis is the direction of `r` and whose angle is its length, in radians.
template <class T>
BasicQuat<T> exp_rotation(BasicVec3<T> r) {
  const T angle = length(r);
  // sin(a/2)/a -> 1/2 as a -> 0; at zero the result is exactly the identity.
  const T k = angle > T(1e-6) ? sine(angle / 2) / angle : T(0.5);
  return {r.x * k, r.y * k, r.z * k, cosine(angle / 2)};
}
// The rotation vector of `q`, of length 0 to pi.
template <class T>
BasicVec3<T> log_rotation(BasicQuat<T> q) {
  if (q.w < 0) q = {-q.x, -q.y, -q.z, -q.w};
  const T s = length(q.xyz());
  return s > T(1e-9) ? q.xyz() * (2 * arc_tangent(s, q.w) / s) : q.xyz() * T(2);
}
// The smallest rotation that turns the unit vector `from` to the unit vector `to`.
template <class T>
BasicQuat<T> rotation_between(BasicVec3<T> from, BasicVec3<T> to) {
  const T w = 1 + dot(from, to);
  if (w < T(1e-6)) {  // Opposite: half a turn about any perpendicular axis.
    const BasicVec3<T> other =
        std::abs(from.x) < T(0.7) ? BasicVec3<T>{1, 0, 0} : BasicVec3<T>{0, 1, 0};
    const BasicVec3<T> axis = normalized(cross(from, other));
    return {axis.x, axis.y, axis.z, 0};
  }
  const BasicVec3<T> v = cross(from, to);
  return normalized(BasicQuat<T>{v.x, v.y, v.z, w});
}
// The rotation whose matrix has the orthonormal columns x, y, z.
template <class T>
BasicQuat<T> from_axes(BasicVec3<T> x, BasicVec3<T> y, BasicVec3<T> z) {
  const T trace = x.x + y.y + z.z;
  BasicQuat<T> q;
  if (trace > 0) {
    q = {y.z - z.y, z.x - x.z, x.y - y.x, 1 + trace};
  } else if (x.x > y.y && x.x > z.z) {
    q = {1 + x.x - y.y - z.z, y.x + x.y, z.x + x.z, y.z - z.y};
  } else if (y.y > z.z) {
    q = {y.x + x.y, 1 - x.x + y.y - z.z, z.y + y.z, z.x - x.z};
  } else {
    q = {z.x + x.z, z.y + y.z, 1 - x.x - y.y + z.z, x.y - y.x};
  }
  return normalized(q);
}
// Normalised linear interpolation along the shorter arc. t = 0 gives `a` exactly.
template <class T>
BasicQuat<T> nlerp(BasicQuat<T> a, BasicQuat<T> b, T t) {
  if (t == T(0)) return a;
  const T s = dot(a, b) < 0 ? -t : t;
  return normalized(BasicQuat<T>{a.x * (1 - t) + b.x * s, a.y * (1 - t) + b.y * s,
                                 a.z * (1 - t) + b.z * s, a.w * (1 - t) + b.w * s});
}
template <class T>
bool is_finite(BasicQuat<T> q) {
  return std::isfinite(q.x) && std::isfinite(q.y) && std::isfinite(q.z) && std::isfinite(q.w);
}

}  // namespace panache
