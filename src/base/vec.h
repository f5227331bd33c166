#pragma once
// Vectors of three numbers. Float at run time (Vec3), double in parsing and offline work (Vec3d).

#include <cmath>
#include <cstddef>

namespace panache {

template <class T>
struct BasicVec3 {
  T x = 0, y = 0, z = 0;

  constexpr T& operator[](size_t axis) { return axis == 0 ? x : axis == 1 ? y : z; }
  constexpr T operator[](size_t axis) const { return axis == 0 ? x : axis == 1 ? y : z; }

  friend constexpr BasicVec3 operator+(BasicVec3 a, BasicVec3 b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  friend constexpr BasicVec3 operator-(BasicVec3 a, BasicVec3 b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  friend constexpr BasicVec3 operator-(BasicVec3 a) { return {-a.x, -a.y, -a.z}; }
  friend constexpr BasicVec3 operator*(BasicVec3 a, T s) { return {a.x * s, a.y * s, a.z * s}; }
  friend constexpr BasicVec3 operator*(T s, BasicVec3 a) { return a * s; }
  friend constexpr BasicVec3 operator/(BasicVec3 a, T s) { return {a.x / s, a.y / s, a.z / s}; }
  friend constexpr bool operator==(BasicVec3, BasicVec3) = default;
  constexpr BasicVec3& operator+=(BasicVec3 b) { return *this = *this + b; }
  constexpr BasicVec3& operator-=(BasicVec3 b) { return *this = *this - b; }
  constexpr BasicVec3& operator*=(T s) { return *this = *this * s; }

  template <class U>
  constexpr BasicVec3<U> as() const {
    return {static_cast<U>(x), static_cast<U>(y), static_cast<U>(z)};
  }
};

using Vec3 = BasicVec3<float>;
using Vec3d = BasicVec3<double>;

template <class T>
constexpr T dot(BasicVec3<T> a, BasicVec3<T> b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
constexpr BasicVec3<T> cross(BasicVec3<T> a, BasicVec3<T> b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class T>
T length(BasicVec3<T> a) {
  return std::sqrt(dot(a, a));
}
// `a` normalised, or `otherwise` if `a` is too short.
template <class T>
BasicVec3<T> normalized(BasicVec3<T> a, BasicVec3<T> otherwise = {}) {
  const T n = length(a);
  return n > T(1e-9) ? a / n : otherwise;
}
template <class T>
constexpr BasicVec3<T> lerp(BasicVec3<T> a, BasicVec3<T> b, T t) {
  return a * (T(1) - t) + b * t;
}
template <class T>
bool is_finite(BasicVec3<T> a) {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

inline constexpr double kGravity = 9.81;  // m/s^2

}  // namespace panache
