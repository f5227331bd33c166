#include "vmc_character.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <utility>

namespace panache::cli {
namespace {

constexpr double kLearnSeconds = 1;
constexpr size_t kMaxLearnt = 240;     // Max frames kept of the first second.
constexpr double kLongestWait = 0.02;  // Seconds; a frame's datagrams arrive together.
constexpr float kFarthest = 10'000;    // Metres.

// Whether the values are valid for a skeleton. Later the stylizer does its own checks.
bool is_sound(const VmcMessage& bone) {
  const Vec3 p = bone.position;
  return is_finite(p) && std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) < kFarthest &&
         is_finite(bone.rotation) && std::abs(dot(bone.rotation, bone.rotation) - 1) < 0.1f;
}

// Distinguishes 0 from -0, and treats equal NaNs as the same.
template <class T>
bool same_bits(const T& a, const T& b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

}  // namespace

void VmcCharacter::set_side(int style, float side) {
  std::vector<float>& sides = styling_.options.stylizer.sides;  // Of a stylizer to come.
  sides.resize(styling_.model->styles().size(), 1.0f);
  sides[static_cast<size_t>(style)] = side;
  if (stylizer_) stylizer_->stylizer().set_side(style, side);
}

void VmcCharacter::reset() noexcept {
  if (!stylizer_) return;
  stylizer_->reset();
  filter_->reset();
}

void VmcCharacter::take(Datagram datagram, std::span<const VmcMessage> messages,
                        std::span<const float> strengths) {
  held_.push_back(std::move(datagram));
  for (const VmcMessage& message : messages) {
    if (message.kind == VmcMessage::bone) take_bone(message, strengths);
    // Before there is a rig, this may end an incomplete frame.
    if (message.kind == VmcMessage::frame_end && stylizer_) finish_frame(strengths);
  }
  release();
}

void VmcCharacter::take_bone(const VmcMessage& bone, std::span<const float> strengths) {
  const auto b = static_cast<size_t>(bone.bone_index);
  if (stylizer_ ? !whole_[b] : !is_sound(bone)) return;
  if (seen_[b]) finish_frame(strengths);
  if (seen_.none()) now_.seconds = held_.back().received;
  seen_.set(b);
  now_.known.set(b);
  now_.positions[b] = bone.position;
  now_.rotations[b] = bone.rotation;
  // finish_frame() may just have made the rig.
  if (!stylizer_) return;
  open_.push_back({held_.size() - 1, bone.offset, joint_of_[b]});
  if (seen_ == whole_) finish_frame(strengths);
}

void VmcCharacter::end_late_frame(double now, std::span<const float> strengths) {
  if (held_.empty() || now - held_.front().received < kLongestWait) return;
  end_frame(strengths);
}

void VmcCharacter::end_frame(std::span<const float> strengths) {
  finish_frame(strengths);
  release();
}

void VmcCharacter::finish_frame(std::span<const float> strengths) {
  if (seen_.none()) return;
  if (stylizer_) {
    style(strengths);
  } else {
    learn();
  }
  seen_.reset();
  open_.clear();
  ++frames_;
}

void VmcCharacter::learn() {
  if (learnt_.size() < kMaxLearnt) learnt_.push_back(now_);
  if (learnt_.size() < 2 || now_.seconds - learnt_.front().seconds < kLearnSeconds) return;
  if (Result<void> stands = stand(); !stands) note_ = stands.error().message;
  learnt_.clear();
}

Vec3 VmcCharacter::position_of(const Bones& frame, int bone) const {
  const Vec3 sent = frame.positions[static_cast<size_t>(bone)];
  return usual_positions_ ? sent + (*usual_positions_)[static_cast<size_t>(bone)] : sent;
}

Result<void> VmcCharacter::stand() {
  Clip clip;
  const VmcBoneSet bones = VmcBoneSet(now_.known).set(kVmcRoot);
  // Some senders give rotations alone. The hips may still move.
  bool placed = false;
  for (int b = kVmcHips + 1; b < kVmcBones; ++b) {
    placed = placed || now_.positions[static_cast<size_t>(b)] != Vec3{};
  }
  if (!placed) {
    usual_positions_ = usual_positions(bones);
    if (now_.positions[kVmcHips] != Vec3{}) (*usual_positions_)[kVmcHips] = {};
  }
  std::array<Vec3, kVmcBones> positions;
  for (int b = 0; b < kVmcBones; ++b) positions[static_cast<size_t>(b)] = position_of(now_, b);
  clip.skeleton = vmc_skeleton(bones, positions);
  clip.frame_time = std::max(1e-6, (learnt_.back().seconds - learnt_.front().seconds) /
                                       static_cast<double>(learnt_.size() - 1));
  clip.resize(static_cast<int>(learnt_.size()));
  std::vector<int> order;
  for (int b = 0; b < kVmcBones; ++b) {
    if (bones[static_cast<size_t>(b)]) order.push_back(b);
  }
  for (int f = 0; f < clip.frames; ++f) {
    const Bones& frame = learnt_[static_cast<size_t>(f)];
    for (size_t j = 0; j < order.size(); ++j) {
      const auto b = static_cast<size_t>(order[j]);
      const Bones& from = frame.known[b] ? frame : now_;
      clip.pose(f).rotations[j] = from.rotations[b];
      clip.pose(f).translations[j] = position_of(from, order[j]);
    }
  }
  RigOptions options;
  options.up_axis = "+Y";
  Result<Rig> rig = Rig::create(clip, options);
  if (!rig) return rig.error();
  Result<LiveStylizer> stylizer =
      LiveStylizer::create(styling_.model, *std::move(rig), styling_.options);
  if (!stylizer) return stylizer.error();
  stylizer_.emplace(*std::move(stylizer));
  stylizer_->set_removed(styling_.removed);

  bones_ = std::move(order);
  filter_.emplace(bones_, styling_.mirror, styling_.smooth);
  whole_ = now_.known;
  for (size_t j = 0; j < bones_.size(); ++j) joint_of_[static_cast<size_t>(bones_[j])] = j;
  pose_ = styled_ = rest_clip(clip.skeleton);
  last_frame_ = now_.seconds;
  if (styling_.view && !styling_.view->started()) {
    shown_ = true;
    Clip first = clip;
    first.resize(1);
    styling_.view->start(stylizer_->stylizer().rig(), first);
  }
  if (styling_.recording && !styling_.recording->started()) {
    records_ = true;
    styling_.recording->start(clip.skeleton);
    for (int f = 0; f < clip.frames; ++f) {
      styling_.recording->add(learnt_[static_cast<size_t>(f)].seconds, std::as_const(clip).pose(f));
    }
  }
  return {};
}

void VmcCharacter::style(std::span<const float> strengths) {
  const Pose pose = pose_.pose(0), styled = styled_.pose(0);
  for (size_t j = 0; j < bones_.size(); ++j) {
    const auto b = static_cast<size_t>(bones_[j]);
    pose.rotations[j] = now_.rotations[b];
    pose.translations[j] = position_of(now_, bones_[j]);
  }
  filter_->apply(pose, now_.seconds - last_frame_);
  stylizer_->step(pose, strengths, now_.seconds - last_frame_, styled);
  last_frame_ = now_.seconds;
  for (const BoneSlot& slot : open_) {
    std::vector<char>& bytes = held_[slot.datagram].bytes;
    const size_t j = slot.joint;
    const auto b = static_cast<size_t>(bones_[j]);
    if (!same_bits(styled.rotations[j], now_.rotations[b])) {
      put_rotation(bytes, slot.at, styled.rotations[j]);
    }
    const Vec3 before = position_of(now_, bones_[j]), after = styled.translations[j];
    if (!same_bits(after, before)) {
      put_position(bytes, slot.at, usual_positions_ ? now_.positions[b] + (after - before) : after);
    }
  }
  if (records_) styling_.recording->add(now_.seconds, styled);
  if (shown_) styling_.view->show(pose, styled);
}

// Releases datagrams up to the first that holds bones of the current frame.
void VmcCharacter::release() {
  const size_t done = open_.empty() ? held_.size() : open_.front().datagram;
  const auto end = held_.begin() + static_cast<std::ptrdiff_t>(done);
  std::move(held_.begin(), end, std::back_inserter(ready_));
  held_.erase(held_.begin(), end);
  for (BoneSlot& slot : open_) slot.datagram -= done;
}

}  // namespace panache::cli
