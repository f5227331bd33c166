#include <algorithm>
#include <cmath>
#include <set>

#include "clip/fbx_document.h"
#include "clip/gltf_scales.h"
#include "clip/gltf_track.h"
#include "clip/motion_file.h"
#include "clip/text_cursor.h"

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
      channels_(document.joint_models.size()),
      locals_(channels_.size()),
      own_(channels_.size()),
      rotations_(channels_.size()),
      above_(channels_.size()),
      whole_(channels_.size()),
      passed_(channels_.size()) {
  for (size_t j = 0; j < channels_.size(); ++j) channels_[j] = model(j).channels;
}

const FbxModel& FbxPoser::model(size_t joint) const {
  return document_.models[static_cast<size_t>(document_.joint_models[joint])];
}

void FbxPoser::set_time(int64_t time) {
  for (size_t j = 0; j < channels_.size(); ++j) {
    if (stack_) {
      channels_[j] =
          stack_->channels(document_, static_cast<size_t>(document_.joint_models[j]), time);
    }
    locals_[j] = model(j).local(channels_[j]);
    own_[j] = scale_or(channels_[j].parts[kFbxScale], model(j).channels.parts[kFbxScale]);
  }
}

void FbxPoser::get_pose(Pose out) {
  for (size_t j = 0; j < channels_.size(); ++j) {
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
  for (size_t j = 0; j < channels_.size(); ++j) add_joint(j, rotations[j]);
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
         model(joint).pivot_shift(rotation, channels_[joint].parts[kFbxScale]);
}

namespace {

constexpr double kDense = 1.0 / 20;  // Seconds: keys no further apart than this are the frames.
constexpr double kSameFrame = 0.1;   // In frames: how far from its frame a key may be.
constexpr double kLargestUsualRate = 120;  // A file that states a higher rate may mean its ticks.

bool is_joint_kind(std::string_view kind) {
  return kind == "LimbNode" || kind == "Limb" || kind == "Root" || kind == "IKEffector" ||
         kind == "FKEffector";
}

bool moves(const FbxCurve& curve) {
  return std::ranges::any_of(
      curve.keys, [&](const FbxKey& key) { return key.value != curve.keys.front().value; });
}

// Whether every key is a whole number of frames after the first.
bool fits(const std::set<int64_t>& times, double frame) {
  return std::ranges::all_of(times, [&](int64_t time) {
    const double frames = static_cast<double>(time - *times.begin()) / frame;
    return std::abs(frames - std::round(frames)) < kSameFrame;
  });
}

class FbxClipsReader {
 public:
  FbxClipsReader(FbxDocument& document, std::optional<double> fps)
      : document_(document), models_(document.models), fps_(fps) {}

  Result<void> read() {
    for (FbxStack& stack : document_.stacks) set_range(stack);
    std::erase_if(document_.stacks, [](const FbxStack& stack) { return stack.end < stack.begin; });
    TakenNames taken;
    for (size_t s = 0; s < document_.stacks.size(); ++s) {
      std::string& name = document_.stacks[s].name;
      if (name.empty()) name = "animation " + std::to_string(s + 1);
      name = unique_name(name, taken);
    }
    find_joints();
    if (document_.joint_models.empty()) {
      return Error{document_.tree.name() + ": expected joints (models of FBX), found none"};
    }
    if (auto good = make_rest(); !good) return good;
    for (FbxStack& stack : document_.stacks) {
      if (auto good = make_clip(stack); !good) return good;
    }
    return {};
  }

 private:
  static void set_range(FbxStack& stack) {
    stack.begin = kFbxLatest + 1;
    stack.end = -kFbxLatest - 1;
    for (const FbxLayer& layer : stack.layers) {
      for (const auto& [target, node] : layer.by_target) {
        for (const FbxCurve& curve : layer.nodes[node].curves) {
          if (curve.keys.empty()) continue;
          stack.begin = std::min(stack.begin, curve.keys.front().time);
          stack.end = std::max(stack.end, curve.keys.back().time);
        }
      }
    }
  }

  // Joints are what is called so, what moves the vertices of a mesh, what moves itself, and all
  // above. In a file without any of these, every model is a joint.
  void find_joints() {
    std::vector<bool> is_joint(models_.size());
    for (size_t m = 0; m < models_.size(); ++m) {
      is_joint[m] = is_joint_kind(models_[m].kind) || document_.skins.contains(m);
    }
    for (const FbxStack& stack : document_.stacks) {
      for (const FbxLayer& layer : stack.layers) {
        for (const auto& [target, node] : layer.by_target) {
          if (models_[target.first].is_camera_or_light()) continue;
          if (std::ranges::any_of(layer.nodes[node].curves, moves)) is_joint[target.first] = true;
        }
      }
    }
    if (std::find(is_joint.begin(), is_joint.end(), true) == is_joint.end())
      is_joint.assign(models_.size(), true);
    for (size_t m = models_.size(); m-- > 0;) {
      if (is_joint[m] && models_[m].parent >= 0)
        is_joint[static_cast<size_t>(models_[m].parent)] = true;
    }
    for (size_t m = 0; m < models_.size(); ++m) {
      if (!is_joint[m]) continue;
      models_[m].joint = static_cast<int>(document_.joint_models.size());
      document_.joint_models.push_back(static_cast<int>(m));
    }
  }

  const FbxModel& model(size_t joint) const {
    return models_[static_cast<size_t>(document_.joint_models[joint])];
  }

  Result<void> make_rest() {
    const size_t joints = document_.joint_models.size();
    Clip& rest = document_.rest;
    for (size_t j = 0; j < joints; ++j) {
      Joint& joint = rest.skeleton.joints.emplace_back();
      const FbxModel& of = model(j);
      joint.name = of.name;
      joint.parent = of.parent < 0 ? -1 : models_[static_cast<size_t>(of.parent)].joint;
      joint.can_rotate = true;
      joint.can_translate = joint.parent < 0;
      const auto skin = document_.skins.find(static_cast<size_t>(document_.joint_models[j]));
      if (skin != document_.skins.end()) {
        joint.skin = skin->second.first;
        joint.skin_weight = skin->second.second;
      }
      const bool is_flat = !split_scale(of.channels.parts[kFbxScale]).stretch.can_undo();
      const auto is_below = [&](int child) {
        return models_[static_cast<size_t>(child)].parent == document_.joint_models[j];
      };
      if (is_flat && std::ranges::any_of(document_.joint_models, is_below)) {
        return document_.tree.error(*of.node,
                                    "a scale that leaves each of its axes some length, as other "
                                    "joints are below it",
                                    "one that is flat");
      }
    }
    rest.resize(1);
    FbxPoser poser(document_, nullptr);
    poser.set_time(0);
    poser.get_pose(rest.pose(0));
    bind_rest();
    for (size_t j = 0; j < joints; ++j) {
      Joint& joint = rest.skeleton.joints[j];
      joint.rest = rest.rotations[j];
      joint.offset = rest.translations[j];
      if (!is_within_reach(joint.offset)) return too_far(j);
    }
    return {};
  }

  Result<void> too_far(size_t joint) const {
    return document_.tree.error(*model(joint).node, "positions between -1e9 and 1e9",
                                "one outside");
  }

  // Models have the pose at the time of saving, usually that of the first frame of a motion. Where
  // the motions animate a joint anyhow, the rest pose is that to which a skin is bound.
  void bind_rest() {
    Clip& rest = document_.rest;
    const size_t joints = rest.joints();
    const Quatd axes = document_.settings.to_y_up();
    const double metres = document_.settings.centimetres / 100;
    std::vector<Quatd> turns(joints);
    std::vector<Vec3d> positions(joints);
    for (size_t j = 0; j < joints; ++j) {
      const auto m = static_cast<size_t>(document_.joint_models[j]);
      const int parent = rest.skeleton.joints[j].parent;
      const Quatd above = parent < 0 ? Quatd{} : turns[static_cast<size_t>(parent)];
      const Vec3d from = parent < 0 ? Vec3d{} : positions[static_cast<size_t>(parent)];
      turns[j] = normalized(above * rest.rotations[j].as<double>());
      positions[j] = from + rotate(above, rest.translations[j].as<double>());
      const auto bind = document_.bind.find(m);
      if (bind == document_.bind.end() || !is_always_animated(m)) continue;
      const auto& n = bind->second;
      const SplitMatrix split =
          split_matrix({Vec3d{n[0], n[1], n[2]}, {n[4], n[5], n[6]}, {n[8], n[9], n[10]}});
      if (!split.stretch.can_undo()) continue;
      turns[j] = normalized(axes * split.rotation.as<double>());
      positions[j] = rotate(axes, Vec3d{n[12], n[13], n[14]}) * metres;
      rest.rotations[j] = normalized(conjugate(above) * turns[j]).as<float>();
      rest.translations[j] = rotate(conjugate(above), positions[j] - from).as<float>();
    }
  }

  bool is_always_animated(size_t model) const {
    return !document_.stacks.empty() &&
           std::ranges::all_of(document_.stacks, [&](const FbxStack& stack) {
             return stack.animates(model, kFbxRotation);
           });
  }

  // The curve of a joint with the most keys; one or two equal keys only hold a pose.
  const FbxCurve* deciding_curve(const FbxStack& stack) const {
    const FbxCurve* max = nullptr;
    for (const FbxLayer& layer : stack.layers) {
      for (const auto& [target, node] : layer.by_target) {
        if (models_[target.first].joint < 0 || target.second == kFbxScale) continue;
        for (const FbxCurve& curve : layer.nodes[node].curves) {
          if (curve.keys.empty() || (curve.keys.size() <= 2 && !moves(curve))) continue;
          if (!max || curve.keys.size() > max->keys.size()) max = &curve;
        }
      }
    }
    return max;
  }

  // Frames at the rate of the keys if they are close enough to be frames, else at the file's rate
  // if its frames are where the keys are, else at a usual one.
  FrameGrid grid_of(const FbxStack& stack) const {
    const double last = static_cast<double>(stack.end - stack.begin) / kFbxSecond;
    const FbxCurve* deciding = deciding_curve(stack);
    if (!deciding || deciding->keys.size() < 2) {
      return find_grid(nullptr, 0, last, 1 / document_.settings.rate);
    }
    GltfTrack track;
    std::set<int64_t> times;
    for (const FbxKey& key : deciding->keys) {
      const auto seconds =
          static_cast<float>(static_cast<double>(key.time - stack.begin) / kFbxSecond);
      // Ticks apart, which floats do not tell.
      if (!track.times.empty() && !(seconds > track.times.back())) continue;
      track.times.push_back(seconds);
      times.insert(key.time);
    }
    if (times.size() < 2) return find_grid(nullptr, 0, last, 1 / document_.settings.rate);
    if (fps_) return find_grid(&track, 0, last, 1 / *fps_);
    const FrameGrid own = find_grid(&track, 0, last);
    const double spacing =
        (track.times.back() - track.times.front()) / static_cast<double>(track.times.size() - 1);
    const bool is_dense = spacing <= kDense * (1 + kSameFrame);
    if (is_dense && fits(times, own.frame_time * kFbxSecond)) return own;
    const double rate = document_.settings.rate;
    if (rate > kLargestUsualRate || !fits(times, kFbxSecond / rate)) return own;
    return find_grid(&track, 0, last, 1 / rate);
  }

  Result<void> make_clip(FbxStack& stack) {
    const FrameGrid grid = grid_of(stack);
    poses_ += grid.frames * static_cast<double>(document_.joint_models.size());
    const size_t max = fbx_max_poses(document_.tree.bytes().size());
    if (!(grid.frames <= kFbxMaxFrames) || !(poses_ <= static_cast<double>(max))) {
      return Error{
          document_.tree.name() + ": expected motions of at most " + std::to_string(kFbxMaxFrames) +
          " frames, and in all of at most " + std::to_string(max) +
          " frames times joints, as the file is of this size; found more; is the time of a "
          "key wrong?"};
    }
    Clip& clip = stack.clip;
    clip.skeleton = document_.rest.skeleton;
    clip.frame_time = grid.frame_time;
    clip.resize(static_cast<int>(grid.frames));
    FbxPoser poser(document_, &stack);
    for (int f = 0; f < clip.frames; ++f) {
      poser.set_time(stack.time_of(f));
      poser.get_pose(clip.pose(f));
      for (size_t j = 0; j < clip.joints(); ++j) {
        if (!is_within_reach(clip.pose(f).translations[j])) return too_far(j);
      }
    }
    for (size_t j = 0; j < clip.joints(); ++j) {
      Joint& joint = clip.skeleton.joints[j];
      joint.can_translate = joint.can_translate || leaves_rest_position(clip, j);
    }
    mark_still_joints(clip);
    return {};
  }

  FbxDocument& document_;
  std::vector<FbxModel>& models_;
  std::optional<double> fps_;
  double poses_ = 0;
};

}  // namespace

int64_t FbxStack::time_of(double frame) const {
  return begin + std::llround(frame * clip.frame_time * kFbxSecond);
}

Result<void> read_fbx_clips(FbxDocument& document, std::optional<double> fps) {
  return FbxClipsReader(document, fps).read();
}

}  // namespace panache
