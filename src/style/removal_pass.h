#pragma once
// The first of two live passes: it takes a style off the input, before another puts styles on.

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "style/stylizer.h"

namespace panache {

class RemovalPass {
 public:
  // `options` but for their shape. Fails where `remover` puts styles on, and where
  // Stylizer::create() does.
  static Result<RemovalPass> create(std::shared_ptr<const Model> remover, Rig rig,
                                    StylizerOptions options);

  // The style of the remover that is taken off; -1: none, as at first. Eased as strengths are.
  // Other numbers are ignored.
  void set_removed(int style) noexcept;
  // The input without the style, good until the next step; times as Stylizer::step() takes them.
  ConstPose step(ConstPose in, double input_seconds, double output_seconds) noexcept;

  // See Stylizer; the style that is taken off is no part of the state.
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
