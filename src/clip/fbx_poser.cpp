#include <algorithm>

#include "clip/fbx_document.h"

namespace panache {
namespace {

// A joint that is scaled to nothing for a time keeps the size that it was saved with.
NodeScale scale_or(Vec3d scale, Vec3d saved) {
  const NodeScale out = split_scale(scale);
  return out.stretch.can_undo() ? out : split_scale(saved);
}

}  // namespace

FbxPoser::FbxPoser(const FbxDocument& document, const FbxStack* stack)
    : document_(document),
      stack_(stack),
      axes_(document.settings.to_y_up()),
      metres_(document.settings.centimetres / 100),
      places_(document.joint_models.size()),
      locals_(places_.size()),
      own_(places_.size()),
      rotations_(places_.size()),
      above_(places_.size()),
      whole_(places_.size()),
      passed_(places_.size()) {
  for (size_t j = 0; j < places_.size(); ++j) places_[j] = model(j).place;
}

const FbxModel& FbxPoser::model(size_t joint) const {
  return document_.models[static_cast<size_t>(document_.joint_models[joint])];
}

void FbxPoser::set_time(int64_t time) {
  for (size_t j = 0; j < places_.size(); ++j) {
    if (stack_) {
      places_[j] = stack_->place(document_, static_cast<size_t>(document_.joint_models[j]), time);
    }
    locals_[j] = model(j).local(places_[j]);
    own_[j] = scale_or(places_[j].parts[kFbxScale], model(j).place.parts[kFbxScale]);
  }
}

void FbxPoser::get_pose(Pose out) {
  for (size_t j = 0; j < places_.size(); ++j) {
    const bool is_root = model(j).parent < 0;
    const Quatd turn = is_root ? axes_ * locals_[j].rotation : locals_[j].rotation;
    const Quat half = own_[j].turn;
    const Quat rotation = turn.as<float>();
    add_joint(j, half == Quat{} ? rotation : rotation * half);
    out.rotations[j] = rotations_[j];
    const Vec3d at = above_[j].apply(locals_[j].translation);
    out.translations[j] = ((is_root ? rotate(axes_, at) : at) * metres_).as<float>();
  }
}

void FbxPoser::set_rotations(std::span<const Quat> rotations) {
  for (size_t j = 0; j < places_.size(); ++j) add_joint(j, rotations[j]);
}

// See clip/stretch.h. With W' and B' of the parent, whose own scale is S', a model that turns by C
// and scales by S has the linear part W' C B' S (RrSs), W' B' C S (RSrs) or W' C B' S'^-1 S (Rrs).
void FbxPoser::add_joint(size_t joint, Quat rotation) {
  rotations_[joint] = rotation;
  const FbxModel& of = model(joint);
  if (of.parent < 0) {
    above_[joint] = passed_[joint] = Stretch();
    whole_[joint] = own_[joint].stretch;
    return;
  }
  const auto parent = static_cast<size_t>(document_.models[static_cast<size_t>(of.parent)].joint);
  above_[joint] = whole_[parent];
  const bool is_product = of.inherit == FbxModel::Inherit::RSrs;
  const Stretch& taken = of.inherit == FbxModel::Inherit::Rrs ? passed_[parent] : whole_[parent];
  const Quat by = is_product ? rotation : Quat{};
  passed_[joint] = taken.below(by, Stretch());
  whole_[joint] = taken.below(by, own_[joint].stretch);
}

Quatd FbxPoser::file_rotation(size_t joint, Quat rotation) const {
  const Quat half = own_[joint].turn;
  const Quatd turn = (half == Quat{} ? rotation : rotation * conjugate(half)).as<double>();
  return normalized(model(joint).parent < 0 ? conjugate(axes_) * turn : turn);
}

Vec3d FbxPoser::file_translation(size_t joint, Vec3 translation, Quatd rotation) const {
  Vec3d at = translation.as<double>() / metres_;
  if (model(joint).parent < 0) at = rotate(conjugate(axes_), at);
  return above_[joint].undo(at) -
         model(joint).pivot_shift(rotation, places_[joint].parts[kFbxScale]);
}

}  // namespace panache
