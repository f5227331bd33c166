#include "clip/stretch.h"

#include <algorithm>
#include <cmath>

namespace panache {
namespace {

// Scales with smaller relative differences count as equal: exporters round.
constexpr double kEven = 1e-4;
// Anything flatter than this has lost an axis.
constexpr double kFlat = 1e-6;

// The single number nearest to three scales of one sign.
double even_size(double x, double y, double z) {
  // A cube root is not exact, and most scales are uniform.
  return x == y && y == z ? x : std::cbrt(x * y * z);
}

}  // namespace

Stretch::Stretch(const std::array<Vec3d, 3>& columns) {
  const double size = even_size(columns[0].x, columns[1].y, columns[2].z);
  bool even = true;
  for (size_t c = 0; c < 3; ++c) {
    for (size_t r = 0; r < 3; ++r) {
      const double wanted = r == c ? size : 0;
      even = even && std::abs(columns[c][r] - wanted) <= kEven * std::abs(size);
    }
  }
  even_ = even;
  size_ = even ? size : 1;
  if (!even) columns_ = columns;
}

std::array<double, 3> Stretch::lengths() const {
  if (even_) return {std::abs(size_), std::abs(size_), std::abs(size_)};
  return {length(columns_[0]), length(columns_[1]), length(columns_[2])};
}

bool Stretch::can_undo() const {
  if (even_) return size_ != 0;
  const auto [x, y, z] = lengths();
  const double longest = std::max({x, y, z});
  return std::abs(determinant()) > kFlat * longest * longest * longest;
}

Vec3d Stretch::apply(Vec3d position) const { return even_ ? position * size_ : times(position); }

Vec3d Stretch::undo(Vec3d stretched) const {
  const Vec3d s = stretched;
  if (even_) return s / size_;
  // Cramer's rule.
  const Vec3d across = {dot(cross(columns_[1], columns_[2]), s),
                        dot(cross(columns_[2], columns_[0]), s),
                        dot(cross(columns_[0], columns_[1]), s)};
  return across / determinant();
}

Stretch Stretch::below(Quat turn, const Stretch& own) const {
  if (even_ && own.even_) return Stretch(size_ * own.size_);
  const Quatd c = normalized(turn.as<double>());
  std::array<Vec3d, 3> columns;
  for (size_t i = 0; i < 3; ++i) {
    const Vec3d axis = {i == 0 ? 1.0 : 0.0, i == 1 ? 1.0 : 0.0, i == 2 ? 1.0 : 0.0};
    const Vec3d v = own.even_ ? axis * own.size_ : own.columns_[i];
    columns[i] = even_ ? v * size_ : rotate(conjugate(c), times(rotate(c, v)));
  }
  return Stretch(columns);
}

NodeScale split_scale(Vec3d scale) {
  if (scale == Vec3d{}) return {};
  const Vec3d sign = {scale.x < 0 ? -1.0 : 1.0, scale.y < 0 ? -1.0 : 1.0, scale.z < 0 ? -1.0 : 1.0};
  const double all = sign.x * sign.y * sign.z;
  NodeScale out;
  // d diag(s) keeps the axis whose sign is d, or all three.
  if (sign.x != sign.y || sign.y != sign.z) {
    out.turn = sign.y == sign.z   ? Quat{1, 0, 0, 0}
               : sign.x == sign.z ? Quat{0, 1, 0, 0}
                                  : Quat{0, 0, 1, 0};
  }
  out.stretch = Stretch({{{all * std::abs(scale.x), 0, 0},
                          {0, all * std::abs(scale.y), 0},
                          {0, 0, all * std::abs(scale.z)}}});
  return out;
}

SplitMatrix split_matrix(const std::array<Vec3d, 3>& columns) {
  Vec3d x = columns[0], y = columns[1], z = columns[2];
  if (x == Vec3d{} && y == Vec3d{} && z == Vec3d{}) return {};
  // A mirror image is the negative of a rotation.
  const double sign = dot(cross(x, y), z) < 0 ? -1 : 1;
  x = normalized(x * sign, {1, 0, 0});
  y = normalized(y * sign - x * dot(x, y * sign), {0, 1, 0});
  const Quatd rotation = from_axes(x, y, normalized(cross(x, y), {0, 0, 1}));
  std::array<Vec3d, 3> stretch;
  for (size_t c = 0; c < 3; ++c) stretch[c] = rotate(conjugate(rotation), columns[c]);
  return {rotation.as<float>(), Stretch(stretch)};
}

}  // namespace panache
