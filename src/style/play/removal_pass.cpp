#include "style/play/removal_pass.h"

#include <algorithm>

#include "style/play/removal.h"

namespace panache {

Result<RemovalPass> RemovalPass::create(std::shared_ptr<const Model> remover, Rig rig,
                                        StylizerOptions options) {
  if (Result<int> any = find_removal(*remover, ""); !any) return any.error();
  options.shape = {.hand_contacts = 0};
  options.sides = {};
  options.person = {};
  Result<Stylizer> stylizer = Stylizer::create(std::move(remover), std::move(rig), options);
  if (!stylizer) return stylizer.error();
  return RemovalPass(*std::move(stylizer));
}

RemovalPass::RemovalPass(Stylizer stylizer)
    : stylizer_(std::move(stylizer)),
      strengths_(stylizer_.model().styles().size()),
      rotations_(stylizer_.rig().joint_count()),
      translations_(stylizer_.rig().joint_count()) {}

void RemovalPass::set_removed(int style) noexcept {
  if (style < -1 || style >= static_cast<int>(strengths_.size())) return;
  std::fill(strengths_.begin(), strengths_.end(), 0.0f);
  if (style >= 0) strengths_[static_cast<size_t>(style)] = 1;
}

ConstPose RemovalPass::step(ConstPose in, double input_seconds, double output_seconds) noexcept {
  stylizer_.step(in, strengths_, {input_seconds, output_seconds}, {rotations_, translations_});
  return {rotations_, translations_};
}

}  // namespace panache
