#include "clip/euler.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace panache {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDegrees = 180 / kPi;

// Poses are floats: an error of a last bit, 6e-8, in each component of a unit quaternion is a
// rotation error of 2.4e-7 radians. Angles may be chosen freely within this bound.
constexpr double kFreedom = 3e-7;

// +1 if the axes are a cyclic permutation of x y z, -1 otherwise.
double handedness(int a, int b) { return b == (a + 1) % 3 ? 1.0 : -1.0; }

double component(Quatd q, int axis) { return axis == 0 ? q.x : axis == 1 ? q.y : q.z; }

// `angle` plus the multiple of a full turn that brings it nearest to `near`; radians.
double unwrap(double angle, double near) {
  return angle + 2 * kPi * std::round((near - angle) / (2 * kPi));
}

struct Matrix {
  double m[3][3];  // [row][column]
};

Matrix to_matrix(Quatd q) {
  const Vec3d x = rotate(q, Vec3d{1, 0, 0});
  const Vec3d y = rotate(q, Vec3d{0, 1, 0});
  const Vec3d z = rotate(q, Vec3d{0, 0, 1});
  return {{{x.x, y.x, z.x}, {x.y, y.y, z.y}, {x.z, y.z, z.z}}};
}

// Both solutions of R = Ra(alpha) Rb(beta) Rc(gamma), the nearer one. With s = handedness:
//   R[b][c] = -s sin(alpha) cos(beta),  R[c][c] = cos(alpha) cos(beta)
// give alpha up to half a turn; then R' = Ra(-alpha) R = Rb(beta) Rc(gamma), in which
//   R'[b][a] = s sin(gamma),  R'[b][b] = cos(gamma),  R'[a][c] = s sin(beta),  R'[c][c] =
//   cos(beta).
// Taking gamma and beta from R' makes them fit whatever alpha was chosen. An alpha that is off by d
// costs cos(beta) sin(d) radians, so near gimbal lock, cos(beta) = 0, it may stay where it was.
EulerAngles three_angles(const EulerOrder& order, Quatd rotation, const EulerAngles& near) {
  const int a = order.axis[0], b = order.axis[1], c = order.axis[2];
  const double s = handedness(a, b);
  const Matrix r = to_matrix(rotation);
  const double cos_beta = std::min(1.0, std::hypot(r.m[b][c], r.m[c][c]));
  const double first = cos_beta > 0 ? std::atan2(-s * r.m[b][c], r.m[c][c]) : near[0];
  // k (1 / cos(beta) - 1) costs less than k and is nothing where beta is 0.
  const double slack =
      cos_beta > 0 ? std::asin(std::min(1.0, kFreedom * (1 / cos_beta - 1))) : kPi / 2;

  EulerAngles best = near;
  double best_distance = -1;
  for (const double turned : {first, first + kPi}) {
    const double exact = unwrap(turned, near[0]);
    const double alpha = std::clamp(near[0], exact - slack, exact + slack);
    const double cos_a = std::cos(alpha), sin_a = s * std::sin(alpha);
    const auto row_b = [&](int k) { return cos_a * r.m[b][k] + sin_a * r.m[c][k]; };
    const double gamma = unwrap(std::atan2(s * row_b(a), row_b(b)), near[2]);
    const double cc = cos_a * r.m[c][c] - sin_a * r.m[b][c];
    const double beta = unwrap(std::atan2(s * r.m[a][c], cc), near[1]);
    const Vec3d away = Vec3d{alpha, beta, gamma} - Vec3d{near[0], near[1], near[2]};
    const double distance = dot(away, away);
    if (best_distance < 0 || distance < best_distance) {
      best = {alpha, beta, gamma};
      best_distance = distance;
    }
  }
  return best;
}

// The Ra(alpha) Rb(beta) nearest to q: with x = alpha / 2, y = beta / 2, c the third axis, it has
// the largest dot product with q,
//   q.w cos x cos y + q.a sin x cos y + q.b cos x sin y + s q.c sin x sin y,
// a sum of one sinusoid in x + y and one in x - y, each of which can be at its top.
EulerAngles two_angles(const EulerOrder& order, Quatd q, const EulerAngles& near) {
  const int a = order.axis[0], b = order.axis[1], c = 3 - a - b;
  const double qa = component(q, a), qb = component(q, b);
  const double qc = handedness(a, b) * component(q, c);
  const double sum = std::atan2(qa + qb, q.w - qc);
  const double difference = std::atan2(qa - qb, q.w + qc);
  return {unwrap(sum + difference, near[0]), unwrap(sum - difference, near[1]), 0};
}

// The Ra(alpha) nearest to q: the twist of q about the axis.
EulerAngles one_angle(const EulerOrder& order, Quatd q, const EulerAngles& near) {
  return {unwrap(2 * std::atan2(component(q, order.axis[0]), q.w), near[0]), 0, 0};
}

}  // namespace

Quatd euler_to_quat(const EulerOrder& order, const EulerAngles& angles) {
  Quatd rotation;
  for (int i = 0; i < order.count; ++i) {
    const double half = angles[i] / kDegrees / 2;
    const double s = std::sin(half), c = std::cos(half);
    const int axis = order.axis[i];
    rotation = rotation * Quatd{axis == 0 ? s : 0, axis == 1 ? s : 0, axis == 2 ? s : 0, c};
  }
  return rotation;
}

EulerAngles quat_to_euler(const EulerOrder& order, Quatd rotation, const EulerAngles& near) {
  rotation = normalized(rotation);
  const EulerAngles radians = {near[0] / kDegrees, near[1] / kDegrees, near[2] / kDegrees};
  EulerAngles angles = {0, 0, 0};
  if (order.count == 3) angles = three_angles(order, rotation, radians);
  if (order.count == 2) angles = two_angles(order, rotation, radians);
  if (order.count == 1) angles = one_angle(order, rotation, radians);
  for (double& angle : angles) angle *= kDegrees;
  return angles;
}

}  // namespace panache
