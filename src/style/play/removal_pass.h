#pragma once
// The first of two live passes: takes a style off the input before the second puts styles on.

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "style/stylizer.h"

namespace panache {

class RemovalPass {
 public:
  // `options`: all but shape and sides is used. Fails if `remover` puts styles on, or if
  // Stylizer::create() fails.
  static Result<RemovalPass> create(std::shared_ptr<const Model> remover, Rig rig,
                                    StylizerOptions options);

  // The remover's style to take off; -1 (initially): none. Eased like strengths. Other numbers are
  // ignored.
  void set_removed(int style) noexcept;
  // The input without the style, valid until the next step; times as for Stylizer::step().
  ConstPose step(ConstPose in, double input_seconds, double output_seconds) noexcept;

  // See Stylizer; the style to take off is not part of the state.
  void reset() noexcept { stylizer_.reset(); }
  const Stylizer& stylizer() const noexcept { return stylizer_; }
  size_t state_size() const noexcept { return stylizer_.state_size(); }
  void save(std::span<std::byte> out) const noexcept { stylizer_.save(out); }
  bool restore(std::span<const std::byte> in) noexcept { return stylizer_.restore(in); }

 private:
  explicit RemovalPass(Stylizer stylizer);

  Stylizer stylizer_;
  std::vector<float> strengths_;    // [styles of the remover]
  std::vector<Quat> rotations_;     // The neutral pose. [joints]
  std::vector<Vec3> translations_;  // Likewise.
};

}  // namespace panache
